// SPDX-License-Identifier: BSD-3-Clause
//
// The cone of an agent and a body of pieces: how far it reaches around the line between them.
#pragma once

#include <vericone/cones/cone_geometry.h>
#include <vericone/internal/cones/assembly/assembly_oracle.h>
#include <vericone/scenes/scene.h>
#include <iosfwd>
#include <string>
#include <vector>

#include "json/json_forward.h"

namespace vericone {

inline constexpr int kDefaultHalfPlanes = 64;
inline constexpr double kDefaultAngle = 1e-4;  // radians

/// Whether this is the cone of a scene: an ellipsoid or a convex polyhedron before a body of pieces.
bool has_assembly_cone(const scenes::Scene& scene);

Eigen::Vector3d agent_center(const scenes::Scene& scene);  // of a polyhedron: of its bounds

/// Of an ellipsoid or a polyhedron, axis-aligned.
Box bounds_of_agent(const scenes::Scene& scene);

/// What reading found besides the body, as docs/reference/formats.md names it.
void add_reading(Json& result, const scenes::SceneBody& body);

/// What is computed of one engagement, and the oracle that did it.
struct AssemblyCone {
  AssemblyCone(AssemblyOracle prepared, const Eigen::Vector3d& axis, double radians)
      : oracle(std::move(prepared)), frame(axis), tolerance(radians) {}

  AssemblyOracle oracle;
  Relation relation = Relation::disjoint;
  AxisFrame frame;   // axis: from the agent's centre to the middle of the body's bounds
  double tolerance;  // radians
  std::vector<ExtremeDirection>
      extremes;  // half-planes at 2 pi j / n from e1 towards e2; empty unless disjoint
  /// Of all directions no farther from the axis than the extremes' middles, by the trapezoidal rule.
  double envelope = 0;
  Effort effort;
  double seconds_prepared = 0, seconds = 0;  // the oracle and the relation; the extremes

  double azimuth(std::size_t j) const;
  double widest() const;    // radians, upper bound
  int reaching_pi() const;  // half-planes on which the direction away from the body collides
};

/// Throws InputError naming "--planes" (less than 3, more than 100000) or "--tolerance".
AssemblyCone assembly_cone(const scenes::Scene& scene, int half_planes, double tolerance);

/// As docs/reference/formats.md says; without the map and the verdict.
Json to_json(const AssemblyCone& cone, const scenes::Scene& scene);
void print_text(const AssemblyCone& cone, const scenes::Scene& scene, std::ostream& out);

}  // namespace vericone
