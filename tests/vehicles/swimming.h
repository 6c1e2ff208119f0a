// SPDX-License-Identifier: BSD-3-Clause
//
// Fish that swim, for tests.
#pragma once

#include <vericone/vehicles/fish.h>
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <vector>

namespace vericone::vehicles {

inline constexpr double kDegree = std::numbers::pi / 180;

/// Channels of the log, in their order.
enum Channel { kU, kV, kR, kW, kHeading, kDepth, kAmplitude, kBias, kAngle, kV3, kGasRate, kGas };

/// A run of one fish, logged at every step.
struct Flown {
  double step = 0;
  std::vector<std::vector<double>> log;
  std::vector<simulation::Motion> motions;
  std::vector<simulation::Curve> way;
  std::optional<simulation::LimitBroken> broken;

  std::size_t index(double t) const { return std::size_t(std::lround(t / step)); }
  double mean_speed(double from, double to) const {
    double sum = 0;
    for (std::size_t i = index(from); i < index(to); ++i) sum += log[i][kU];
    return sum / double(index(to) - index(from));
  }
  double mean_turn(double from, double to) const {
    return (log[index(to)][kHeading] - log[index(from)][kHeading]) / (to - from);
  }
};

/// `command` of time and motion, at steps of 5 ms.
template <typename Command>
Flown fly(const FishOptions& options, double seconds, const Command& command,
          const simulation::Motion& start = {}, const simulation::Current& water = {}, double step = 0.005) {
  Flown flown;
  flown.step = step;
  const auto model = fish(options);
  const auto vehicle = model->launch(start, 0, water);
  const long steps = std::lround(seconds / step);
  for (long k = 0;; ++k) {
    vehicle->log(flown.log.emplace_back());
    flown.motions.push_back(vehicle->motion());
    if (k == steps) break;
    vehicle->advance(command(double(k) * step, vehicle->motion()), double(k) * step, double(k + 1) * step,
                     flown.way);
  }
  flown.broken = vehicle->broken();
  return flown;
}

inline Flown fly(const FishOptions& options, double seconds, const simulation::Motion& start = {},
                 const simulation::Current& water = {}) {
  return fly(
      options, seconds, [](double, const simulation::Motion&) { return simulation::VehicleCommand{}; }, start,
      water);
}

/// Amplitude and bias in degrees all the time.
inline FishOptions trial(double amplitude, double bias, double gas_rate = 0) {
  FishOptions options;
  options.control = FishControl::none;
  options.trial = {amplitude * kDegree, bias * kDegree, gas_rate};
  return options;
}

}  // namespace vericone::vehicles
