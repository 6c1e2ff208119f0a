// SPDX-License-Identifier: BSD-3-Clause
//
// What laws promise, and on how many random states it is asked of them.
#pragma once

#include <vericone/guidance/laws.h>
#include <vericone/testing/random_bodies.h>
#include <cmath>
#include <cstddef>

namespace vericone::testing {

inline constexpr std::size_t kStates = 1000;

inline double relative_error(double rate, double wanted) {
  return std::abs(rate - wanted) / std::abs(wanted);
}

inline guidance::LawOptions random_options(RandomBodies& random) {
  guidance::LawOptions options;
  options.gain = random.uniform(0.5, 5);
  options.reference = random.uniform(0, 0.1);
  return options;
}

/// y' = -K (y - w).
inline double wanted_rate(const guidance::ConeRates& f, const guidance::LawOptions& options) {
  return -options.gain * (f.y - options.reference);
}

}  // namespace vericone::testing
