// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/geometry/body.h>

namespace vericone::guidance {

inline Placed ball(const Eigen::Vector3d& at, double radius) {
  return {Ellipsoid::from_axes(Eigen::Vector3d::Zero(), Eigen::Vector3d::Constant(radius)), Pose{at}};
}

}  // namespace vericone::guidance
