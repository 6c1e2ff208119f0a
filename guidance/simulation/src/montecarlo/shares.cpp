// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/internal/geometry/requires.h>
#include <vericone/simulation/trials.h>
#include <algorithm>
#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/binomial.hpp>

namespace vericone::simulation {

Share share_of(std::uint64_t successes, std::uint64_t trials, double confidence) {
  VERICONE_REQUIRES(successes <= trials && confidence > 0 && confidence < 1, "successes",
                    "more than there are trials, or no confidence",
                    "at most the trials, with a confidence between 0 and 1");
  if (trials == 0) return {};
  const double k = double(successes), n = double(trials), tail = 0.5 * (1 - confidence);
  using Beta = boost::math::beta_distribution<>;
  Share share{k / n, 0, 1};
  if (successes > 0) share.low = quantile(Beta(k, n - k + 1), tail);
  if (successes < trials) share.high = quantile(complement(Beta(k + 1, n - k), tail));
  return share;
}

Paired paired(std::span<const bool> first, std::span<const bool> second) {
  VERICONE_REQUIRES(first.size() == second.size(), "second", "another number of them",
                    "as many as first has");
  Paired result;
  for (std::size_t i = 0; i < std::min(first.size(), second.size()); ++i) {
    result.first_alone += first[i] && !second[i];
    result.second_alone += second[i] && !first[i];
  }
  const double differ = double(result.first_alone + result.second_alone),
               fewer = double(std::min(result.first_alone, result.second_alone));
  if (differ > 0) {
    const boost::math::binomial_distribution<> coin(differ, 0.5);
    result.chance = std::min(1.0, 2 * cdf(coin, fewer));
  }
  return result;
}

}  // namespace vericone::simulation
