// SPDX-License-Identifier: BSD-3-Clause
#include "scenarios/encounters/risk.h"

#include <vericone/simulation/trials.h>
#include <algorithm>
#include <array>
#include <limits>

namespace vericone::encounters {
namespace {

using populations::Bounds, populations::gamma_bounds, populations::kConfidence, populations::Moments;

bool counts(Entered outcome, bool undecided) {
  return outcome == Entered::yes || (undecided && outcome == Entered::undecided);
}

/// Both, the first alone, the second alone.
using Classes = std::array<Moments, 3>;

Classes classes_of(std::span<const Entered> first, std::span<const Entered> second,
                   std::span<const double> weights, bool first_undecided, bool second_undecided) {
  Classes all;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const bool a = counts(first[i], first_undecided), b = counts(second[i], second_undecided);
    if ((a || b) && weights[i] > 0) all[a && b ? 0 : a ? 1 : 2].add(weights[i]);
  }
  return all;
}

}  // namespace

Risk risk_of(std::span<const Entered> outcomes, std::span<const double> weights, double mean,
             double largest) {
  Moments sure, possible;
  std::uint64_t yes = 0, maybe = 0;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    yes += counts(outcomes[i], false);
    maybe += counts(outcomes[i], true);
    if (counts(outcomes[i], false) && weights[i] > 0) sure.add(weights[i]);
    if (counts(outcomes[i], true) && weights[i] > 0) possible.add(weights[i]);
  }
  const std::uint64_t n = outcomes.size();
  if (std::all_of(weights.begin(), weights.end(), [](double w) { return w == 1; }))
    return {
        n ? double(yes) / double(n) : 0,
        {simulation::share_of(yes, n, kConfidence).low, simulation::share_of(maybe, n, kConfidence).high}};
  return {sure.sum / (double(n) * mean),
          {gamma_bounds(sure, n, largest).low / mean,
           std::min(gamma_bounds(possible, n, largest).high / mean, 1.0)}};
}

RiskRatio risk_ratio(std::span<const Entered> first, std::span<const Entered> second,
                     std::span<const double> weights, double largest) {
  const auto bounds_of = [&](const Classes& classes) {
    std::array<Bounds, 3> bounds;
    for (std::size_t k = 0; k < 3; ++k)
      bounds[k] = gamma_bounds(classes[k], weights.size(), largest, 1 - (1 - kConfidence) / 3);
    return bounds;
  };
  constexpr double kAny = std::numeric_limits<double>::infinity();
  const auto by = [](double a, double b) { return b > 0 ? a / b : kAny; };
  // What is undecided helps neither bound.
  const auto low = bounds_of(classes_of(first, second, weights, false, true)),
             high = bounds_of(classes_of(first, second, weights, true, false));
  const Classes seen = classes_of(first, second, weights, false, false);
  const double below = seen[0].sum + seen[2].sum;
  return {below > 0 ? (seen[0].sum + seen[1].sum) / below : std::numeric_limits<double>::quiet_NaN(),
          {std::min(by(low[0].low + low[1].low, low[0].low + low[2].high),
                    by(low[0].high + low[1].low, low[0].high + low[2].high)),
           std::max(by(high[0].low + high[1].high, high[0].low + high[2].low),
                    by(high[0].high + high[1].high, high[0].high + high[2].low))}};
}

}  // namespace vericone::encounters
