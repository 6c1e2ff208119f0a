// SPDX-License-Identifier: BSD-3-Clause
//
// Directions of velocities and accelerations.
#pragma once

#include <vericone/guidance/kinematics.h>

namespace vericone::guidance {

/// The angle (rad) that differs from `angle` by whole turns and from `near` by at most half a turn: for
/// histories without jumps.
[[nodiscard]] double unwrapped(double angle, double near);

/// Of a vector; where it is vertical or zero, an angle that has no value is that of `otherwise`.
[[nodiscard]] Direction direction_of(const Eigen::Vector3d& v, const Direction& otherwise = {});

[[nodiscard]] Eigen::Vector3d unit_vector(const Direction& direction);  // unit, as it says

[[nodiscard]] DirectedAcceleration directed(const Eigen::Vector3d& acceleration);

}  // namespace vericone::guidance
