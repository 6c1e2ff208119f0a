// SPDX-License-Identifier: BSD-3-Clause
//
// Exact arithmetic of the last rung of the predicates: doubles as integers on a common power-of-two grid. A
// homogeneous polynomial of the inputs then needs neither division nor common factors, which is what makes
// rationals slow. Slow to compile: include it in .cpp files.
#pragma once

#include <vericone/geometry/exact/rational.h>
#include <vericone/internal/geometry/requires.h>
#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>

namespace vericone::exact {

// Without expression templates: a result of `auto` or of a conditional is a number, not a reference to
// temporaries.
using Integer =
    boost::multiprecision::number<boost::multiprecision::cpp_int_backend<>, boost::multiprecision::et_off>;

template <int D>
using IntegerVector = std::array<Integer, D>;
template <int D>
using IntegerMatrix = std::array<std::array<Integer, D>, D>;

/// The largest e for which x is a multiple of 2^e; `none` for 0. Requires a finite x.
[[nodiscard]] inline int grid_exponent(double x, int none) {
  VERICONE_REQUIRES(std::isfinite(x));
  if (x == 0) return none;
  int e = 0;
  const double m = std::frexp(x, &e);  // x = m 2^e, |m| in [1/2, 1)
  auto bits = static_cast<std::int64_t>(std::ldexp(m, 53));
  e -= 53;
  while ((bits & 1) == 0) {
    bits /= 2;
    ++e;
  }
  return e;
}

/// x / 2^e, where x is a multiple of 2^e.
[[nodiscard]] inline Integer on_grid(double x, int e) {
  if (x == 0) return 0;
  int shift = 0;
  const double m = std::frexp(x, &shift);
  Integer bits(static_cast<std::int64_t>(std::ldexp(m, 53)));
  shift -= 53 + e;
  if (shift >= 0) return bits << static_cast<unsigned>(shift);
  const bool negative = bits < 0;
  if (negative) bits = -bits;
  bits >>= static_cast<unsigned>(-shift);
  return negative ? Integer(-bits) : bits;
}

/// A vector on the finest grid that its entries need; its direction is what counts.
template <int D>
[[nodiscard]] IntegerVector<D> direction_on_grid(const Eigen::Matrix<double, D, 1>& v) {
  constexpr int kNone = 1 << 20;
  int e = kNone;
  for (int i = 0; i < D; ++i) e = std::min(e, grid_exponent(v(i), kNone));
  IntegerVector<D> r;
  for (int i = 0; i < D; ++i) r[i] = on_grid(v(i), e);
  return r;
}

/// x - y, without rounding, up to a positive factor.
template <int D>
[[nodiscard]] IntegerVector<D> difference_on_grid(const Eigen::Matrix<double, D, 1>& x,
                                                  const Eigen::Matrix<double, D, 1>& y) {
  constexpr int kNone = 1 << 20;
  int e = kNone;
  for (int i = 0; i < D; ++i) e = std::min({e, grid_exponent(x(i), kNone), grid_exponent(y(i), kNone)});
  IntegerVector<D> r;
  for (int i = 0; i < D; ++i) r[i] = on_grid(x(i), e) - on_grid(y(i), e);
  return r;
}

/// The direction of a rational vector.
template <int D>
[[nodiscard]] IntegerVector<D> direction_on_grid(const RationalVector<D>& v) {
  Integer common = 1;
  for (const Rational& x : v) common = lcm(common, denominator(x));
  IntegerVector<D> r;
  for (int i = 0; i < D; ++i) r[i] = numerator(v[i]) * (common / denominator(v[i]));
  return r;
}

}  // namespace vericone::exact
