// SPDX-License-Identifier: BSD-3-Clause
//
// A quadrotor, (4.25)-(4.29), with all twelve states and limits of thrust and torque, as a vehicle.
#pragma once

#include <vericone/simulation/vehicle.h>
#include <memory>

namespace vericone::vehicles {

struct QuadrotorOptions {
  double mass = 4.3259;                                               // kg (errata 2.4)
  Eigen::Vector3d inertia = Eigen::Vector3d(0.0845, 0.0845, 0.1377);  // kg m^2
  double gain_attitude = 100, gain_rate = 10;                         // N m/rad, N m s/rad, (4.29)
  double most_thrust = 2 * 4.3259 * 9.81;                             // N
  double most_torque = 20;                                            // N m, about each axis
  double most_tilt = 1.2;                                             // rad, of the attitude asked for
  double step = 0.001;                                                // s, the longest of the solver
};

/// Attitude as a Motion's rotation: body x forward, y left, z up; heading along world x, psi_d = 0. Throws
/// InputError naming "mass", ...
[[nodiscard]] std::shared_ptr<const simulation::VehicleModel> quadrotor(const QuadrotorOptions& options);

}  // namespace vericone::vehicles
