// SPDX-License-Identifier: BSD-3-Clause
//
// What a cycle of the tail does on average, by integrating it.
#pragma once

#include <vericone/vehicles/fish.h>
#include <vector>

#include "tail_drive.h"

namespace vericone::vehicles {

/// Steady swimming without bias: mean and highest speed by amplitude, and how fast a bias turns.
class CycleMeans {
 public:
  explicit CycleMeans(const FishParameters& fish);

  /// The amplitude with this mean speed ahead, m/s: 0 to most_amplitude.
  double amplitude_of(double speed) const;
  /// The largest amplitude whose speed never exceeds this.
  double amplitude_below(double highest) const;
  double most_speed() const { return means_.back(); }
  double highest_speed() const { return highest_.back(); }
  /// rad/s of heading for 1 rad of bias at 1 rad of amplitude; negative.
  double turn_gain() const { return turn_gain_; }

 private:
  std::vector<double> amplitudes_, means_, highest_;
  double turn_gain_ = 0;
};

/// The amplitude whose force along the body, tail's less drag, has the mean `force` (N) over the cycle that
/// begins at time t in this state, by bisection of the integrated cycle; the nearest where none has.
double amplitude_for_force(const FishParameters& fish, const FishState& state, const TailDrive& tail,
                           double t, double bias, double force, double most);

}  // namespace vericone::vehicles
