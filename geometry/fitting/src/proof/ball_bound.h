// SPDX-License-Identifier: BSD-3-Clause
//
// How large a quadratic function gets on a ball, as a bound that holds in spite of rounding.
#pragma once

#include <Eigen/Core>
#include "proof/quadratic_form.h"

namespace vericone::fitting {

/// With g = A x + b, for every t > lambda_max(A), t >= 0 and every w:
///   max { q(x + u) : |u| <= m } <= q(x) + t m^2 + max over u of 2 g.u - u^T (t I - A) u
///                               <= q(x) + t m^2 + w.(g + r) + |r|^2 / (t - lambda_max),  r = g - (t I - A)
///                               w.
/// The best t and w give equality (S-lemma): so this is the maximum but for roundings, whatever the
/// function's signature. t and w come from plain doubles, the bound from intervals.
class BallBound {
 public:
  explicit BallBound(const QuadraticForm& form);

  /// At least max { q(y) : |y - x| <= radius }; infinite where intervals know nothing. At most some roundings
  /// of the largest term too large.
  double greatest_value(const QuadraticForm::At& x, double radius) const;

 private:
  double multiplier(const Eigen::Vector3d& g, double radius) const;

  std::array<std::array<Interval, 3>, 3> a_;
  Eigen::Vector3d lambda_;  // eigenvalues, increasing
  Eigen::Matrix3d vectors_;
  double largest_ = 0;  // certainly not below the largest eigenvalue, nor below 0
};

}  // namespace vericone::fitting
