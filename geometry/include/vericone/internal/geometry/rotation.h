// SPDX-License-Identifier: BSD-3-Clause
//
// Rotations as bodies see them.
#pragma once

#include <vericone/geometry/pose.h>
#include <cmath>

namespace vericone {

/// Whether the pose does not turn, bit for bit. Throws InputError naming "pose.position[i]" or
/// "pose.rotation" where the pose is none: not finite, or not orthonormal to 1e-12 with determinant +1.
[[nodiscard]] bool is_upright(const Pose& pose);

/// What a body of D dimensions sees of a rotation: a planar one how its x axis turns about z.
template <int D>
[[nodiscard]] Eigen::Matrix<double, D, D> rotation_of(const Eigen::Matrix3d& rotation) {
  if constexpr (D == 3) {
    return rotation;
  } else {
    const double c = rotation(0, 0), s = rotation(1, 0), length = std::hypot(c, s);
    if (!(length > 0)) return Eigen::Matrix2d::Identity();
    return (Eigen::Matrix2d() << c, -s, s, c).finished() / length;
  }
}

}  // namespace vericone
