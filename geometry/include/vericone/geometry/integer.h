// SPDX-License-Identifier: BSD-3-Clause
//
// Exact arithmetic of the last rung of the predicates: doubles as integers on a common power-of-two grid. A
// homogeneous polynomial of the inputs then needs neither division nor common factors, which is what makes
// rationals slow. Slow to compile: include it in .cpp files.
#pragma once

#include <vericone/geometry/ellipsoid.h>
#include <vericone/geometry/rational.h>
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

/// The largest e for which the finite x is a multiple of 2^e; `none` for 0.
inline int grid_exponent(double x, int none) {
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
inline Integer on_grid(double x, int e) {
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
IntegerVector<D> direction_on_grid(const Eigen::Matrix<double, D, 1>& v) {
  constexpr int kNone = 1 << 20;
  int e = kNone;
  for (int i = 0; i < D; ++i) e = std::min(e, grid_exponent(v(i), kNone));
  IntegerVector<D> r;
  for (int i = 0; i < D; ++i) r[i] = on_grid(v(i), e);
  return r;
}

/// x - y, without rounding, up to a positive factor.
template <int D>
IntegerVector<D> difference_on_grid(const Eigen::Matrix<double, D, 1>& x,
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
IntegerVector<D> direction_on_grid(const RationalVector<D>& v) {
  Integer common = 1;
  for (const Rational& x : v) common = lcm(common, denominator(x));
  IntegerVector<D> r;
  for (int i = 0; i < D; ++i) r[i] = numerator(v[i]) * (common / denominator(v[i]));
  return r;
}

/// Two bodies in one unit of length 2^e: the shapes that define them (see BasicEllipsoid), in units of 2^2e,
/// and c = p_B - p_A.
template <int D>
struct PairOnGrid {
  IntegerMatrix<D> a, b;
  IntegerVector<D> c;

  PairOnGrid(const BasicEllipsoid<D>& body_a, const BasicEllipsoid<D>& body_b) {
    constexpr int kNone = 1 << 20;
    int e = kNone;
    for (const auto* body : {&body_a, &body_b}) {
      for (int i = 0; i < D; ++i) e = std::min(e, grid_exponent(body->center()(i), kNone));
      const bool by_factor = body->defined_by_factor();
      for (int i = 0; i < D; ++i)
        for (int j = 0; j < D; ++j) {
          const int g = grid_exponent(by_factor ? body->factor()(i, j) : body->shape()(i, j), kNone);
          if (g != kNone) e = std::min(e, by_factor ? g : static_cast<int>(std::floor(g / 2.0)));
        }
    }
    for (int i = 0; i < D; ++i) c[i] = on_grid(body_b.center()(i), e) - on_grid(body_a.center()(i), e);
    a = shape(body_a, e);
    b = shape(body_b, e);
  }

  /// The unit of length is one part in the common denominator of all lengths and squared lengths.
  PairOnGrid(const RationalBody<D>& body_a, const RationalBody<D>& body_b) {
    Integer common = 1;
    for (const auto* body : {&body_a, &body_b})
      for (int i = 0; i < D; ++i) {
        common = lcm(common, denominator(body->center[i]));
        for (int j = 0; j < D; ++j) common = lcm(common, denominator(body->shape[i][j]));
      }
    const auto whole = [](const Rational& x) { return Integer(numerator(x) / denominator(x)); };
    for (int i = 0; i < D; ++i) {
      c[i] = whole((body_b.center[i] - body_a.center[i]) * common);
      for (int j = 0; j < D; ++j) {
        a[i][j] = whole(body_a.shape[i][j] * common * common);
        b[i][j] = whole(body_b.shape[i][j] * common * common);
      }
    }
  }

 private:
  static IntegerMatrix<D> shape(const BasicEllipsoid<D>& body, int e) {
    IntegerMatrix<D> s;
    if (!body.defined_by_factor()) {
      for (int i = 0; i < D; ++i)
        for (int j = 0; j < D; ++j) s[i][j] = on_grid(body.shape()(i, j), 2 * e);
      return s;
    }
    IntegerMatrix<D> f;
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) f[i][j] = on_grid(body.factor()(i, j), e);
    for (int i = 0; i < D; ++i)
      for (int j = 0; j <= i; ++j) {
        s[i][j] = 0;
        for (int k = 0; k < D; ++k) s[i][j] += f[i][k] * f[j][k];
        s[j][i] = s[i][j];
      }
    return s;
  }
};

}  // namespace vericone::exact
