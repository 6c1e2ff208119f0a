// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/simulation/pilot.h>

namespace vericone::simulation {

/// Whether one body has passed another, looked at time after time.
class Passage {
 public:
  /// Of a pilot of A. By centres alone: as `passing` says, and of a law that knows no cone.
  Passage(const Track& a, const Track& b, const Pilot& pilot, bool by_centres);

  /// Negative until B is passed: c.V, and once that is not negative V_r_hat of the plane chosen, where there
  /// is one: followed from the time asked before. Where V_r_hat is positive on every plane c.V stands for it.
  /// A placed body may have rooms, and its reference point be anywhere: it is passed when the middle of its
  /// bounds recedes and A is out of them.
  double rate(const Track& a, const Track& b, double t);
  /// From A's reference point to that of B, in place of which a placed B has the middle of its bounds.
  [[nodiscard]] Eigen::Vector3d between(const Track& a, const Track& b, double t) const;

 private:
  /// Metres from A's reference point to the bounds of a placed B, negative within. Requires placed_.
  [[nodiscard]] double outside(const Track& a, const Track& b, double t) const;

  const guidance::GuideOptions* guide_;
  bool by_centres_;
  double reach_;                    // of both bodies, metres
  const Placed* placed_ = nullptr;  // B in its own frame
  guidance::GuideMemory seen_;
};

}  // namespace vericone::simulation
