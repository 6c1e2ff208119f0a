// SPDX-License-Identifier: BSD-3-Clause
//
// The quadrotor's equations of motion.
#pragma once

#include <vericone/vehicles/quadrotor.h>

namespace vericone::vehicles {

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

}  // namespace vericone::vehicles
