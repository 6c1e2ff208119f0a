// SPDX-License-Identifier: BSD-3-Clause
#include "tracks/sign_change.h"

#include <algorithm>
#include <cmath>

namespace vericone::simulation {

// The method of Oliveira and Takahashi (ITP, ACM TOMS 47 (2021)): never more than one step beyond what
// halving takes, and a handful where the value is smooth. Values of -1 and 1 are halved.
double sign_change(const std::function<double(double)>& value, double from, double to) {
  const double at_end = value(to), width = 0.5e-12 * (to - from);
  const bool end = at_end >= 0;
  double low = from, high = to, at_low = value(from), at_high = at_end;
  constexpr int kHalvings = 40;
  for (int k = 0; k <= kHalvings && high - low > 2 * width; ++k) {
    const double middle = low + (high - low) / 2, half = middle - low;
    double at = middle;
    const double chord = low + (high - low) * at_low / (at_low - at_high);
    if (std::isfinite(chord)) {
      const double towards = middle >= chord ? 1 : -1,
                   aside = 0.2 * (high - low) * (high - low) / (to - from);
      if (aside <= std::abs(middle - chord)) at = chord + towards * aside;
      const double room = std::ldexp(width, kHalvings + 1 - k) - half;
      if (!(std::abs(at - middle) <= room)) at = middle - towards * std::max(room, 0.0);
    }
    if (!(at > low && at < high)) at = middle;
    if (!(at > low && at < high)) break;
    const double v = value(at);
    if (!std::isfinite(v) || (v >= 0) == end) {
      high = at;
      at_high = v;
    } else {
      low = at;
      at_low = v;
    }
  }
  return high;
}

}  // namespace vericone::simulation
