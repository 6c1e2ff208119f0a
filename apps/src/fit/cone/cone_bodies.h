// SPDX-License-Identifier: BSD-3-Clause
//
// Solid angles of the cones of an ellipsoid as agent and one body, between two numbers, each by the sharpest
// method there is for the body.
#pragma once

#include <vericone/fitting/hull.h>
#include <vericone/internal/cones/assembly/assembly_oracle.h>
#include <functional>
#include <string>
#include <vector>

namespace vericone {

struct BodyCone {
  double low = 0, high = 0;  // steradian
  /// False: the bodies touch or overlap, or nearly do so, and all directions count as colliding.
  bool disjoint = true;
  std::string method;
  /// Closed polygons of directions between what may collide and what is safe. Empty where nothing is safe.
  std::vector<std::vector<Eigen::Vector3d>> outline;
};

struct MapSettings {
  double resolution = 0.01;  // radians
  int threads = 1;
  std::function<bool(double)> progress;  // false stops, which throws Interrupted
};

BodyCone cone_by_map(const DirectionClassifier& classifier, const MapSettings& settings);

BodyCone cone_of_ellipsoid(const Ellipsoid& agent, const Ellipsoid& body);

/// Inner and outer cone to `tolerance`, relative.
BodyCone cone_of_combined(const Ellipsoid& agent, const CombinedEllipsoid& body, double tolerance);

/// `inside`: of the body, not touched by the agent where they are disjoint. The cone is convex, so what it
/// reaches on half-planes about a direction inside of it tells inner and outer polygons (cone_bodies.cpp).
BodyCone cone_of_polyhedron(const Ellipsoid& agent, const HullBody& body, const Eigen::Vector3d& inside);

/// The union of pieces. `settings`: of the map, which is drawn for several pieces only.
BodyCone cone_of_pieces(const Ellipsoid& agent, const std::vector<fitting::Piece>& pieces, double tolerance,
                        const MapSettings& settings);

}  // namespace vericone
