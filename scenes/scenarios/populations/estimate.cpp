// SPDX-License-Identifier: BSD-3-Clause
#include "scenarios/populations/estimate.h"

#include <vericone/simulation/trials.h>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <limits>

namespace vericone::populations {
namespace {

/// Half the chi-squared quantile of 2 k degrees of freedom: of a gamma distribution of shape k.
double gamma_quantile(double shape, double probability) {
  return 0.5 * quantile(boost::math::chi_squared_distribution<>(2 * shape), probability);
}

void add(const Moments& more, Moments& to) {
  to.sum += more.sum;
  to.squares += more.squares;
  to.largest = std::max(to.largest, more.largest);
}

constexpr double kBoldest = 0.9;
constexpr int kBets = 40, kHalvings = 60;

double effective(double sum, double squares) { return squares > 0 ? sum * sum / squares : 0; }

}  // namespace

Bounds gamma_bounds(const Moments& moments, std::uint64_t count, double largest, double confidence) {
  if (count == 0) return {};
  const double tail = 0.5 * (1 - confidence), n = double(count);
  Bounds bounds{0, 0};
  double sum = moments.sum, squares = moments.squares;
  if (sum > 0) bounds.low = squares / sum * gamma_quantile(sum * sum / squares, tail) / n;
  const double next = sum > 0 ? moments.largest : largest;
  sum += next;
  squares += next * next;
  bounds.high = squares / sum * gamma_quantile(sum * sum / squares, 1 - tail) / n;
  return bounds;
}

Bounds betting_bounds(const Moments& moments, std::uint64_t count, double largest, double confidence) {
  if (count == 0) return {0, largest};
  const double n = double(count), mean = std::min(moments.sum / n, largest);
  // The logarithm of what a stake of 1 has become at least, of bets of `side` c / scale on each observation.
  const auto wealth = [&](double m, double scale, double side) {
    double most = -std::numeric_limits<double>::infinity();
    const double sum = side * (moments.sum - n * m);
    const double squares = moments.squares - 2 * m * moments.sum + n * m * m;
    for (int j = 0; j < kBets; ++j) {
      const double c = std::ldexp(kBoldest, -j), bet = c / scale;
      const double psi = -(std::log1p(-c) + c) / (c * c);
      most = std::max(most, bet * sum - psi * bet * bet * squares - std::log((j + 1.0) * (j + 2)));
    }
    return most;
  };
  const double enough = std::log(2 / (1 - confidence));
  // All means from the limit outwards are lost bets: one against a mean further away has won more.
  const auto limit = [&](double in, double out, double otherwise, auto&& lost) {
    if (!lost(out)) return otherwise;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = 0.5 * (in + out);
      (lost(middle) ? out : in) = middle;
    }
    return out;
  };
  return {mean > 0 ? limit(mean, 0x1p-30 * mean, 0, [&](double m) { return wealth(m, m, 1) > enough; }) : 0,
          limit(mean, largest, largest, [&](double m) { return wealth(m, largest, -1) > enough; })};
}

Estimate estimate_of(const Tally& tally, const Population& population) {
  Estimate found;
  const double n = double(std::max<std::uint64_t>(tally.encounters, 1));
  found.share = tally.sure.sum / n;
  found.exact = !population.weighted() && population.velocities == 1;
  if (found.exact) {
    found.low = simulation::share_of(tally.in, tally.encounters, kConfidence).low;
    found.high = simulation::share_of(tally.in + tally.undecided, tally.encounters, kConfidence).high;
    found.covered = {found.low, found.high};
  } else {
    const double largest = population.largest_weight();
    found.low = betting_bounds(tally.sure, tally.encounters, largest).low;
    found.high = std::min(betting_bounds(tally.possible, tally.encounters, largest).high, 1.0);
    found.covered = {gamma_bounds(tally.sure, tally.encounters, largest).low,
                     std::min(gamma_bounds(tally.possible, tally.encounters, largest).high, 1.0)};
  }
  found.effective_hits = effective(tally.sure.sum, tally.sure.squares);
  found.effective_encounters = effective(tally.weight, tally.weight_squares);
  found.mean_weight = tally.weight / n;
  if (n > 1)
    found.mean_weight_error = std::sqrt(
        std::max(tally.weight_squares - n * found.mean_weight * found.mean_weight, 0.0) / (n - 1) / n);
  return found;
}

void add(const Tally& more, Tally& to) {
  to.encounters += more.encounters;
  to.verdicts += more.verdicts;
  to.in += more.in;
  to.overlapping += more.overlapping;
  to.on += more.on;
  to.undecided += more.undecided;
  to.uncovered += more.uncovered;
  to.weight += more.weight;
  to.weight_squares += more.weight_squares;
  add(more.sure, to.sure);
  add(more.possible, to.possible);
}

}  // namespace vericone::populations
