// SPDX-License-Identifier: BSD-3-Clause
#include "cone/planar_cone.h"

#include <numbers>
#include <ostream>

#include "cone/verdict_text.h"
#include "input/stopwatch.h"
#include "json/json_value.h"
#include "output/number_text.h"
#include "picture/course.h"
#include "picture/shape_json.h"

namespace vericone {
namespace {

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

}  // namespace

PlanarCone planar_cone(const scenes::Scene& scene) {
  const auto start = Clock::now();
  PlanarCone result{sector_of(*scene.planar)};
  result.seconds = seconds_since(start);
  const Sector& s = result.found.sector;
  result.function =
      cone_function(s.psi, s.theta_b, scene.agent.velocity.head<2>(), scene.obstacle.velocity.head<2>());
  return result;
}

Json to_json(const PlanarCone& cone) {
  const CombinedSector& found = cone.found;
  const Sector& s = found.sector;
  Json result{
      {"method", "planar"}, {"relation", to_string(s.relation)}, {"psi", s.psi}, {"theta_b", s.theta_b}};
  result["y"] = has_y(cone) ? Json(cone.function.y) : Json(nullptr);
  result["v_r_hat"] = cone.function.v_r_hat;
  result["v_theta_hat"] = cone.function.v_theta_hat;
  const bool edges = s.relation == Relation::disjoint;
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
  out << "method              planar: common tangents of arcs and corners\n"
      << "bodies              " << to_string(s.relation) << '\n'
      << "cone's angle        " << angle(s.psi) << '\n'
      << "cone's middle       at azimuth " << angle(s.theta_b) << '\n';
  const auto edge = [&](const char* label, const Touch& a, const Touch& b) {
    out << label << "from " << touch_text(a) << " of the agent to " << touch_text(b) << " of the obstacle\n";
  };
  // An ellipse is one arc.
  if (s.relation == Relation::disjoint &&
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
  Json result{{"agent", outline_json(scene.planar->agent)},
              {"obstacle", outline_json(scene.planar->obstacle)}};
  for (const char* field : {"relation", "psi", "theta_b", "left", "right"}) result[field] = cone[field];
  result["course"] = course_json(scene);
  return result;
}

}  // namespace vericone
