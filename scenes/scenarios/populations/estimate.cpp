// SPDX-License-Identifier: BSD-3-Clause
#include "scenarios/populations/estimate.h"

#include <vericone/simulation/trials.h>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

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

Bounds bernstein_bounds(const Moments& moments, std::uint64_t count, double largest, double confidence) {
  if (count < 2) return {0, largest};
  const double n = double(count), mean = moments.sum / n;
  const double variance = std::max(moments.squares - n * mean * mean, 0.0) / (n - 1);
  const double risk = std::log(2 / (0.5 * (1 - confidence)));
  const double width = std::sqrt(2 * variance * risk / n) + 7 * largest * risk / (3 * (n - 1));
  return {std::max(mean - width, 0.0), std::min(mean + width, largest)};
}

Estimate estimate_of(const Tally& tally, const Population& population) {
  Estimate found;
  const double n = double(std::max<std::uint64_t>(tally.encounters, 1));
  found.share = tally.sure.sum / n;
  found.exact = !population.weighted() && population.velocities == 1;
  if (found.exact) {
    found.low = found.least = simulation::share_of(tally.in, tally.encounters, kConfidence).low;
    found.high = found.most =
        simulation::share_of(tally.in + tally.undecided, tally.encounters, kConfidence).high;
  } else {
    const double largest = population.largest_weight();
    found.least = bernstein_bounds(tally.sure, tally.encounters, largest).low;
    found.most = std::min(bernstein_bounds(tally.possible, tally.encounters, largest).high, 1.0);
    found.low = gamma_bounds(tally.sure, tally.encounters, largest).low;
    found.high = std::min(gamma_bounds(tally.possible, tally.encounters, largest).high, 1.0);
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
  to.weight += more.weight;
  to.weight_squares += more.weight_squares;
  add(more.sure, to.sure);
  add(more.possible, to.possible);
}

}  // namespace vericone::populations
