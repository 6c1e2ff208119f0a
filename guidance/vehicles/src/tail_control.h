// SPDX-License-Identifier: BSD-3-Clause
//
// What the tail does in the next cycle.
#pragma once

#include <vericone/simulation/vehicle.h>
#include <vericone/vehicles/fish.h>
#include <Eigen/Core>

#include "cycle_means.h"
#include "tail_drive.h"

namespace vericone::vehicles {

struct TailSetting {
  double amplitude = 0, bias = 0;
};

/// What a cycle was like, known at its end.
struct CyclePast {
  double heading = 0;    // rad, mean
  double turn_rate = 0;  // rad/s, mean
  double speed = 0;      // m/s ahead, mean
};

/// (2.6)-(2.10) with F5, F6: cycle k that begins at t.
TailSetting source_tail(const FishOptions& options, const CycleMeans& means, const FishState& state,
                        const TailDrive& tail, const simulation::VehicleCommand& command, double t, long k);

/// Ours: along a horizontal velocity through the water, m/s.
TailSetting our_tail(const FishOptions& options, const CycleMeans& means, const CyclePast& past,
                     const Eigen::Vector2d& wanted);

}  // namespace vericone::vehicles
