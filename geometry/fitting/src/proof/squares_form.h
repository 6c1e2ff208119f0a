// SPDX-License-Identifier: BSD-3-Clause
//
// A quadratic function as a sum of squares, for values near zero of thin bodies: in coordinates the terms of
// d^T A d are larger than their sum by the square of the ratio of axes, here by the ratio.
#pragma once

#include <vericone/geometry/exact/rational.h>
#include <vericone/geometry/interval.h>
#include <array>

namespace vericone::fitting {

class SquaresForm {
 public:
  SquaresForm() = default;
  /// d^T A d + 2 b.d + c.
  SquaresForm(exact::RationalMatrix<3> a, exact::RationalVector<3> b, exact::Rational c);

  Interval value(const std::array<Interval, 3>& d) const;

 private:
  struct Term {
    std::array<Interval, 3> direction;
    Interval shift, weight;  // weight * (direction . d + shift)^2
  };
  std::array<Term, 3> terms_;
  int count_ = 0;
  std::array<Interval, 3> a_other_, b_;  // what is left where no square can be split off
  Interval c_;
};

}  // namespace vericone::fitting
