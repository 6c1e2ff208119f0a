// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/internal/simulation/flying_pilot.h>
#include <vericone/simulation/run.h>

namespace vericone::simulation {

/// Turns towards a goal as laws do that know no obstacle on the way; notes when it points at it.
class Homing {
 public:
  /// The most, and in the last step what is missing.
  void fly(const Instant& now, VehicleCommand& command, Run& run);
  /// Whether it points at its goal from the end of this step on.
  void note(const Instant& now, bool aligned, Run& run);
  void lose() { aligned_ = false; }

 private:
  bool aligned_ = false;
};

}  // namespace vericone::simulation
