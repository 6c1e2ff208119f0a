// SPDX-License-Identifier: BSD-3-Clause
#include "proof/squares_form.h"

#include "proof/rational_quadric.h"

namespace vericone::fitting {

using exact::Rational;

// Completing squares, the largest diagonal entry first: with a_k = A_kk and l = row k of A / a_k, the square
// a_k (l.d + b_k / a_k)^2 takes row and column k and b_k out of the function.
SquaresForm::SquaresForm(exact::RationalMatrix<3> a, exact::RationalVector<3> b, Rational c) {
  for (int step = 0; step < 3; ++step) {
    std::size_t k = 0;
    for (std::size_t i = 1; i < 3; ++i)
      if (abs(a[i][i]) > abs(a[k][k])) k = i;
    if (a[k][k].sign() == 0) break;
    const Rational pivot = a[k][k];
    exact::RationalVector<3> l;
    for (std::size_t i = 0; i < 3; ++i) l[i] = a[k][i] / pivot;
    const Rational shift = b[k] / pivot;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) a[i][j] -= pivot * l[i] * l[j];
      b[i] -= pivot * l[i] * shift;
    }
    c -= pivot * shift * shift;
    Term& term = terms_[static_cast<std::size_t>(count_++)];
    term.weight = enclosed(pivot);
    term.shift = enclosed(shift);
    for (std::size_t i = 0; i < 3; ++i) term.direction[i] = enclosed(l[i]);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    a_other_[i] = enclosed(Rational(2 * a[i][(i + 1) % 3]));
    b_[i] = enclosed(Rational(2 * b[i]));
  }
  c_ = enclosed(c);
}

Interval SquaresForm::value(const std::array<Interval, 3>& d) const {
  Interval sum = c_;
  if (count_ < 3)
    for (std::size_t i = 0; i < 3; ++i) sum = sum + d[i] * (b_[i] + a_other_[i] * d[(i + 1) % 3]);
  for (int k = 0; k < count_; ++k) {
    const Term& t = terms_[static_cast<std::size_t>(k)];
    sum = sum +
          t.weight * square(t.direction[0] * d[0] + t.direction[1] * d[1] + t.direction[2] * d[2] + t.shift);
  }
  return sum;
}

}  // namespace vericone::fitting
