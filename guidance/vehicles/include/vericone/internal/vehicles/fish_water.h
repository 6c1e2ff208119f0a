// SPDX-License-Identifier: BSD-3-Clause
//
// The fish in its water: depth, gas, energy, the trunk that its bodies contain.
#pragma once

#include <vericone/vehicles/fish.h>

namespace vericone::vehicles {

/// Depth of a place, m.
[[nodiscard]] inline double depth_of(const FishState& state, double surface) {
  return surface - state.position.z();
}

/// Divisor of (2.5), ratio: surface pressure over that at a depth. A depth above the surface counts as 0.
[[nodiscard]] double compression(const FishParameters& fish, double depth);

/// In the chamber, m^3: never above `chamber`; what would be is on its way out.
[[nodiscard]] double gas_volume(const FishParameters& fish, double gas, double depth);

/// The most gas that the chamber holds at a depth, m^3 at the surface's pressure.
[[nodiscard]] double most_gas(const FishParameters& fish, double depth);

/// Velocity over ground, m/s.
[[nodiscard]] Eigen::Vector3d over_ground(const FishState& state, const simulation::Current& water, double t);

/// 1/2 ((m + m_ax) u^2 + (m + m_ay) v^2 + (J_z + J_a) r^2), J: of swimming, heave left out.
[[nodiscard]] double swimming_energy(const FishParameters& fish, const FishState& state);

/// |alpha_1| never exceeds this, rad: the largest amplitude and the largest bias together.
[[nodiscard]] double most_tail_angle(const FishParameters& fish);

/// Without its tail: the ellipsoid with the areas A_x and A_y of the drag, as long as the body, metres.
struct Trunk {
  double ahead = 0;  // of its centre, m
  Eigen::Vector3d semi_axes = Eigen::Vector3d::Zero();
};

[[nodiscard]] Trunk trunk_of(const FishParameters& fish);

}  // namespace vericone::vehicles
