// SPDX-License-Identifier: BSD-3-Clause
#include "rounded_quadric.h"

namespace vericone::fitting {

using exact::Rational;

Quadric rounded_quadric(const exact::RationalMatrix<3>& a, const exact::RationalVector<3>& center,
                        double constant, const Eigen::Vector3d& reach) {
  Eigen::Matrix4d q;
  Rational last = constant;
  for (int i = 0; i < 3; ++i) {
    Rational b = 0;
    for (int j = 0; j < 3; ++j) {
      q(i, j) = nearly(a[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)]);
      b -= Rational(q(i, j)) * center[static_cast<std::size_t>(j)];
    }
    q(i, 3) = q(3, i) = nearly(b);
    // The value at the centre is the constant: c = constant - p^T A p - 2 b.p with the rounded A and b.
    last += center[static_cast<std::size_t>(i)] * (b - 2 * Rational(q(i, 3)));
  }
  (void)reach;
  q(3, 3) = rounded_down(last);
  return Quadric(q);
}

Quadric slab(double low, double high) {
  const Rational l = low, h = high, half = (h - l) / 2;
  exact::RationalMatrix<3> a;  // of zeros
  a[2][2] = 1 / (half * half);
  return rounded_quadric(a, {Rational(0), Rational(0), Rational((l + h) / 2)}, -1, {0, 0, 1});
}

}  // namespace vericone::fitting
