// SPDX-License-Identifier: BSD-3-Clause
//
// What an error of position has to hit: the sum of two ellipses, in units of the error's deviations.
#pragma once

#include <vericone/geometry/ellipsoid.h>
#include <Eigen/Core>
#include <cmath>

namespace vericone::gaussian {

/// The sum of the bodies seen along w, about `x`, `y`. Its boundary is
///   p(t) = (ax q1 + bx q2, ay q1 + by q2),  q = (l1 c/sqrt(l) + m1 c/sqrt(m), l2 s/sqrt(l) + m2 s/sqrt(m)),
/// with c, s = cos t, sin t, l = l1 c^2 + l2 s^2, m likewise: q is the sum of two ellipses along the same
/// axes, nearly round, as l1 + m1 = l2 + m2 = 1, and (c, s) its normal there; ax by - ay bx > 0.
/// The error is standard normal, or (`flat`) lies along the axis of x, where it is standard normal.
class Shadow {
 public:
  Shadow(const Ellipsoid& a, const Ellipsoid& b, const Eigen::Vector3d& w, const Eigen::Matrix3d& covariance);

  struct Point {
    double x, y;  // about the centre
    double turn;  // p'(t) = turn M (-s, c)
  };
  Point point(double c, double s) const {
    const double l = l1 * c * c + l2 * s * s, m = m1 * c * c + m2 * s * s;
    const double il = 1 / std::sqrt(l), im = m > 0 ? 1 / std::sqrt(m) : 0;
    const double q1 = c * (l1 * il + m1 * im), q2 = s * (l2 * il + m2 * im);
    return {ax * q1 + bx * q2, ay * q1 + by * q2, l1 * l2 * il * il * il + m1 * m2 * im * im * im};
  }

  bool flat = false, still = false;  // no error at all
  /// Of a flat error what the bodies may be smaller or larger for the error across it, as a part of
  /// them, but for this probability.
  double smear = 0, beside = 0;
  double x, y;
  double ax, bx, ay, by;
  double l1, l2, m1, m2;
  /// By how much lengths may be off, relative.
  double rounding;
};

}  // namespace vericone::gaussian
