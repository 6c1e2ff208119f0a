// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/internal/fitting/solids.h>
#include <vector>

namespace vericone::fitting {

/// Of some points those that a convex body around them has to do with, and directions worth trying as axes:
/// principal ones, normals of the hull's largest facets, and an even spread.
struct Corners {
  std::vector<Eigen::Vector3d> points, directions;
};

/// How hard to search: `quick` for comparisons, a few directions and no descent.
enum class Effort { quick, full };

/// Throws InputError naming "points" where there is none.
Corners corners_of(const std::vector<Eigen::Vector3d>& points, Effort effort = Effort::full);

/// small_solid() of corners found before.
Solid small_solid(const Corners& corners, SolidKind kind, Effort effort = Effort::full);

/// The one of least volume of the kinds. Ellipsoids are left out of flat points where there is another kind.
/// Throws InputError naming "points": an ellipsoid alone around points in one plane.
Solid smallest_of(const Corners& corners, const std::vector<SolidKind>& kinds, Effort effort);

}  // namespace vericone::fitting
