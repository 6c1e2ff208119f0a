// SPDX-License-Identifier: BSD-3-Clause
//
// Two bodies in integers.
#pragma once

#include <vericone/geometry/error.h>
#include <vericone/geometry/exact/rational.h>
#include <vericone/internal/geometry/exact/integer.h>

namespace vericone::exact {

/// Two bodies in one unit of length 2^e: the shapes that define them (see BasicEllipsoid), in units of 2^2e,
/// and c = p_B - p_A.
template <int D>
struct PairOnGrid {
  static constexpr int kNone = 1 << 20;
  IntegerMatrix<D> a, b;
  IntegerVector<D> c;
  int exponent = 0;  // e, of bodies in doubles

  /// `finest`: e is no more than that.
  PairOnGrid(const BasicEllipsoid<D>& body_a, const BasicEllipsoid<D>& body_b, int finest = kNone) {
    int e = finest;
    for (const auto* body : {&body_a, &body_b}) {
      for (int i = 0; i < D; ++i) e = std::min(e, grid_exponent(body->center()(i), kNone));
      const bool by_factor = body->defined_by_factor();
      for (int i = 0; i < D; ++i)
        for (int j = 0; j < D; ++j) {
          const int g = grid_exponent(by_factor ? body->factor()(i, j) : body->shape()(i, j), kNone);
          if (g != kNone) e = std::min(e, by_factor ? g : static_cast<int>(std::floor(g / 2.0)));
        }
    }
    exponent = e;
    for (int i = 0; i < D; ++i) c[i] = on_grid(body_b.center()(i), e) - on_grid(body_a.center()(i), e);
    a = shape(body_a, e);
    b = shape(body_b, e);
  }

  /// The unit of length is one part in the common denominator of all lengths and squared lengths.
  PairOnGrid(const RationalBody<D>& body_a, const RationalBody<D>& body_b) {
    Integer common = 1;
    require_ellipsoid(body_a.shape, "a.shape");
    require_ellipsoid(body_b.shape, "b.shape");
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
  static void require_ellipsoid(const RationalMatrix<D>& shape, const char* field) {
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < i; ++j)
        if (shape[i][j] != shape[j][i])
          throw InputError(field, "not symmetric", "symmetric and positive definite");
    if (!positive_definite<D>(shape))
      throw InputError(field, "not positive definite", "symmetric and positive definite");
  }
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
