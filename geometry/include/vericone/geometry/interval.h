// SPDX-License-Identifier: BSD-3-Clause
//
// Intervals for the middle rung of the predicates and for certified constructions: a midpoint and a radius,
// rounded to nearest throughout. No change of the rounding mode, hence no compiler flag without which they
// would be wrong, no global state, and no cost at entry. See Rump, "Fast and parallel interval arithmetic",
// BIT 39 (1999). Correct only in the arithmetic of sound_arithmetic.h.
#pragma once

#include <vericone/geometry/sign.h>
#include <vericone/geometry/sound_arithmetic.h>
#include <vericone/internal/geometry/requires.h>
#include <algorithm>
#include <cmath>
#include <limits>

namespace vericone {

/// The real numbers [mid - rad, mid + rad]. Every operation returns an interval that contains the exact
/// result for all numbers in its operands. An overflow makes the radius infinite or NaN, and then nothing is
/// decided any more: an answer is never wrong.
///
/// Why the radii are right: rounding to nearest makes an error of at most u |result| + 2^-1075, u = 2^-53;
/// radii are sums and products of non-negative numbers, computed with at most eight roundings of their own,
/// which the factor kInflate covers, and kTiny covers all losses by underflow. Proved by tests that carry a
/// rational number along with each interval (tests/geometry/interval_test.cpp).
class Interval {
 public:
  static constexpr double kUnitRoundoff = 0x1p-53;
  static constexpr double kInflate = 1 + 0x1p-49;
  static constexpr double kTiny = 0x1p-1000;

  constexpr Interval() = default;
  constexpr Interval(double exact) : mid_(exact) {}  // NOLINT(google-explicit-constructor): one is exactly it
  constexpr Interval(double mid, double rad) : mid_(mid), rad_(rad) {
    VERICONE_REQUIRES(!(rad < 0), "rad", "less", "0 or more");
  }

  /// The hull of two numbers. Requires lo <= hi, or one that is none.
  [[nodiscard]] static Interval between(double lo, double hi) {
    VERICONE_REQUIRES(!(lo > hi), "lo", "above hi", "at most hi");
    const double mid = 0.5 * lo + 0.5 * hi;
    return {mid, std::max(hi - mid, mid - lo) * kInflate + kTiny};
  }

  [[nodiscard]] double mid() const { return mid_; }
  [[nodiscard]] double rad() const { return rad_; }
  /// Bounds as doubles, rounded outwards.
  [[nodiscard]] double lo() const { return rad_ == 0 ? mid_ : down(mid_ - rad_); }
  [[nodiscard]] double hi() const { return rad_ == 0 ? mid_ : -down(-mid_ - rad_); }
  /// The largest absolute value.
  [[nodiscard]] double magnitude() const { return (std::abs(mid_) + rad_) * kInflate; }
  [[nodiscard]] bool contains(double x) const { return lo() <= x && x <= hi(); }
  [[nodiscard]] bool finite() const { return std::isfinite(mid_) && std::isfinite(rad_); }

  [[nodiscard]] FilteredSign sign() const {
    return mid_ > rad_    ? FilteredSign::positive
           : mid_ < -rad_ ? FilteredSign::negative
                          : FilteredSign::uncertain;
  }
  [[nodiscard]] bool positive() const { return mid_ > rad_; }
  [[nodiscard]] bool negative() const { return mid_ < -rad_; }

  Interval operator-() const { return {-mid_, rad_}; }

  friend Interval operator+(const Interval& x, const Interval& y) {
    const double m = x.mid_ + y.mid_;
    return {m, (x.rad_ + y.rad_ + kUnitRoundoff * std::abs(m)) * kInflate + kTiny};
  }
  friend Interval operator-(const Interval& x, const Interval& y) { return x + (-y); }
  friend Interval operator*(const Interval& x, const Interval& y) {
    const double m = x.mid_ * y.mid_;
    return {m,
            (std::abs(x.mid_) * y.rad_ + x.rad_ * (std::abs(y.mid_) + y.rad_) + kUnitRoundoff * std::abs(m)) *
                    kInflate +
                kTiny};
  }
  /// Infinite radius where the divisor may be zero.
  friend Interval operator/(const Interval& x, const Interval& y) {
    const double q = x.mid_ / y.mid_, least = (std::abs(y.mid_) - y.rad_) * (1 - 0x1p-49);
    if (!(least > kTiny)) return {0, std::numeric_limits<double>::infinity()};
    // x'/y' - xm/ym = ((x' - xm) - (xm/ym) (y' - ym)) / y'; q itself is off by u |q|.
    const double spread = x.rad_ + (std::abs(q) + kTiny) * y.rad_ + kTiny;
    return {q, (spread / least + kUnitRoundoff * std::abs(q)) * kInflate + kTiny};
  }

  /// Of the non-negative part; the radius is NaN where there is none.
  [[nodiscard]] friend Interval sqrt(const Interval& x) {
    const double lo = std::max(x.lo(), 0.0), hi = x.hi();
    // A rounded square root is off by less than one part in 2^52; its neighbours bound it.
    return between(lo > 0 ? std::sqrt(lo) * (1 - 0x1p-52) : 0, std::sqrt(hi) * (1 + 0x1p-51) + kTiny);
  }
  [[nodiscard]] friend Interval square(const Interval& x) {
    const Interval s = x * x;
    return s.lo() >= 0 ? s : between(0, s.hi());
  }

 private:
  /// Below x, for any double x that came from one rounding.
  [[nodiscard]] static double down(double x) {
    return std::nextafter(x, -std::numeric_limits<double>::infinity());
  }

  double mid_ = 0, rad_ = 0;
};

/// The smallest interval that contains both, in their unit.
[[nodiscard]] inline Interval hull(const Interval& x, const Interval& y) {
  return Interval::between(std::min(x.lo(), y.lo()), std::max(x.hi(), y.hi()));
}

}  // namespace vericone
