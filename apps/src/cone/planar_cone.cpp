// SPDX-License-Identifier: BSD-3-Clause
#include "cone/planar_cone.h"

#include <vericone/cones/combined/sector.h>
#include <vericone/geometry/error.h>
#include <numbers>
#include <ostream>

#include "cone/answer.h"
#include "cone/course.h"
#include "input/stopwatch.h"
#include "json/json_value.h"
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

}  // namespace

Json planar_cone_json(const scenes::Scene& scene) {
  const auto start = Clock::now();
  const CombinedSector found = sector_of(*scene.planar);
  const double seconds = seconds_since(start);
  const Sector& s = found.sector;
  Json result{
      {"method", "planar"}, {"relation", to_string(s.relation)}, {"psi", s.psi}, {"theta_b", s.theta_b}};
  const ConeFunction f =
      cone_function(s.psi, s.theta_b, scene.agent.velocity.head<2>(), scene.obstacle.velocity.head<2>());
  // The source's y cannot tell a sector of more than half a turn.
  result["y"] = s.psi <= std::numbers::pi ? Json(f.y) : Json(nullptr);
  result["v_r_hat"] = f.v_r_hat;
  result["v_theta_hat"] = f.v_theta_hat;
  const bool edges = s.relation == Relation::disjoint;
  result["left"] = edges ? edge_json(s.left, found.left_a, found.left_b) : Json(nullptr);
  result["right"] = edges ? edge_json(s.right, found.right_a, found.right_b) : Json(nullptr);
  result["hulls_overlap"] = found.hulls_overlap;
  result["seconds"] = seconds;
  return result;
}

void print_planar_cone(const Json& cone, const scenes::Scene& scene, std::ostream& out) {
  const auto angle = [&](const char* field) {
    const double x = cone[field].get<double>();
    return to_text(x * 180 / std::numbers::pi) + " degrees (" + to_text(x) + " rad)";
  };
  out << "method              planar: common tangents of arcs and corners\n"
      << "bodies              " << cone["relation"].get<std::string>() << '\n'
      << "psi                 " << angle("psi") << '\n'
      << "theta_b             " << angle("theta_b") << '\n'
      << "y                   "
      << (cone["y"].is_null() ? "not defined: psi is more than half a turn" : cone["y"].dump()) << '\n'
      << "V_r_hat             " << cone["v_r_hat"].dump() << " m/s\n";
  for (const char* side : {"left", "right"})
    if (!cone[side].is_null())
      out << side << " edge" << std::string(15 - std::string(side).size(), ' ') << "from "
          << cone[side]["touches_agent"].get<std::string>() << " of the agent to "
          << cone[side]["touches_obstacle"].get<std::string>() << " of the obstacle\n";
  if (cone["hulls_overlap"].get<bool>())
    out << "note                a body reaches into the other's dent: the edges are no tangents of the "
           "hulls\n";
  out << "verdict             " << answer(scene, false)["verdict"].get<std::string>()
      << " (of the scene's velocities, " << verdict_kind(scene) << ")\n"
      << "time                " << cone["seconds"].dump() << " s\n";
}

Json planar_picture(const Json& cone, const scenes::Scene& scene) {
  Json result{{"agent", outline_json(scene.planar->agent)},
              {"obstacle", outline_json(scene.planar->obstacle)}};
  for (const char* field : {"relation", "psi", "theta_b", "left", "right"}) result[field] = cone[field];
  result["course"] = course_json(scene);
  return result;
}

}  // namespace vericone
