// SPDX-License-Identifier: BSD-3-Clause
//
// Cones with the apex at the origin given by their edges: size, and a basis to look at them.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <span>
#include <vector>

namespace vericone {

/// An orthonormal basis (e1, e2, axis), right-handed, chosen by the axis alone.
struct AxisFrame {
  Eigen::Vector3d e1, e2, axis;
  /// `direction` need not be a unit vector.
  explicit AxisFrame(const Eigen::Vector3d& direction);

  /// The unit vector across the axis at an azimuth, radians from e1 towards e2.
  [[nodiscard]] Eigen::Vector3d across(double azimuth) const {
    return std::cos(azimuth) * e1 + std::sin(azimuth) * e2;
  }
};

/// A cone spanned by its edges, in order, counter-clockwise about `axis`.
struct PolyhedralCone {
  std::vector<Eigen::Vector3d> directions;  // unit
  double solid_angle = 0;                   // steradian
  double cross_section_area = 0;            // dimensionless: see polygon_section_area
};

}  // namespace vericone
