// SPDX-License-Identifier: BSD-3-Clause
//
// The source's bars: they hide what they cover, and stand again ahead of the UAS once they have left its
// picture (errata 4.3).
#pragma once

#include <vericone/simulation/curve.h>
#include <vericone/vision/pursuit/pursuit.h>
#include <random>
#include <vector>

namespace vericone::vision {

class Bars {
 public:
  Bars(const FlyingBars& bars, std::uint64_t seed);
  /// Whether any stands elsewhere now. `own`: of the UAS, whose simulator this is.
  bool step(const simulation::Motion& own, const Camera& camera, double t);
  /// The bars with others.
  [[nodiscard]] std::vector<Occluder> with(const std::vector<Occluder>& others) const;

 private:
  FlyingBars options_;
  std::mt19937_64 random_;
  std::vector<Occluder> bars_;
};

}  // namespace vericone::vision
