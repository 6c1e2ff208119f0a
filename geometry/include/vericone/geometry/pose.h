// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace vericone {

/// Where a body stands: x_W = position + rotation x_B for a point x_B of the body's own frame; metres.
struct Pose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  // orthonormal, determinant +1

  Eigen::Vector3d to_world(const Eigen::Vector3d& x) const { return position + rotation * x; }
  Eigen::Vector3d to_body(const Eigen::Vector3d& x) const { return rotation.transpose() * (x - position); }
};

}  // namespace vericone
