// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace vericone {

/// Where a body stands: x_W = position + rotation x_B for a point x_B of the body's own frame; metres.
struct Pose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  // orthonormal, determinant +1

  [[nodiscard]] Eigen::Vector3d to_world(const Eigen::Vector3d& x) const { return position + rotation * x; }
  [[nodiscard]] Eigen::Vector3d to_body(const Eigen::Vector3d& x) const {
    return rotation.transpose() * (x - position);
  }
};

/// Whether the pose does not turn, bit for bit. Throws InputError naming "pose.position[i]" or
/// "pose.rotation" where the pose is none: not finite, or not orthonormal to 1e-12 with determinant +1.
[[nodiscard]] bool is_upright(const Pose& pose);

}  // namespace vericone
