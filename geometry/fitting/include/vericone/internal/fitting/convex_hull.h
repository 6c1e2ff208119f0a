// SPDX-License-Identifier: BSD-3-Clause
//
// Convex hulls of points as polyhedra (Qhull): for starts, volumes and pictures. No proof rests on them.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace vericone::fitting {

struct ConvexHull {
  /// Indices of the given points that are corners, increasing.
  std::vector<std::uint32_t> vertices;
  /// Facets cut into triangles, counter-clockwise seen from outside, as indices of the given points.
  std::vector<std::array<std::uint32_t, 3>> triangles;
  double volume = 0;  // m^3
};

/// Points within rounding of the hull of the others may be left out. Time N log N. Throws InputError naming
/// "points" for fewer than four points and for points in one plane.
[[nodiscard]] ConvexHull convex_hull(const std::vector<Eigen::Vector3d>& points);

}  // namespace vericone::fitting
