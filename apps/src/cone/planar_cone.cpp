// SPDX-License-Identifier: BSD-3-Clause
#include "cone/planar_cone.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>
#include <ostream>

#include "cone/verdict_text.h"
#include "input/stopwatch.h"
#include "json/json_value.h"
#include "output/number_text.h"
#include "picture/course.h"
#include "picture/shape_json.h"
#include "solids/flat_body.h"

namespace vericone {
namespace {

SectorEdge edge_of(const PlaneSector& sector, const GrazingEdge& edge, double angle,
                   const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  SectorEdge result;
  result.direction =
      (std::cos(angle) * sector.line_of_sight + std::sin(angle) * sector.across).head<2>().normalized();
  const double side = angle > 0 ? 1 : -1;
  result.normal = side * Eigen::Vector2d(result.direction.y(), -result.direction.x());
  result.point_on_a = (from + edge.on_a).head<2>();
  result.point_on_b = (to + edge.on_b).head<2>();
  return result;
}

/// The raised bodies' cone on the plane.
PlanarCone flat_cone(const scenes::Scene& scene) {
  const Pair pair = scene.pair();
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  PlanarCone cone{{}, pair.relation()};
  Sector& s = cone.found.sector;
  s.psi = cone.relation == Relation::overlapping ? 2 * std::numbers::pi : kNone;
  s.theta_b = kNone;
  if (cone.relation) s.relation = *cone.relation;
  const Eigen::Vector3d from = pair.agent().middle();
  Eigen::Vector3d to = pair.obstacle().middle();
  // A hole may have the agent in its middle: any other point of the obstacle does.
  if (to == from) to += Eigen::Vector3d(pair.obstacle().body.bounds().half_widths().x(), 0, 0);
  const auto found = pair.sector(from, to, Eigen::Vector3d::UnitZ().cross(to - from));
  if (!found) return cone;
  const Eigen::Vector3d& u = found->line_of_sight;
  s.psi = found->psi();
  s.theta_b = std::remainder(std::atan2(u.y(), u.x()) + found->theta_b(), 2 * std::numbers::pi);
  s.left = edge_of(*found, found->left, found->left.angle, from, to);
  s.right = edge_of(*found, found->right, -found->right.angle, from, to);
  cone.found.hulls_overlap = s.psi > std::numbers::pi;
  return cone;
}

/// Ellipses have exact relations, touching included.
CombinedSector sector_of(const scenes::PlanarBodies& e) {
  if (!e.agent.is_ellipsoid() || !e.obstacle.is_ellipsoid()) return combined_sector(e.agent, e.obstacle);
  CombinedSector result;
  result.sector = sector_by_support(e.agent.ellipsoid(), e.obstacle.ellipsoid());
  return result;
}

/// "arc 0", "corner 0 1": the conics as they are numbered in docs/reference/formats.md.
std::string touch_text(const Touch& touch) {
  std::string text = (touch.corner ? "corner " : "arc ") + std::to_string(touch.first);
  if (touch.corner) text += " " + std::to_string(touch.second);
  return text;
}

Json edge_json(const SectorEdge& edge, const Touch& a, const Touch& b) {
  return {{"direction", vector_json(edge.direction)},
          {"point_on_agent", vector_json(edge.point_on_a)},
          {"point_on_obstacle", vector_json(edge.point_on_b)},
          {"touches_agent", touch_text(a)},
          {"touches_obstacle", touch_text(b)}};
}

/// The source's y cannot tell a sector of more than half a turn.
bool has_y(const PlanarCone& cone) { return cone.found.sector.psi <= std::numbers::pi; }

const char* relation_text(const PlanarCone& cone) {
  return cone.relation ? to_string(*cone.relation) : "undecided";
}

Json flat_json(const scenes::SceneBody& body) {
  Json arcs = Json::array();
  for (const auto& outline : input::flat_outlines(body.placed)) {
    Json points = Json::array();
    for (const Eigen::Vector2d& x : outline) points.push_back(vector_json(x));
    arcs.push_back({{"points", points}});
  }
  return {{"center", vector_json(body.placed.middle().head<2>())}, {"arcs", arcs}, {"parts", true}};
}

}  // namespace

PlanarCone planar_cone(const scenes::Scene& scene) {
  const auto start = Clock::now();
  PlanarCone result;
  if (scene.planar) {
    result.found = sector_of(*scene.planar);
    result.relation = result.found.sector.relation;
  } else {
    result = flat_cone(scene);
  }
  result.seconds = seconds_since(start);
  const Sector& s = result.found.sector;
  result.function =
      cone_function(s.psi, s.theta_b, scene.agent.velocity.head<2>(), scene.obstacle.velocity.head<2>());
  return result;
}

Json to_json(const PlanarCone& cone) {
  const CombinedSector& found = cone.found;
  const Sector& s = found.sector;
  Json result{{"method", "planar"},
              {"relation", relation_text(cone)},
              {"psi", number_or_null(s.psi)},
              {"theta_b", number_or_null(s.theta_b)}};
  result["y"] = has_y(cone) ? Json(cone.function.y) : Json(nullptr);
  result["v_r_hat"] = number_or_null(cone.function.v_r_hat);
  result["v_theta_hat"] = number_or_null(cone.function.v_theta_hat);
  const bool edges =
      s.relation == Relation::disjoint && std::isfinite(s.theta_b) &&
      s.psi < 2 * std::numbers::pi * (1 - 1e-12);  // of an agent all around which they are none
  result["left"] = edges ? edge_json(s.left, found.left_a, found.left_b) : Json(nullptr);
  result["right"] = edges ? edge_json(s.right, found.right_a, found.right_b) : Json(nullptr);
  result["hulls_overlap"] = found.hulls_overlap;
  result["seconds"] = cone.seconds;
  return result;
}

void print_text(const PlanarCone& cone, const scenes::Scene& scene, std::ostream& out) {
  const CombinedSector& found = cone.found;
  const Sector& s = found.sector;
  const auto angle = [](double x) {
    return number_text(degrees(x)) + " degrees (" + number_text(x) + " rad)";
  };
  print_verdict(scene, out);
  out << "method              planar: common tangents of "
      << (scene.planar ? "arcs and corners" : "the bodies") << "\nbodies              " << relation_text(cone)
      << '\n';
  if (!std::isnan(s.psi)) out << "cone's angle        " << angle(s.psi) << '\n';
  if (!std::isnan(s.theta_b)) out << "cone's middle       at azimuth " << angle(s.theta_b) << '\n';
  const auto edge = [&](const char* label, const Touch& a, const Touch& b) {
    out << label << "from " << touch_text(a) << " of the agent to " << touch_text(b) << " of the obstacle\n";
  };
  // An ellipse is one arc.
  if (scene.planar && s.relation == Relation::disjoint &&
      !(scene.planar->agent.is_ellipsoid() && scene.planar->obstacle.is_ellipsoid())) {
    edge("left edge           ", found.left_a, found.left_b);
    edge("right edge          ", found.right_a, found.right_b);
  }
  if (found.hulls_overlap)
    out << "note                a body reaches into the other's dent: the edges are no tangents of the "
           "hulls\n";
  out << "time                " << number_text(cone.seconds, 2) << " s\n";
}

Json planar_picture(const Json& cone, const scenes::Scene& scene) {
  Json result;
  if (scene.planar)
    result = {{"agent", outline_json(scene.planar->agent)},
              {"obstacle", outline_json(scene.planar->obstacle)}};
  else
    result = {{"agent", flat_json(scene.agent)}, {"obstacle", flat_json(scene.obstacle)}};
  for (const char* field : {"relation", "psi", "theta_b", "left", "right"}) result[field] = cone[field];
  result["course"] = course_json(scene);
  return result;
}

}  // namespace vericone
