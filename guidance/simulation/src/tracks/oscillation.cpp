// SPDX-License-Identifier: BSD-3-Clause
//
// k(t): values, rates and bounds.
#include <vericone/simulation/track.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace vericone::simulation {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();

/// Bounds of sin over [x, y], x <= y, for any arguments off by at most `error`.
Oscillation::Range sine_range(double x, double y, double error) {
  using std::numbers::pi;
  const double sx = std::sin(x), sy = std::sin(y), widening = error + 4 * kEps;
  // Whether a number offset + 2 pi n is in the interval, in doubt yes.
  const auto holds = [&](double offset) {
    const double from = (x - error - offset) / (2 * pi), to = (y + error - offset) / (2 * pi);
    const double doubt = 4 * kEps * (1 + std::abs(from) + std::abs(to));
    return std::floor(to + doubt) >= from - doubt;
  };
  return {holds(-pi / 2) ? -1 : std::max(-1.0, std::min(sx, sy) - widening),
          holds(pi / 2) ? 1 : std::min(1.0, std::max(sx, sy) + widening)};
}

}  // namespace

double Oscillation::at(double t) const {
  const double k = offset + amplitude * std::sin(rate * t + phase);
  return absolute ? std::abs(k) : k;
}

double Oscillation::rate_at(double t) const {
  const double x = rate * t + phase, slope = amplitude * rate * std::cos(x);
  if (!absolute) return slope;
  const double k = offset + amplitude * std::sin(x);
  const double rounding = 4 * kEps * (std::abs(offset) + std::abs(amplitude) * (1 + std::abs(x)));
  // Nothing tells on which side of a corner a time within rounding of it is: the side after it, where it
  // rises.
  return std::abs(k) <= rounding ? std::abs(slope) : std::copysign(1.0, k) * slope;
}

Oscillation::Range Oscillation::range(double from, double to) const {
  const double x = rate * from + phase, y = rate * to + phase;
  const double error = 4 * kEps * (std::abs(x) + std::abs(y) + std::abs(phase)) + kEps;
  const Range sine = sine_range(std::min(x, y), std::max(x, y), error);
  double low = offset + std::min(amplitude * sine.low, amplitude * sine.high);
  double high = offset + std::max(amplitude * sine.low, amplitude * sine.high);
  const double rounding = 4 * kEps * (std::abs(offset) + std::abs(amplitude));
  if (absolute) {
    const double least = low > 0 ? low : high < 0 ? -high : 0;
    high = std::max(std::abs(low), std::abs(high));
    low = least;
    return {std::max(0.0, low - rounding), high + rounding};
  }
  return {low - rounding, high + rounding};
}

}  // namespace vericone::simulation
