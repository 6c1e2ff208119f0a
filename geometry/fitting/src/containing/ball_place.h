// SPDX-License-Identifier: BSD-3-Clause
//
// Where a quadratic function is greatest on a ball.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace vericone::fitting {

/// The d of |d| <= radius at which 2 g.d + d^T A d is greatest, for A = diag(lambda): d = (t I - A)^{-1} g
/// for the one t >= lambda_max, t >= 0 that gives it the length of the radius. Where g has no part along the
/// axis of lambda_max there may be two such places, alike but for the sign along it: then the positive one.
template <int D>
Eigen::Matrix<double, D, 1> greatest_in_ball(const Eigen::Matrix<double, D, 1>& lambda,
                                             const Eigen::Matrix<double, D, 1>& g, double radius) {
  Eigen::Index top = 0;
  const double largest = lambda.maxCoeff(&top);
  const Eigen::Matrix<double, D, 1> gap = (largest - lambda.array()).matrix();
  Eigen::Matrix<double, D, 1> d;
  // The inverse of the length is concave in t, so Newton's steps from the left never pass the solution.
  double above = std::max(-largest, 0.0);  // t - lambda_max
  for (int i = 0; i < D; ++i) above = std::max(above, std::abs(g(i)) / radius - gap(i));
  for (int step = 0;; ++step) {
    double slope = 0;
    for (int i = 0; i < D; ++i) {
      d(i) = g(i) == 0 ? 0 : g(i) / (above + gap(i));
      if (d(i) != 0) slope += d(i) * d(i) / (above + gap(i));
    }
    const double square = d.squaredNorm(), length = std::sqrt(square);
    if (step == 50 || !(length > radius * (1 + 1e-15))) break;
    const double next = above + (length / radius - 1) * square / slope;
    if (!(next > above)) break;
    above = next;
  }
  if (largest > 0 && d.norm() < (1 - 1e-9) * radius) {
    d(top) = 0;
    d(top) = std::copysign(std::sqrt(radius * radius - d.squaredNorm()), g(top));
  }
  return d;
}

}  // namespace vericone::fitting
