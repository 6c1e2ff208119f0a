// SPDX-License-Identifier: BSD-3-Clause
//
// Nearest points of outlines, in plain doubles.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace vericone {

/// Of the segment from a to b to x.
template <typename Vector>
[[nodiscard]] Vector nearest_on_segment(const Vector& a, const Vector& b, const Vector& x) {
  const Vector e = b - a;
  const double along = (x - a).dot(e), length2 = e.squaredNorm();
  return along <= 0 ? a : along >= length2 ? b : Vector(a + (along / length2) * e);
}

/// Of the ellipse with these semi-axes about the origin to x, to rounding. With y = |x| the nearest point is
/// s_i^2 y_i / (t + s_i^2) for the largest t with sum (s_i y_i / (t + s_i^2))^2 = 1; the sum falls from
/// infinity beyond its largest pole, where it is convex.
[[nodiscard]] inline Eigen::Vector2d nearest_on_ellipse(const Eigen::Vector2d& semi_axes,
                                                        const Eigen::Vector2d& x) {
  // In units of the shorter axis s, with the longer one r >= 1; u = t + 1 > 0.
  const int shorter = semi_axes.x() <= semi_axes.y() ? 0 : 1;
  const double s = semi_axes(shorter), r = semi_axes(1 - shorter) / s, r2 = r * r;
  const double p = std::abs(x(shorter)) / s, q = std::abs(x(1 - shorter)) / s;
  const double beyond = r2 - 1;
  double near_p = 0, near_q = 0;
  if (p == 0 && beyond > 0 && r * q <= beyond) {
    // On the longer axis, before its centre of curvature: two nearest points, one of them.
    near_q = r2 * q / beyond;
    near_p = std::sqrt(std::max(1 - near_q * near_q / r2, 0.0));
  } else {
    // Each term alone is one at its own end; together they are two at most at the larger one.
    double low = std::max({p, r * q - beyond, 0.0}), high = std::hypot(p, r * q), u = low;
    for (int i = 0; i < 100 && u > 0; ++i) {
      const double a = p / u, b = r * q / (u + beyond), f = a * a + b * b;
      const double slope = 2 * (a * a / u + b * b / (u + beyond));
      (f >= 1 ? low : high) = u;
      // Newton on 1 / sqrt(f) = 1, a concave function: from the left it does not overshoot.
      const double next = u + 2 * f * (std::sqrt(f) - 1) / slope;
      if (next == u) break;
      const double last = u;
      u = next > low && next < high ? next : 0.5 * (low + high);
      if (std::abs(u - last) <= 1e-16 * u) break;
    }
    if (u > 0) {
      near_p = p / u;
      near_q = r2 * q / (u + beyond);
    } else {
      near_p = 1;
    }
  }
  Eigen::Vector2d near;
  near(shorter) = std::copysign(s * near_p, x(shorter));
  near(1 - shorter) = std::copysign(s * near_q, x(1 - shorter));
  return near;
}

}  // namespace vericone
