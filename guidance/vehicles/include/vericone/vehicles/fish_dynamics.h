// SPDX-License-Identifier: BSD-3-Clause
//
// The robotic fish of the source's chapter 2: what its equations of motion say, at an instant. What is
// printed, chosen and corrected: docs/explanation/fish.md.
#pragma once

#include <vericone/simulation/current.h>
#include <Eigen/Core>
#include <numbers>

namespace vericone::vehicles {

/// SI units, radians. Printed by the source: mass, length, chamber, gas_rate; the others are chosen.
struct FishParameters {
  double density = 1000, gravity = 9.81, pressure = 101325;  // kg/m^3, m/s^2, Pa at the surface
  double mass = 0.8;                                         // kg
  double length = 0.32;                                      // m, of body and tail
  double tail_chord = 0.08, tail_span = 0.06;                // m: C and L of (2.6)
  double hinge = 0.10;                                       // m, of the tail behind the centre of mass
  double frequency = 1;                                      // Hz
  double most_amplitude = std::numbers::pi / 180 * 35;       // of A_m
  double most_bias = std::numbers::pi / 180 * 51;
  double blend = 0.4;  // s, in which amplitude and bias go to new values: a jump would be a blow
  double drag_x = 0.457, area_x = 5.5e-3;           // C_Dx; A_x, m^2
  double drag_y = 1.2, area_y = 1.54e-2;            // C_Dy; A_y, m^2
  double added_x = 0.08, added_y = 0.50;            // kg
  double inertia = 3.6e-3, added_inertia = 2.0e-3;  // kg m^2
  double drag_turn = 5e-4;                          // K_r, N m s^2
  double drag_plate = 0;                            // C_n
  double drag_z = 1.655;                            // C_Dz of (2.5), kg/m: for a dive of 0.6 m in 5.00 s
  double chamber = 9e-6;                            // m^3
  double neutral_gas = 6e-6;                  // m^3 in the chamber, with which it neither sinks nor rises
  double gas_rate = 1e-7, valve_rate = 3e-5;  // m^3/s at the surface's pressure: made, and let out
};

/// Throws InputError naming the field.
void check(const FishParameters& fish);

/// World z is up, heading from x towards y; the body's axes are x ahead, y to its left. Velocities are those
/// through the water. `gas`: V_in + V_3 of (2.5), at the surface's pressure.
struct FishState {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // m
  double heading = 0;                                  // rad
  double u = 0, v = 0, r = 0, w = 0;                   // m/s ahead, to the left; rad/s; m/s up
  double gas = 0;                                      // m^3
};

/// alpha_1 and its derivatives: rad, rad/s, rad/s^2. Positive: the tail's end is on the right, y < 0.
struct TailAngle {
  double angle = 0, rate = 0, acceleration = 0;
};

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

/// N and N m, in the body's axes.
struct FishForces {
  double tail_normal = 0;                     // F_n, along (-sin alpha_1, cos alpha_1)
  double tail_x = 0, tail_y = 0, tail_n = 0;  // X_T, Y_T, N_T
  double drag_x = 0, drag_y = 0, drag_n = 0;  // against u, v, r
  double lift = 0, drag_z = 0;                // buoyancy less weight, up; against w
};
[[nodiscard]] FishForces fish_forces(const FishParameters& fish, const FishState& state,
                                     const TailAngle& tail, double surface);

/// d/dt of a state in moving water; `gas` is the rate given. Cost: 70 ns.
[[nodiscard]] FishState fish_rates(const FishParameters& fish, const FishState& state, const TailAngle& tail,
                                   double gas_rate, double surface, const simulation::Current& water,
                                   double t);

/// Velocity over ground, m/s.
[[nodiscard]] Eigen::Vector3d over_ground(const FishState& state, const simulation::Current& water, double t);

/// 1/2 ((m + m_ax) u^2 + (m + m_ay) v^2 + (J_z + J_a) r^2), J: of swimming, heave left out.
[[nodiscard]] double swimming_energy(const FishParameters& fish, const FishState& state);

}  // namespace vericone::vehicles
