// SPDX-License-Identifier: BSD-3-Clause
//
// The matrix that defines a body, in rational numbers.
#pragma once

#include <vericone/geometry/exact/rational.h>

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

}  // namespace vericone::exact
