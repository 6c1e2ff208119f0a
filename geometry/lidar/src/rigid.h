// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace vericone::lidar {

/// A finite rotation (orthonormal to 1e-6) and translation.
inline bool is_rigid(const Eigen::Isometry3d& pose) {
  const Eigen::Matrix3d r = pose.linear();
  return pose.matrix().allFinite() &&
         (r.transpose() * r - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < 1e-6 &&
         r.determinant() > 0;
}

}  // namespace vericone::lidar
