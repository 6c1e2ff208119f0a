// SPDX-License-Identifier: BSD-3-Clause
#include "picture/course.h"

#include <vericone/cones/pair.h>
#include <vericone/internal/cones/combined/nearest_points.h>
#include <cmath>
#include <limits>

#include "json/json_value.h"

namespace vericone {
namespace {

template <int D>
Json course(const scenes::Scene& scene, const BasicCombined<D>& agent, const BasicCombined<D>& obstacle) {
  using Vector = Eigen::Matrix<double, D, 1>;
  const Eigen::Vector3d &v_a = scene.agent.velocity, &v_b = scene.obstacle.velocity;
  const Vector w = scene.relative_velocity().head<D>();
  const Pair pair = scene.pair();
  const Verdict verdict = pair.verdict(v_a, v_b);
  Json result{{"velocity", vector_json(w)}, {"verdict", to_string(verdict)}};
  if (verdict == Verdict::out) {
    constexpr double kEver = std::numeric_limits<double>::infinity();
    const NearestPoints<D> nearest = nearest_points(agent, obstacle, w, 0, kEver);
    result["miss_distance"] = pair.guarantee().exact ? pair.miss(v_a, v_b).distance : nearest.distance;
    result["nearest_time"] = nearest.time;
    result["nearest_on_agent"] = vector_json(nearest.on_agent);
    result["nearest_on_obstacle"] = vector_json(nearest.on_obstacle);
  } else if (verdict != Verdict::undecided && verdict != Verdict::overlapping) {
    const auto contact = pair.contact(v_a, v_b);
    if (!contact || !std::isfinite(contact->time)) return result;
    const double t = contact->time;
    result["contact_time"] = t;
    const Vector point = contact->point ? Vector((*contact->point - t * v_b).template head<D>())
                                        : nearest_points(agent, obstacle, w, t, t).on_obstacle;
    result["contact_point"] = vector_json(point);
  }
  return result;
}

/// Of a polygon, a stadium or a body with a margin, where no points are known but those of a contact.
Json flat_course(const scenes::Scene& scene) {
  const Eigen::Vector3d &v_a = scene.agent.velocity, &v_b = scene.obstacle.velocity;
  const Pair pair = scene.pair();
  const Verdict verdict = pair.verdict(v_a, v_b);
  Json result{{"velocity", vector_json(scene.relative_velocity().head<2>())},
              {"verdict", to_string(verdict)}};
  if (verdict == Verdict::out) {
    const Miss miss = pair.miss(v_a, v_b);
    result["miss_distance"] = miss.distance;
    result["nearest_time"] = miss.time;
  } else if (verdict == Verdict::in || verdict == Verdict::on) {
    const auto contact = pair.contact(v_a, v_b);
    if (!contact || !std::isfinite(contact->time)) return result;
    result["contact_time"] = contact->time;
    if (contact->point)
      result["contact_point"] = vector_json((*contact->point - contact->time * v_b).head<2>());
  }
  return result;
}

}  // namespace

Json course_json(const scenes::Scene& scene) {
  if (scene.planar) return course<2>(scene, scene.planar->agent, scene.planar->obstacle);
  if (scene.in_plane) return flat_course(scene);
  return course<3>(scene, *scene.agent.quadric(), *scene.obstacle.quadric());
}

}  // namespace vericone
