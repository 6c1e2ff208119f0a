// SPDX-License-Identifier: BSD-3-Clause
//
// A quadrotor, (4.25)-(4.29), with all twelve states and limits of thrust and torque, as a vehicle. Its
// equations are those of the source, whose frames have z down: body x forward, y right, z down; world x, -y,
// -z of ours.
#pragma once

#include <vericone/simulation/vehicle.h>
#include <Eigen/Core>
#include <memory>

namespace vericone::vehicles {

struct QuadrotorOptions {
  double mass = 4.3259;                                               // kg (errata 4.3)
  Eigen::Vector3d inertia = Eigen::Vector3d(0.0845, 0.0845, 0.1377);  // kg m^2
  double gravity = 9.81;                                              // m/s^2
  double gain_attitude = 100, gain_rate = 10;                         // N m/rad, N m s/rad, (4.29)
  double most_thrust = 2 * 4.3259 * 9.81;                             // N
  double most_torque = 20;                                            // N m, about each axis
  double most_tilt = 1.2;                                             // rad, of the attitude asked for
  /// N s/m along each of the body's axes: the air's force for each m/s that it goes past the body. (4.25) has
  /// none.
  Eigen::Vector3d drag = Eigen::Vector3d::Zero();
  double period = 0.01;  // s, for which thrust and torques are held (the source's step)
  double step = 0.001;   // s, the longest of the solver
};

/// Throws InputError naming "mass", "inertia[i]", ..., "period" (longer than the attitude loop bears). What
/// follows expects options of which this is true.
void check(const QuadrotorOptions& options);

/// Starts level, with the heading of the body's x axis, which it keeps; the accelerations of commands steer,
/// aims do not. Between two settings of thrust and torques, which are `period` apart from the start on, its
/// way is one curve. After ten seconds of commands that jump, the default step is 1e-7 m and 2e-9 rad off the
/// equations. A current moves it by its drag, and not without; in one that moves launch() throws an
/// InputError naming "vehicle" where drag is 0 or gusts are shorter than ten periods. No speed is the
/// highest, so every limit is infinite. Throws as check() does; advance() throws an InputError naming
/// "vehicle" where it tumbles, at a pitch of 86 degrees. Cost: 0.5 us for each step of the solver.
[[nodiscard]] std::shared_ptr<const simulation::VehicleModel> quadrotor(const QuadrotorOptions& options);

}  // namespace vericone::vehicles
