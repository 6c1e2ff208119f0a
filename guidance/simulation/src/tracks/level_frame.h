// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/geometry/ellipsoid.h>
#include <Eigen/Core>
#include <cmath>

namespace vericone::simulation {

/// m/s. A slower body has no heading worth keeping.
inline constexpr double kRestSpeed = 1e-3;

/// x axis along the velocity, y axis level (source, (6.5)). A vertical velocity has the azimuth of `last`,
/// and a body at rest its orientation.
inline Eigen::Matrix3d level_frame(const Eigen::Vector3d& velocity, const Eigen::Matrix3d& last) {
  const double speed = velocity.norm(), flat = velocity.head<2>().norm();
  if (!(speed > kRestSpeed)) return last;
  const double azimuth =
      flat > 1e-9 * speed ? std::atan2(velocity.y(), velocity.x()) : std::atan2(-last(0, 1), last(1, 1));
  return rotation_from_heading(azimuth, std::atan2(velocity.z(), flat));
}

}  // namespace vericone::simulation
