// SPDX-License-Identifier: BSD-3-Clause
//
// Ellipsoids in rational numbers. Slow to compile: include it in .cpp files.
#pragma once

#include <vericone/geometry/ellipsoid.h>
#include <vericone/geometry/exact/rational.h>
#include <utility>

namespace vericone::exact {

/// The shape matrix that *defines* the body (see BasicEllipsoid).
template <int D>
[[nodiscard]] RationalMatrix<D> defining_shape(const BasicEllipsoid<D>& body) {
  if (!body.defined_by_factor()) return to_rational<D>(body.shape());
  const RationalMatrix<D> f = to_rational<D>(body.factor());
  RationalMatrix<D> s;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j <= i; ++j) {
      Rational sum = 0;
      for (int k = 0; k < D; ++k) sum += f[i][k] * f[j][k];
      s[i][j] = s[j][i] = sum;
    }
  return s;
}

/// An ellipsoid (D = 3) or ellipse (D = 2) in rational numbers: what BasicEllipsoid is to doubles.
template <int D>
struct RationalBody {
  RationalVector<D> center;
  RationalMatrix<D> shape;  // symmetric, positive definite

  RationalBody() = default;
  RationalBody(RationalVector<D> p, RationalMatrix<D> s) : center(std::move(p)), shape(std::move(s)) {}
  explicit RationalBody(const BasicEllipsoid<D>& body)
      : center(to_rational<D>(body.center())), shape(defining_shape<D>(body)) {}
};

}  // namespace vericone::exact
