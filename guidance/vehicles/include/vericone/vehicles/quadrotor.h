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

/// The twelve states, or their rates.
struct QuadrotorState {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // m, in our world, z up
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // U, V, W: m/s, in the body's axes, z down
  Eigen::Vector3d rates = Eigen::Vector3d::Zero();     // P, Q, R: rad/s, in the body's axes
  Eigen::Vector3d angles = Eigen::Vector3d::Zero();    // phi, theta, psi: rad, roll, pitch and yaw, z down
};

/// What the rotors do: F along -z of the body, N, and torques about its axes, N m.
struct Wrench {
  double thrust = 0;
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();
};

/// What a wanted acceleration asks of thrust and attitude, (4.28).
struct ThrustAndTilt {
  double thrust = 0;           // N
  double roll = 0, pitch = 0;  // rad, phi_d and theta_d
};

/// (4.25) with drag, and the kinematics that print leaves out (errata 4.3). `air`: its velocity in our world,
/// m/s. Not defined at a pitch of 90 degrees.
[[nodiscard]] QuadrotorState quadrotor_rates(const QuadrotorOptions& quadrotor, const QuadrotorState& state,
                                             const Wrench& wrench,
                                             const Eigen::Vector3d& air = Eigen::Vector3d::Zero());

/// (4.26)-(4.28) for an acceleration in our world, m/s^2, at the heading of the state; print has the heading
/// 0. The sign traps: a_z of print is down and its y to the right. Within most_tilt and most_thrust, height
/// first: what is left of the thrust goes aside. The least force upwards is a tenth of the weight, so that
/// the tilt is defined.
[[nodiscard]] ThrustAndTilt thrust_and_tilt(const QuadrotorOptions& quadrotor, const QuadrotorState& state,
                                            const Eigen::Vector3d& acceleration);

/// (4.29), with the yaw wanted, psi_d, rad; print has 0. Within most_thrust and most_torque.
[[nodiscard]] Wrench quadrotor_wrench(const QuadrotorOptions& quadrotor, const QuadrotorState& state,
                                      const ThrustAndTilt& wanted, double yaw);

/// Body axes (orthonormal) as a Motion has them, x forward, y left, z up.
[[nodiscard]] Eigen::Matrix3d quadrotor_rotation(const QuadrotorState& state);

/// Starts level, with the heading of the body's x axis, which it keeps; the accelerations of commands steer,
/// aims do not. Between two settings of thrust and torques, which are `period` apart from the start on, its
/// way is one curve. After ten seconds of commands that jump, the default step is 1e-7 m and 2e-9 rad off the
/// equations. A current moves it by its drag, and not without; in one that moves launch() throws an
/// InputError naming "vehicle" where drag is 0 or gusts are shorter than ten periods. No speed is the
/// highest, so every limit is infinite. Throws as check() does; advance() throws an InputError naming
/// "vehicle" where it tumbles, at a pitch of 86 degrees. Cost: 0.5 us for each step of the solver.
[[nodiscard]] std::shared_ptr<const simulation::VehicleModel> quadrotor(const QuadrotorOptions& options);

}  // namespace vericone::vehicles
