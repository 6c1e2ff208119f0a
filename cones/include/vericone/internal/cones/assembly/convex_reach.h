// SPDX-License-Identifier: BSD-3-Clause
//
// The convex cone of an agent and one convex polyhedron, between two polygons.
#pragma once

#include <vericone/cones/cone_geometry.h>
#include <vericone/internal/cones/assembly/assembly_oracle.h>

namespace vericone {

struct ConvexReach {
  Eigen::Vector3d axis;         // unit
  PolyhedralCone inner, outer;  // counter-clockwise about the axis; the true cone is between
};

/// From what the cone reaches on half-planes about a direction `inside` of it (AssemblyOracle::extremes, to
/// `angle` radians). Requires disjoint bodies and a convex obstacle: an assembly of one piece.
[[nodiscard]] ConvexReach convex_reach(const AssemblyOracle& oracle, const Eigen::Vector3d& inside,
                                       int half_planes, double angle);

}  // namespace vericone
