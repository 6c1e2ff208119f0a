// SPDX-License-Identifier: BSD-3-Clause
//
// How probable an outcome is under two laws on the same encounters, with weights.
#pragma once

#include <cstdint>
#include <span>

#include "scenarios/encounters/near_miss.h"
#include "scenarios/populations/estimate.h"

namespace vericone::encounters {

struct Risk {
  double share = 0;
  populations::Bounds bounds;  // 95 %
};

/// The weighted share of encounters with the outcome, by gamma_bounds() on what each contributes; without
/// weights, all 1, by Clopper and Pearson. `mean`: of the weights, 1 where they come of drawing; of a table
/// that of its own, so that its weights count as known. `undecided` counts as no for the low bound, as yes
/// for the high one, as no for the share. `largest`: a weight that none exceeds.
[[nodiscard]] Risk risk_of(std::span<const Entered> outcomes, std::span<const double> weights, double mean,
                           double largest);

struct RiskRatio {
  double ratio = 0;            // NaN where the second never has the outcome
  populations::Bounds bounds;  // 95 %; high is infinite where the second may never have it
};

/// The first law's risk by the second's. Encounters with the outcome under both, under the first alone and
/// under the second alone are three sums; each is within its gamma_bounds() of confidence 1 - 0.05 / 3, so
/// all three are together with 95 % whatever depends on what, and the bounds are the least and the largest
/// ratio then. What both share narrows it.
[[nodiscard]] RiskRatio risk_ratio(std::span<const Entered> first, std::span<const Entered> second,
                                   std::span<const double> weights, double largest);

}  // namespace vericone::encounters
