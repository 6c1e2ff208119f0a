// SPDX-License-Identifier: BSD-3-Clause
//
// Size of a cone that is given by its edges.
#pragma once

#include <vericone/cones/cone_geometry.h>
#include <span>

namespace vericone {

/// Solid angle, in steradian, of the union of the triangular cones (axis, d_i, d_{i+1}) over the closed
/// polygon of directions, which must wind once counter-clockwise about the axis. For a convex cone that
/// contains the axis this is its solid angle. Directions need not be unit vectors.
[[nodiscard]] double polygon_solid_angle(const Eigen::Vector3d& axis,
                                         std::span<const Eigen::Vector3d> directions);

/// Area of the section by the plane at distance 1 from the apex perpendicular to the axis; dimensionless,
/// times r^2 for a plane at distance r. Infinity when a direction does not point strictly to that plane: the
/// cone is then wider than a half-space allows, and only its solid angle is finite.
[[nodiscard]] double polygon_section_area(const Eigen::Vector3d& axis,
                                          std::span<const Eigen::Vector3d> directions);

}  // namespace vericone
