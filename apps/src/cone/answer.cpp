// SPDX-License-Identifier: BSD-3-Clause
#include "cone/answer.h"

#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/cones/pair.h>
#include <vericone/cones/penetration.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/combined/nearest_points.h>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "json/json_value.h"

namespace vericone {
namespace {

bool is_ever(const Horizon& horizon) { return horizon.from == 0 && std::isinf(horizon.until); }

Json interval(double low, double high) { return {number_or_null(low), number_or_null(high)}; }

/// Of two that miss, as a pair's miss() has it; rounded.
double nearest_time(const Ellipsoid& agent, const Ellipsoid& obstacle, const Eigen::Vector3d& v_a,
                    const Eigen::Vector3d& v_b) {
  if (v_a == v_b) return 0;
  const Eigen::Vector3d w = v_a - v_b;
  const double speed = w.cwiseAbs().maxCoeff();
  // Where squares of speeds leave the doubles, miss() scales them.
  if (!(speed > 1e-100 && speed < 1e100)) return Pair(Placed(agent), Placed(obstacle)).miss(v_a, v_b).time;
  return std::max(clearance(agent, obstacle, w).time, 0.0);
}

/// Two ellipsoids: exact verdicts, rounded lengths and times. What a pair's miss() and contact() say of them,
/// without the bounds, points and normals that nobody asked for.
Json answer_of_ellipsoids(const Ellipsoid& agent, const Ellipsoid& obstacle, const Eigen::Vector3d& v_a,
                          const Eigen::Vector3d& v_b, bool with_rung, const Horizon& horizon) {
  const ConeOracle oracle(agent, obstacle);
  Rung rung = oracle.relation_rung();  // of bodies that are not disjoint
  Json result = Json::object();
  result.get_ref<Json::object_t&>().reserve(8);
  const Verdict verdict = oracle.verdict(v_a, v_b, &rung);
  result["verdict"] = to_string(is_ever(horizon) ? verdict : oracle.verdict(v_a, v_b, horizon, &rung));
  if (with_rung) result["rung"] = to_string(rung);
  result["clearance"] = number_or_null(clearance_ahead(oracle, v_a, v_b));
  result["nearest_time"] =
      verdict == Verdict::out ? number_or_null(nearest_time(agent, obstacle, v_a, v_b)) : Json(nullptr);
  result["time_to_contact"] = number_or_null(time_to_contact(oracle, v_a, v_b));
  return result;
}

/// Bodies delimited by hyperboloids: there is no clearance, as the shadows of these bodies are not convex,
/// and the signed distance of two such shadows is not what the miss distance of ellipsoids is.
void add_enclosed_time(Json& result, const Pair& pair, Verdict verdict, const Eigen::Vector3d& v_a,
                       const Eigen::Vector3d& v_b) {
  Json time = nullptr, enclosure = nullptr;
  const auto contact = pair.contact(v_a, v_b);
  if (contact && verdict != Verdict::undecided && std::isfinite(contact->time)) {
    time = contact->time;
    enclosure = {contact->earliest, contact->latest};
  }
  result["clearance"] = nullptr;
  result["nearest_time"] =
      verdict == Verdict::out ? number_or_null(nearest_time(pair, v_a, v_b)) : Json(nullptr);
  result["time_to_contact"] = time;
  result["time_enclosure"] = enclosure;
}

/// Bodies of pieces: enclosed lengths and times, and where they meet.
template <typename AnyPair>
void add_enclosures(Json& result, const AnyPair& pair, Verdict verdict, const Eigen::Vector3d& v_a,
                    const Eigen::Vector3d& v_b) {
  Json clearance = nullptr, around = nullptr, nearest = nullptr, time = nullptr, enclosure = nullptr,
       point = nullptr, normal = nullptr;
  if (verdict == Verdict::on || verdict == Verdict::touching) clearance = 0.0, around = interval(0, 0);
  if (verdict == Verdict::out) {
    const Miss miss = pair.miss(v_a, v_b);
    clearance = miss.distance;
    around = interval(miss.least, miss.most);
    nearest = number_or_null(miss.time);
  } else if (verdict != Verdict::undecided) {
    const Contact contact = *pair.contact(v_a, v_b);
    enclosure = interval(contact.earliest, contact.latest);
    // The contact is proved, and its time not found where sizes are too far apart for the search.
    if (!std::isnan(contact.time)) time = number_or_null(contact.time);
    if (contact.point) point = vector_json(*contact.point);
    if (contact.normal) normal = vector_json(*contact.normal);
  }
  result["clearance"] = clearance;
  result["clearance_enclosure"] = around;
  result["nearest_time"] = nearest;
  result["time_to_contact"] = time;
  result["time_enclosure"] = enclosure;
  result["contact_point"] = point;
  result["contact_normal"] = normal;
}

/// Raised bodies touch at every height at once.
void put_in_plane(Json& result) {
  for (const char* field : {"contact_point", "contact_normal"})
    if (!result[field].is_null()) result[field][2] = 0.0;
}

/// Of bodies that overlap now.
Json penetration_json(const std::optional<Penetration>& depth) {
  if (!depth) return nullptr;
  return {{"depth", {depth->least, depth->most}}, {"normal", vector_json(depth->normal)}};
}

/// What reading left out of the obstacle: the body is then not quite what the file says.
void add_left_out(Json& result, const scenes::SceneBody& obstacle) {
  if (!obstacle.reading) return;
  if (obstacle.reading->dropped_points) result["dropped_points"] = obstacle.reading->dropped_points;
  if (obstacle.reading->dropped_faces) result["dropped_faces"] = obstacle.reading->dropped_faces;
  if (obstacle.reading->trailing_bytes) result["trailing_bytes"] = obstacle.reading->trailing_bytes;
}

}  // namespace

Json answer(const scenes::Scene& scene, bool with_rung, const Horizon& horizon) {
  const Eigen::Vector3d &v_a = scene.agent.velocity, &v_b = scene.obstacle.velocity;
  if (scene.agent.ellipsoid() && scene.obstacle.ellipsoid()) {
    Json result = answer_of_ellipsoids(*scene.agent.ellipsoid(), *scene.obstacle.ellipsoid(), v_a, v_b,
                                       with_rung, horizon);
    if (result["verdict"] == to_string(Verdict::overlapping))
      result["penetration"] = penetration_json(penetration(scene.agent.placed, scene.obstacle.placed));
    return result;
  }
  const Pair pair = scene.pair();
  const Verdict verdict = pair.verdict(v_a, v_b);
  Json result;
  result["verdict"] = to_string(is_ever(horizon) ? verdict : pair.verdict(v_a, v_b, horizon));
  if (with_rung && is_ever(horizon)) {
    const auto rung = pair.rung(v_a, v_b);
    result["rung"] = rung ? to_string(*rung) : "certified";
  }
  if (std::strcmp(pair.guarantee().family, "combined") == 0) {
    add_enclosed_time(result, pair, verdict, v_a, v_b);
  } else {
    add_enclosures(result, pair, verdict, v_a, v_b);
    if (scene.in_plane) put_in_plane(result);
    add_left_out(result, scene.obstacle);
  }
  if (verdict == Verdict::overlapping)
    result["penetration"] = penetration_json(penetration(scene.agent.placed, scene.obstacle.placed));
  return result;
}

Json slab_answer(const scenes::Scene& scene, const Slab& slab, const Horizon& horizon, bool with_rung) {
  if (horizon.from > 0)
    throw InputError("horizon", "[" + to_text(horizon.from) + ", " + to_text(horizon.until) + "]",
                     "one from 0 on beside a half-space or a slab");
  const SlabPair pair(scene.agent.placed, slab);
  const Eigen::Vector3d &v_a = scene.agent.velocity, &v_b = scene.obstacle.velocity;
  const Verdict verdict = pair.verdict(v_a, v_b);
  Json result{{"verdict", to_string(pair.verdict(v_a, v_b, horizon.until))}};
  if (with_rung) result["rung"] = to_string(Rung::exact);
  add_enclosures(result, pair, verdict, v_a, v_b);
  if (scene.in_plane) put_in_plane(result);
  if (verdict == Verdict::overlapping) result["penetration"] = penetration_json(pair.penetration());
  return result;
}

Json motion_answer(const scenes::Scene& scene, const BodyMotion& agent, const BodyMotion& obstacle,
                   const Horizon& horizon, bool with_rung) {
  const MotionAnswer found =
      motion_answer(scene.agent.placed, agent, scene.obstacle.placed, obstacle, horizon);
  Json result{{"verdict", to_string(found.verdict)}, {"guarantee", "certified"}};
  if (with_rung) result["rung"] = "certified";
  const bool out = found.verdict == Verdict::out, met = !out && found.verdict != Verdict::undecided;
  const bool touching = found.verdict == Verdict::touching;
  result["clearance"] = out ? Json(found.most) : touching ? Json(0.0) : Json(nullptr);
  result["clearance_enclosure"] = out        ? interval(found.least, found.most)
                                  : touching ? interval(0, 0)
                                             : Json(nullptr);
  result["nearest_time"] = out ? Json(found.time) : Json(nullptr);
  result["time_to_contact"] = met ? Json(found.time) : Json(nullptr);
  result["time_enclosure"] = met ? interval(found.earliest, found.latest) : Json(nullptr);
  if (found.verdict == Verdict::undecided)
    result["undecided_between"] = interval(found.earliest, found.latest);
  const auto vector = [](const std::optional<Eigen::Vector3d>& x) {
    return x ? vector_json(*x) : Json(nullptr);
  };
  result["contact_point"] = vector(found.point);
  result["contact_normal"] = vector(found.normal);
  add_left_out(result, scene.obstacle);
  return result;
}

double nearest_time(const Pair& pair, const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b) {
  const auto *agent = pair.agent().body.quadric(), *obstacle = pair.obstacle().body.quadric();
  if (!agent || !obstacle || pair.guarantee().exact || v_a == v_b) return pair.miss(v_a, v_b).time;
  // Pair brackets the distance of these by ellipsoids, which may be nearest at another time.
  const auto a = in_world(*agent, pair.agent().pose), b = in_world(*obstacle, pair.obstacle().pose);
  const Eigen::Vector3d w = v_a - v_b;
  if (!std::isfinite((b.center() - a.center()).squaredNorm()) || !std::isnormal(w.squaredNorm()))
    return std::numeric_limits<double>::quiet_NaN();
  return nearest_points(a, b, w, 0, std::numeric_limits<double>::infinity()).time;
}

const char* verdict_kind(const scenes::Scene& scene) {
  return scene.pair().guarantee().exact ? "exact" : "certified";
}

}  // namespace vericone
