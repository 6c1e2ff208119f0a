// SPDX-License-Identifier: BSD-3-Clause
//
// Attitudes of a camera.
#pragma once

#include <vericone/vision/scene/scene.h>

namespace vericone::vision {

/// Looking at a point that is not straight above, the picture's top as far to the north (world y) as can be.
[[nodiscard]] Eigen::Matrix3d looking_at(const Eigen::Vector3d& from, const Eigen::Vector3d& point);

/// The attitude (body x forward, y left, z up, as a Motion's) in which a thrust along z gives an
/// acceleration, m/s^2, at a heading, rad: (4.28). Not defined where the acceleration is that of free fall.
[[nodiscard]] Eigen::Matrix3d attitude_for(const Eigen::Vector3d& acceleration, double heading,
                                           double gravity = 9.81);

}  // namespace vericone::vision
