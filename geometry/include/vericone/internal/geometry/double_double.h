// SPDX-License-Identifier: BSD-3-Clause
//
// Unevaluated sums of two doubles: about 31 digits for the residuals of an iterative refinement. Not a number
// type for general use. Correct only in the arithmetic of sound_arithmetic.h. Error-free transformations:
// Dekker 1971, Knuth 1969; see Ogita, Rump, Oishi 2005.
#pragma once

#include <vericone/geometry/sound_arithmetic.h>
#include <cmath>

namespace vericone {

struct DoubleDouble {
  double hi = 0, lo = 0;  // in the unit of the number

  DoubleDouble() = default;
  DoubleDouble(double x) : hi(x) {}  // NOLINT(google-explicit-constructor): a double is one exactly
  DoubleDouble(double h, double l) : hi(h), lo(l) {}

  explicit operator double() const { return hi + lo; }

  /// x + y without error.
  [[nodiscard]] static DoubleDouble two_sum(double x, double y) {
    const double s = x + y, t = s - x;
    return {s, (x - (s - t)) + (y - t)};
  }

  /// x * y without error while |x|, |y| < 1e300 and the product is above 1e-290. Dekker's splitting rather
  /// than fma, which is a library call on processors without it.
  [[nodiscard]] static DoubleDouble two_product(double x, double y) {
    const double p = x * y;
    const auto split = [](double a) {
      const double c = 134217729.0 * a;  // 2^27 + 1
      const double high = c - (c - a);
      return DoubleDouble{high, a - high};
    };
    const DoubleDouble a = split(x), b = split(y);
    return {p, ((a.hi * b.hi - p) + a.hi * b.lo + a.lo * b.hi) + a.lo * b.lo};
  }

  friend DoubleDouble operator+(const DoubleDouble& x, const DoubleDouble& y) {
    const DoubleDouble s = two_sum(x.hi, y.hi), t = two_sum(x.lo, y.lo);
    const DoubleDouble r = two_sum(s.hi, s.lo + t.hi);
    return two_sum(r.hi, r.lo + t.lo);
  }
  friend DoubleDouble operator-(const DoubleDouble& x) { return {-x.hi, -x.lo}; }
  friend DoubleDouble operator-(const DoubleDouble& x, const DoubleDouble& y) { return x + (-y); }
  friend DoubleDouble operator*(const DoubleDouble& x, const DoubleDouble& y) {
    const DoubleDouble p = two_product(x.hi, y.hi);
    return two_sum(p.hi, p.lo + (x.hi * y.lo + x.lo * y.hi));
  }
};

/// x + y + z, off by at most one rounding of the result and one part in 2^50 of that, whatever cancels;
/// not finite where a partial sum is not.
[[nodiscard]] inline double sum_of_three(double x, double y, double z) {
  // Where s + z is rounded it is at least half of s, so that nothing cancels it; otherwise its error is 0.
  const DoubleDouble s = DoubleDouble::two_sum(x, y), t = DoubleDouble::two_sum(s.hi, z);
  return std::isfinite(t.hi) ? t.hi + (t.lo + s.lo) : t.hi;
}

}  // namespace vericone
