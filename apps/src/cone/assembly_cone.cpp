// SPDX-License-Identifier: BSD-3-Clause
#include "cone/assembly_cone.h"

#include <vericone/geometry/error.h>
#include <vericone/internal/scenes/words.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <ostream>

#include "input/stopwatch.h"
#include "json/json_value.h"
#include "output/number_text.h"

namespace vericone {
namespace {

using std::numbers::pi;

Eigen::Vector3d axis_of(const scenes::Scene& scene) {
  const Eigen::Vector3d axis = scene.obstacle.placed.middle() - agent_center(scene);
  return axis.norm() > 0 ? axis : Eigen::Vector3d(1, 0, 0);
}

/// Sum over the sectors between half-planes of 1 - cos of the angle.
double envelope_of(const std::vector<ExtremeDirection>& extremes) {
  double sum = 0;
  for (const ExtremeDirection& x : extremes)
    if (x.any) sum += 1 - std::cos(0.5 * (x.low + x.high));
  return 2 * pi * sum / static_cast<double>(extremes.size());
}

AssemblyOracle oracle_of(const scenes::Scene& scene) {
  const Assembly& pieces = *scene.obstacle.pieces();
  const Pose& pose = scene.obstacle.placed.pose;
  if (const Ellipsoid* ellipsoid = scene.agent.ellipsoid()) return {*ellipsoid, pieces, pose};
  const Pose& own = scene.agent.placed.pose;
  return {in_world(*scene.agent.hull(), {Eigen::Vector3d::Zero(), own.rotation}), pieces, pose, own.position};
}

}  // namespace

bool has_assembly_cone(const scenes::Scene& scene) {
  return !scene.obstacle.field.empty() && (scene.agent.ellipsoid() || scene.agent.hull());
}

Box bounds_of_agent(const scenes::Scene& scene) {
  if (const Ellipsoid* ellipsoid = scene.agent.ellipsoid()) {
    const Eigen::Vector3d half = ellipsoid->factor().rowwise().norm();
    return {ellipsoid->center() - half, ellipsoid->center() + half};
  }
  const HullBody hull = in_world(*scene.agent.hull(), scene.agent.placed.pose);
  const auto& points = hull.points();
  Box bounds{points.front(), points.front()};
  for (const Eigen::Vector3d& x : points) bounds.include({x, x});
  return bounds;
}

Eigen::Vector3d agent_center(const scenes::Scene& scene) {
  const Ellipsoid* ellipsoid = scene.agent.ellipsoid();
  return ellipsoid ? ellipsoid->center() : Eigen::Vector3d(bounds_of_agent(scene).center());
}

void add_reading(Json& result, const scenes::SceneBody& body) {
  if (!body.reading) return;
  const scenes::Reading& reading = *body.reading;
  result["format"] = reading.format;
  if (reading.dropped_points) result["dropped_points"] = reading.dropped_points;
  if (reading.dropped_faces) result["dropped_faces"] = reading.dropped_faces;
  if (reading.unreferenced_points) result["unreferenced_points"] = reading.unreferenced_points;
  if (reading.map) {
    result["cell"] = reading.map->cell;
    result["map_nodes"] = reading.map->nodes;
    result["unknown"] = reading.map->unknown_occupied ? "occupied" : "free";
  }
  if (reading.trailing_bytes) result["trailing_bytes"] = reading.trailing_bytes;
  result["notes"] = scenes::reading_words(reading);
  result["seconds_read"] = reading.seconds_read;
  result["seconds_built"] = reading.seconds_built;
}

double AssemblyCone::azimuth(std::size_t j) const {
  return 2 * pi * static_cast<double>(j) / static_cast<double>(extremes.size());
}

double AssemblyCone::widest() const {
  double most = 0;
  for (const ExtremeDirection& x : extremes)
    if (x.any) most = std::max(most, x.high);
  return most;
}

int AssemblyCone::reaching_pi() const {
  return static_cast<int>(std::count_if(extremes.begin(), extremes.end(), [&](const ExtremeDirection& x) {
    return x.any && x.high >= pi - tolerance;
  }));
}

AssemblyCone assembly_cone(const scenes::Scene& scene, int half_planes, double tolerance) {
  constexpr int kLeast = 3, kMost = 100'000;
  if (half_planes < kLeast || half_planes > kMost)
    throw InputError("--planes", std::to_string(half_planes), "between 3 and 100000 half-planes");
  if (!(tolerance >= 1e-13 && tolerance <= 1))
    throw InputError("--tolerance", to_text(tolerance), "between 1e-13 and 1 radians for a body of pieces");
  const auto start = Clock::now();
  AssemblyCone cone(oracle_of(scene), axis_of(scene), tolerance);
  cone.relation = cone.oracle.relation();
  cone.seconds_prepared = seconds_since(start);
  if (cone.relation != Relation::disjoint) return cone;
  const auto prepared = Clock::now();
  cone.extremes = cone.oracle.extremes(cone.frame.axis, half_planes, tolerance, &cone.effort);
  cone.envelope = envelope_of(cone.extremes);
  cone.seconds = seconds_since(prepared);
  return cone;
}

Json to_json(const AssemblyCone& cone, const scenes::Scene& scene) {
  const Assembly& pieces = *scene.obstacle.pieces();
  Json obstacle{{"source", scene.obstacle.field},
                {"file", scene.obstacle.file.empty() ? Json(nullptr) : Json(scene.obstacle.file)},
                {"pieces", pieces.size()},
                {"piece", to_string(pieces.kind())},
                {"bounds", {vector_json(pieces.bounds().low), vector_json(pieces.bounds().high)}}};
  add_reading(obstacle, scene.obstacle);
  Json extremes = Json::array(), directions = Json::array();
  for (std::size_t j = 0; j < cone.extremes.size(); ++j) {
    const ExtremeDirection& x = cone.extremes[j];
    extremes.push_back({{"azimuth", cone.azimuth(j)},
                        {"low", x.any ? Json(x.low) : Json(nullptr)},
                        {"high", x.any ? Json(x.high) : Json(nullptr)}});
    directions.push_back(x.any ? vector_json(x.direction) : Json(nullptr));
  }
  const bool disjoint = cone.relation == Relation::disjoint;
  return {{"method", "certified"},
          {"half_planes", cone.extremes.size()},
          {"tolerance", cone.tolerance},
          {"relation", to_string(cone.relation)},
          {"obstacle", obstacle},
          {"axis", vector_json(cone.frame.axis)},
          {"e1", vector_json(cone.frame.e1)},
          {"e2", vector_json(cone.frame.e2)},
          {"directions", disjoint ? directions : Json(nullptr)},
          {"extremes", disjoint ? extremes : Json(nullptr)},
          {"half_planes_reaching_pi", disjoint ? Json(cone.reaching_pi()) : Json(nullptr)},
          {"envelope_solid_angle", disjoint ? Json(cone.envelope) : Json(nullptr)},
          {"effort",
           {{"nodes", cone.effort.nodes},
            {"pieces", cone.effort.pieces},
            {"exact", cone.effort.exact},
            {"hierarchy_nodes", pieces.hierarchy().nodes().size()}}},
          {"seconds_prepared", cone.seconds_prepared},
          {"seconds", cone.seconds}};
}

void print_text(const AssemblyCone& cone, const scenes::Scene& scene, std::ostream& out) {
  out << "method              certified, " << cone.extremes.size() << " half-planes, tolerance "
      << number_text(cone.tolerance) << " rad\n"
      << "obstacle            " << scene.obstacle.name << '\n'
      << "bodies              " << to_string(cone.relation) << '\n';
  if (cone.relation != Relation::disjoint) return;
  double narrowest = pi;
  int none = 0;
  for (const ExtremeDirection& x : cone.extremes) {
    if (!x.any) ++none;
    narrowest = std::min(narrowest, x.any ? x.low : 0);
  }
  const int all_around = cone.reaching_pi();
  if (all_around == static_cast<int>(cone.extremes.size())) {
    out << "surrounded          on all half-planes the cone reaches 180 degrees; --map says what is free\n";
  } else {
    out << "extreme directions  " << number_within(degrees(narrowest), degrees(cone.tolerance)) << " to "
        << number_within(degrees(cone.widest()), degrees(cone.tolerance)) << " degrees from the axis\n";
    if (none) out << "                    " << none << " half-planes without a colliding direction\n";
    if (all_around)
      out << "surrounded          on " << all_around
          << " half-planes the cone reaches 180 degrees; --map says what is free\n";
    out << "envelope            " << number_text(cone.envelope, 4)
        << " sr within the extreme directions, holes included, from the half-planes alone\n";
  }
  const auto nodes = static_cast<double>(scene.obstacle.pieces()->hierarchy().nodes().size());
  const double a_plane = static_cast<double>(cone.effort.nodes) / static_cast<double>(cone.extremes.size());
  char share[32];
  std::snprintf(share, sizeof share, "%.2g", 100 * a_plane / nodes);
  out << "effort              " << std::llround(a_plane) << " boxes a half-plane, " << share
      << " % of the hierarchy; " << cone.effort.pieces << " pieces in all, " << cone.effort.exact
      << " exactly\n";
}

}  // namespace vericone
