// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace vericone::fitting {

struct Box3 {
  Eigen::Vector3d center, half_widths;
  Eigen::Matrix3d axes;  // a rotation, one axis a column
  double volume = 0;     // of the sides, each a little longer: flat ones differ too
};

/// Each of the directions is tried as an axis, about which the least rectangle is found (one of its sides is
/// an edge of the shadow's hull); then the axes of the best `followed` are turned about one by one while that
/// makes them smaller.
Box3 small_box(const std::vector<Eigen::Vector3d>& points, const std::vector<Eigen::Vector3d>& directions,
               std::size_t followed);

/// Two directions that make a right-handed frame with the third.
Eigen::Matrix3d frame_about(const Eigen::Vector3d& z);

}  // namespace vericone::fitting
