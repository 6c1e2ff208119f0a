// SPDX-License-Identifier: BSD-3-Clause
//
// How much gas to make or to let out.
#pragma once

#include <vericone/vehicles/fish.h>
#include <array>

namespace vericone::vehicles {

/// A height with its first two derivatives.
struct Height {
  double z = 0, w = 0, a = 0;
};

/// (2.5): the gas V_in + V_3, at the surface's pressure, with which the fish has the acceleration `up`. Not
/// limited.
double gas_for(const FishParameters& fish, double depth, double w, double up);

/// Ours: a plan to a height that moves, of limited jerk, and a loop about it. The loop inverts the whole
/// dynamics of (2.5), so the buoyancy's instability is compensated as long as no limit is met.
class DepthKeeper {
 public:
  DepthKeeper(const FishParameters& fish, double pole, double climb)
      : fish_(fish), pole_(pole), climb_(climb) {}

  /// From here on: at `goal` (a height now and its rate) in `seconds`, or as soon as the limits let it.
  /// Heights are over ground, in water that rises at `water_climb`.
  void plan(const FishState& state, double surface, double t, double water_climb, const Height& goal,
            double seconds);

  /// The gas rate to hold for a short time, within the limits.
  double rate(const FishState& state, double surface, double t, double water_climb) const;

  /// The height planned for time t.
  Height planned(double t) const;

 private:
  bool feasible(const std::array<double, 6>& way, double seconds, double depth) const;

  const FishParameters& fish_;
  double pole_, climb_;
  bool begun_ = false;
  double from_ = 0, to_ = 0;     // s
  std::array<double, 6> way_{};  // of the time since from_
  Height after_;                 // at to_
};

}  // namespace vericone::vehicles
