// SPDX-License-Identifier: BSD-3-Clause
//
// A quadratic function q(x) = x~^T Q x~, x~ = (x, 1), and its polar form x~^T Q y~: in intervals, and in
// integers where those do not decide. q on a triangle is a quadratic form in the barycentric coordinates,
// whose matrix holds the polar forms of the corners.
#pragma once

#include <vericone/geometry/exact/rational.h>
#include <vericone/geometry/interval.h>
#include <vericone/geometry/quadric.h>
#include <vericone/internal/geometry/exact/integer.h>
#include <array>

#include "proof/squares_form.h"

namespace vericone::fitting {

/// Polar forms of N points, up to one common factor that is positive.
template <int N>
struct ExactPolars {
  exact::IntegerMatrix<N> form;
  int exponent = 0;  // the factor is 2^exponent of what the form's unit is
};

class QuadraticForm {
 public:
  /// Any `near` gives right answers; intervals are narrow for points whose distance from it is of the order
  /// of the body's extent: the expansion about it, exact until it is rounded once, is what they evaluate.
  QuadraticForm(const exact::RationalMatrix<4>& matrix, const Eigen::Vector3d& near);
  QuadraticForm(const Quadric& quadric, const Eigen::Vector3d& near);

  /// What intervals know at a point.
  struct At {
    std::array<Interval, 3> offset, half_gradient;  // x - near; A x + b
    Interval rest, value;                           // x~^T Q y~ = half_gradient . offset(y) + rest
  };
  At at(const Eigen::Vector3d& x) const;
  /// The same with a value that is narrower for thin bodies, at about twice the cost.
  At narrowly_at(const Eigen::Vector3d& x) const;
  static Interval polar(const At& x, const At& y) {
    return x.half_gradient[0] * y.offset[0] + x.half_gradient[1] * y.offset[1] +
           x.half_gradient[2] * y.offset[2] + x.rest;
  }

  template <int N>
  ExactPolars<N> exact_polars(const std::array<Eigen::Vector3d, N>& points) const;
  /// The number that an entry of exact_polars stands for.
  exact::Rational number(const exact::Integer& entry, int exponent) const;

  int exact_sign(const Eigen::Vector3d& x) const { return exact_polars<1>({x}).form[0][0].sign(); }

  /// Whether the quadratic part is positive semidefinite, decided exactly: { q <= 0 } is then convex.
  bool convex() const { return convex_; }

  /// Quadratic part A.
  const std::array<std::array<Interval, 3>, 3>& second() const { return a_; }

  /// -q at the centre, where the gradient vanishes (of cylinders and slabs: at the points of the axis);
  /// rounded.
  double depth() const { return depth_; }
  /// q(x), rounded.
  double approximately(const Eigen::Vector3d& x) const;

 private:
  exact::IntegerMatrix<4> integers_;
  exact::Rational unit_;
  Eigen::Vector3d near_;
  std::array<std::array<Interval, 3>, 3> a_;
  std::array<Interval, 3> b_;
  Interval c_;
  SquaresForm squares_;
  bool convex_ = false;
  double depth_ = 0;
};

}  // namespace vericone::fitting
