// SPDX-License-Identifier: GPL-3.0-or-later
#include <vericone/internal/verify/spatial/enclosed_real.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "two_sum.h"

namespace vericone::verify {
namespace {

/// 2 pi as an unevaluated sum; the remainder is below 6e-33.
constexpr double kTwoPi = 2 * std::numbers::pi;
constexpr double kTwoPiLow = 2.4492935982947064e-16;

}  // namespace

double EnclosedReal::error(double value, double value_low) const {
  const TwoSum d(value, -parts_[0]);
  return d.sum + (d.rest + ((value_low - parts_[1]) - parts_[2]));
}

double EnclosedReal::angle_error(double value, double value_low) const {
  const TwoSum d(value, -parts_[0]);
  const double turns = std::round((d.sum + (value_low - parts_[1])) / kTwoPi);
  const TwoSum reduced(d.sum, -turns * kTwoPi);  // the product is exact for |turns| <= 2
  return reduced.sum + (reduced.rest + (d.rest + ((value_low - parts_[1]) - parts_[2] - turns * kTwoPiLow)));
}

double EnclosedReal::ulps_off(double value) const {
  const double size = std::abs(parts_[0]);
  if (size == 0) return value == 0 ? 0 : std::numeric_limits<double>::infinity();
  return std::abs(error(value)) / (std::nextafter(size, std::numeric_limits<double>::infinity()) - size);
}

double EnclosedReal::relative_error(double value) const {
  if (parts_[0] == 0) return value == 0 ? 0 : std::numeric_limits<double>::infinity();
  return std::abs(error(value) / parts_[0]);
}

}  // namespace vericone::verify
