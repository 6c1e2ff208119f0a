// SPDX-License-Identifier: BSD-3-Clause
//
// The robotic fish of the source's chapter 2: what its equations of motion say, at an instant. What is
// printed, chosen and corrected: docs/explanation/fish.md.
#pragma once

#include <vericone/simulation/vehicle.h>
#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

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

// Bodies that contain the fish however its tail stands, about its centre of mass, x ahead and z up. Why they
// do: docs/explanation/fish.md.

/// Semi-axes (m) of an ellipsoid that contains trunk and tail; of these nearly the one of least volume. Cost:
/// 16 ms.
[[nodiscard]] Eigen::Vector3d ellipsoid_of(const FishParameters& fish);

/// Radius (m) of a ball that contains trunk and tail: the source's R_A, which it does not print.
[[nodiscard]] double sphere_of(const FishParameters& fish);

// The robotic fish as a vehicle of scenarios: its equations, solved, under one of two controls.

enum class FishControl : std::uint8_t {
  /// (2.5)-(2.10): V_3 by inversion, |dV_3/dt| <= gas_rate both ways; every second cycle with the amplitude
  /// whose integrated cycle has the force asked for, and a bias K_y (y - y of the aim); in between no
  /// amplitude,
  /// and the bias less K_alpha1 alpha_1.
  source,
  /// Loops of heading, speed and depth that steer to the aim of the command, else along the velocity that the
  /// accelerations commanded add up to.
  ours,
  /// None: amplitude, bias and gas rate as FishTrial says.
  none,
};

/// What an experiment without control does all the time.
struct FishTrial {
  double amplitude = 0, bias = 0;  // rad
  double gas_rate = 0;             // m^3/s, from the start on
};

struct FishOptions {
  FishParameters parameters;
  double depth = 3;           // m, of the start: the surface is so far above it
  std::optional<double> gas;  // m^3 in the chamber at the start; left out: neutral_gas
  FishControl control = FishControl::ours;
  double gain_y = 1;          // K_y, rad/m
  double gain_alpha = 1;      // K_alpha1, 0 to 1
  double gain_heading = 0.4;  // 1/s: turn rate for an error of the heading
  double gain_speed = 0.5;    // dimensionless, of an error of the mean speed
  double depth_pole = 0.4;    // 1/s, threefold, of the depth loop
  FishTrial trial;
  /// Declared and kept: m/s through the water, at every instant; rad/s of heading, mean over a cycle; m/s up
  /// or down. Left out: what the equations allow.
  std::optional<double> most_speed, most_turn_rate, most_climb;
  double step = 0.005;  // s, the longest of the solver
};

/// Throws InputError naming the field: "mass", "depth", "gas", "gain_y", "limits.speed", ... Cost: 17 ms,
/// the cycles that its control knows by heart; a minute of swimming 0.1 s, one command every 50 ms.
[[nodiscard]] std::shared_ptr<const simulation::VehicleModel> fish(const FishOptions& options);

}  // namespace vericone::vehicles
