// SPDX-License-Identifier: BSD-3-Clause
#include "answer.h"

#include <vericone/cones/clearance.h>
#include <vericone/cones/combined_cone.h>
#include <algorithm>
#include <cmath>

#include "input/assembly_body.h"
#include "json_value.h"

namespace vericone {
namespace {

/// For answers that take the difference as a vector of doubles.
Eigen::Vector3d difference(const Eigen::Vector3d& agent, const Eigen::Vector3d& obstacle) {
  const Eigen::Vector3d w = agent - obstacle;
  for (int i = 0; i < 3; ++i)
    if (!std::isfinite(w(i)))
      throw InputError("agent_velocity[" + std::to_string(i) + "]", to_text(agent(i)),
                       "at most 1.8e308 from the obstacle's, " + to_text(obstacle(i)));
  return w;
}

Json exact_answer(const input::Engagement& e, bool with_rung) {
  const ConeOracle oracle(e.agent.ellipsoid(), e.obstacle.ellipsoid());
  Rung rung = oracle.relation_rung();  // of bodies that are not disjoint
  const Verdict verdict = oracle.verdict(e.agent_velocity, e.obstacle_velocity, &rung);
  Json result;
  result["verdict"] = to_string(verdict);
  if (with_rung) result["rung"] = to_string(rung);
  result["clearance"] = number_or_null(clearance_ahead(oracle, e.agent_velocity, e.obstacle_velocity));
  const auto time = time_to_contact(oracle, e.agent_velocity, e.obstacle_velocity);
  result["time_to_contact"] = time ? number_or_null(*time) : Json(nullptr);
  return result;
}

/// Bodies delimited by hyperboloids: proved, or undecided. There is no clearance: the shadows of these bodies
/// are not convex, and the signed distance of two such shadows is not what clearance() computes.
Json certified_answer(const input::Engagement& e, bool with_rung) {
  const CombinedOracle oracle(e.agent, e.obstacle);
  const Eigen::Vector3d w = difference(e.agent_velocity, e.obstacle_velocity);
  const auto relation = oracle.relation();
  Json result;
  std::string verdict = "undecided";
  Json time = nullptr, enclosure = nullptr;
  if (relation && *relation != Relation::disjoint) {
    verdict = to_string(*relation);
    time = 0.0;
    enclosure = {0.0, 0.0};
  } else if (relation) {
    verdict = to_string(oracle.membership(w));
    if (verdict == "in")
      if (const auto t = oracle.time_to_contact(w)) {
        time = t->mid();
        enclosure = {std::max(t->lo(), 0.0), t->hi()};
      }
  }
  result["verdict"] = verdict;
  if (with_rung) result["rung"] = "certified";
  result["clearance"] = nullptr;
  result["time_to_contact"] = time;
  result["time_enclosure"] = enclosure;
  return result;
}

/// Whether the contact is known to a thousandth of the time or a hundredth of the agent's size. It is not
/// where a piece is so large that its coordinates are rounded by more.
bool is_found(const AssemblyContact& contact, Membership membership, const Eigen::Vector3d& w,
              const input::AssemblyEngagement& e) {
  constexpr double kOfTime = 1e-3, kOfSize = 1e-2, kLargest = 1e7;
  const double size = input::bounds_of_agent(e).half_widths().maxCoeff();
  // What grazes has no time at which they surely overlap.
  if (membership == Membership::on)
    return e.obstacle.pieces.bounds().half_widths().maxCoeff() <= kLargest * size;
  const double open = contact.latest - contact.earliest;
  if (!std::isfinite(open)) return false;
  return open <= kOfTime * contact.latest || open * w.norm() <= kOfSize * size;
}

Json interval(double low, double high) { return {number_or_null(low), number_or_null(high)}; }

/// A body of pieces: exact verdicts, enclosed lengths and times.
Json assembly_answer(const input::AssemblyEngagement& e, bool with_rung) {
  const AssemblyOracle oracle = assembly_oracle(e);
  const Eigen::Vector3d w = difference(e.agent_velocity, e.obstacle_velocity);
  const Relation relation = oracle.relation();
  Effort effort;
  Membership membership = Membership::out;
  if (relation == Relation::disjoint)
    membership = oracle.membership(e.agent_velocity, e.obstacle_velocity, &effort);
  Json result;
  result["verdict"] = relation == Relation::disjoint ? to_string(membership) : to_string(relation);
  if (with_rung)
    result["rung"] =
        to_string(effort.exact > 0 || relation != Relation::disjoint ? Rung::exact : Rung::triage);
  Json clearance = nullptr, around = nullptr, time = nullptr, enclosure = nullptr, point = nullptr,
       normal = nullptr;
  if (relation != Relation::disjoint) {
    time = 0.0;
    enclosure = interval(0, 0);
    if (relation == Relation::touching) clearance = 0.0, around = interval(0, 0);
  } else if (membership == Membership::out) {
    const AssemblyMiss miss = oracle.miss_distance(w);
    clearance = 0.5 * (miss.least + miss.most);
    around = interval(miss.least, miss.most);
  } else {
    if (membership == Membership::on) clearance = 0.0, around = interval(0, 0);
    if (const auto contact = oracle.first_contact(w)) {
      enclosure = interval(contact->earliest, contact->latest);
      if (is_found(*contact, membership, w, e)) {
        time = number_or_null(contact->time);
        point = vector_json(contact->point + contact->time * e.obstacle_velocity);
        normal = vector_json(contact->normal);
      }
    }
  }
  result["clearance"] = clearance;
  result["clearance_enclosure"] = around;
  result["time_to_contact"] = time;
  result["time_enclosure"] = enclosure;
  result["contact_point"] = point;
  result["contact_normal"] = normal;
  // The body is then not quite what the file says.
  for (const char* left_out : {"dropped_points", "dropped_faces"})
    if (e.obstacle.notes.contains(left_out)) result[left_out] = e.obstacle.notes[left_out];
  return result;
}

Ellipsoid raised(const Ellipse& body, double height) {
  Eigen::Vector3d center(body.center().x(), body.center().y(), 0);
  if (!body.defined_by_factor()) {
    Eigen::Matrix3d shape = Eigen::Matrix3d::Zero();
    shape.topLeftCorner<2, 2>() = body.shape();
    shape(2, 2) = height * height;
    return Ellipsoid::from_shape(center, shape);
  }
  const Eigen::Matrix2d& f = body.factor();
  const double x = f.col(0).norm(), y = f.col(1).norm();
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  rotation.topLeftCorner<2, 2>() << f.col(0) / x, f.col(1) / y;
  return Ellipsoid::from_axes(center, {x, y, height}, rotation);
}

CombinedEllipsoid raised(const CombinedEllipse& body, double height) {
  std::vector<Delimiter<3>> delimiters;
  for (const Delimiter<2>& d : body.delimiters()) {
    Delimiter<3> cylinder{Eigen::Matrix3d::Zero(), d.level};
    cylinder.matrix.topLeftCorner<2, 2>() = d.matrix;
    delimiters.push_back(cylinder);
  }
  return CombinedEllipsoid::trusted(raised(body.ellipsoid(), height), std::move(delimiters));
}

/// Whether the exact predicates decide; combined quadrics alone are searched.
bool exactly(const input::Engagement& e) { return e.ellipsoids(); }
bool exactly(const input::PlanarEngagement& e) { return e.ellipsoids(); }
bool exactly(const input::AssemblyEngagement&) { return true; }

}  // namespace

input::Engagement raised(const input::PlanarEngagement& e) {
  const double height =
      std::max(e.agent.ellipsoid().semi_axes().maxCoeff(), e.obstacle.ellipsoid().semi_axes().maxCoeff());
  input::Engagement result;
  result.agent = raised(e.agent, height);
  result.obstacle = raised(e.obstacle, height);
  result.agent_velocity << e.agent_velocity, 0;
  result.obstacle_velocity << e.obstacle_velocity, 0;
  return result;
}

AssemblyOracle assembly_oracle(const input::AssemblyEngagement& e) {
  return std::visit(
      [&](const auto& agent) { return AssemblyOracle(agent, e.obstacle.pieces, e.obstacle.pose); }, e.agent);
}

Json answer(const input::AnyEngagement& engagement, bool with_rung) {
  if (const auto* planar = std::get_if<input::PlanarEngagement>(&engagement))
    return answer(raised(*planar), with_rung);
  if (const auto* pieces = std::get_if<input::AssemblyEngagement>(&engagement))
    return assembly_answer(*pieces, with_rung);
  const auto& e = std::get<input::Engagement>(engagement);
  return e.ellipsoids() ? exact_answer(e, with_rung) : certified_answer(e, with_rung);
}

const char* verdict_kind(const input::AnyEngagement& engagement) {
  return std::visit([](const auto& e) { return exactly(e); }, engagement) ? "exact" : "certified";
}

}  // namespace vericone
