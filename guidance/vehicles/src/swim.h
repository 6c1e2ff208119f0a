// SPDX-License-Identifier: BSD-3-Clause
//
// The fish's equations, solved.
#pragma once

#include <vericone/simulation/curve.h>
#include <vericone/vehicles/fish.h>
#include <functional>

#include "tail_drive.h"

namespace vericone::vehicles {

/// What a fish swims in.
struct Surroundings {
  double surface = 0;  // z, m
  simulation::Current water;
};

/// From `from` to `to`, dopri5 with 1e-11 (m, rad, m/s, rad/s) a step, no step longer than `longest` seconds;
/// the gas made at a constant rate. Gas beyond what the chamber holds escapes; none is let out that is not
/// there. `seen`: every state after a step, with the step's curve.
void swim(const FishParameters& fish, FishState& state, const TailDrive& tail, double gas_rate,
          const Surroundings& around, double from, double to, double longest,
          const std::function<void(const FishState&, const simulation::Curve&)>& seen);

/// The same in fixed steps of Runge and Kutta's fourth order, without curves: for what has only to be
/// foreseen.
void foresee(const FishParameters& fish, FishState& state, const TailDrive& tail, double from, double to,
             double step, const std::function<void(const FishState&, double t)>& seen);

}  // namespace vericone::vehicles
