// SPDX-License-Identifier: BSD-3-Clause
//
// The robotic fish as a vehicle of scenarios: its equations, solved, under one of two controls.
#pragma once

#include <vericone/simulation/vehicle.h>
#include <vericone/vehicles/fish_dynamics.h>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace vericone::vehicles {

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
