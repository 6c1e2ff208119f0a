// SPDX-License-Identifier: BSD-3-Clause
//
// Chapters 3 and 4 term by term: as printed, and as corrected where the print is wrong
// (docs/reference/errata.md). Written from the print, not from the library, which uses other forms.
#pragma once

#include <vericone/guidance/pursuit/source_laws.h>
#include <cmath>

#include "guidance/motion.h"
#include "guidance/printed_formulas.h"

namespace vericone::testing {

/// (3.4): the gradients of y_1, y_2 by (r, theta, V_theta, V_r). Printed: -2 r^2 V_r.
inline Eigen::Matrix<double, 2, 4> matrix_3_4(double r, double v_theta, double v_r, double radius,
                                              Form form) {
  const double last = form == Form::printed ? -2 * r * r * v_r : -2 * radius * radius * v_r;
  Eigen::Matrix<double, 2, 4> m;
  m << 2 * r * v_theta * v_theta, 0, 2 * v_theta * (r * r - radius * radius), last, 0, 0, 2 * v_theta,
      2 * v_r;
  return m;
}

/// (3.6) solved for a_lat, a_long. Printed: the signs in a_12 and a_21.
inline Eigen::Vector2d law_3_6(const guidance::PlanarState& s, double radius, double k1, double k2, double w,
                               double a_b, double delta_b, Form form) {
  const double sign = form == Form::printed ? 1 : -1, r2 = radius * radius;
  const double rest = s.v_theta * (s.r * s.r - r2), alpha = s.alpha - s.theta, delta = delta_b - s.theta;
  const double y2 = s.v_r * s.v_r + s.v_theta * s.v_theta;
  const double y1 = s.r * s.r * s.v_theta * s.v_theta - r2 * y2;
  Eigen::Matrix2d m;
  m << rest * std::cos(alpha) + r2 * s.v_r * std::sin(alpha),
      rest * std::sin(alpha) + sign * r2 * s.v_r * std::cos(alpha),
      s.v_theta * std::cos(alpha) + sign * s.v_r * std::sin(alpha),
      s.v_theta * std::sin(alpha) + s.v_r * std::cos(alpha);
  // The printed second row of the corrected matrix: a_22 keeps its sign.
  const Eigen::Vector2d b(s.v_r * r2 * std::cos(delta) - rest * std::sin(delta),
                          -s.v_r * std::cos(delta) - s.v_theta * std::sin(delta));
  const Eigen::Vector2d right = Eigen::Vector2d(-k1 * (w - y1) / 2, k2 * y2 / 2) - a_b * b;
  return m.inverse() * right;
}

/// (4.6), (4.7). Printed: V_1 twice, signed V_theta.
struct Printed46 {
  bool v1_twice = true, is_signed = true;
};
inline double equation_4_6(const guidance::FocalState& s, const Printed46& how) {
  double r[2], v[2], v_r[2], v_theta[2];
  for (std::size_t i = 0; i < 2; ++i) {
    const Eigen::Vector2d p = s.foci[i] - s.position, w = s.velocities[i] - s.velocity;
    r[i] = p.norm();
    v_r[i] = p.dot(w) / r[i];
    v_theta[i] = (p.x() * w.y() - p.y() * w.x()) / r[i];
    if (!how.is_signed) v_theta[i] = std::abs(v_theta[i]);
    v[i] = std::hypot(v_r[i], v_theta[i]);
  }
  const double a1 = r[0] * v_theta[0] * v[1], a2 = r[1] * v_theta[1] * v[0];
  const double tau = std::pow((r[0] * v_r[0] / (v[0] * v[0]) - r[1] * v_r[1] / (v[1] * v[1])) /
                                  (r[0] * v_theta[0] / v[0] + r[1] * v_theta[1] / v[1]),
                              2);
  const double v1 = v[0] * v[0], v2 = v[1] * v[1];
  return a1 * a1 * (1 + tau * v1) + a2 * a2 * (1 + tau * (how.v1_twice ? v1 : v2)) +
         2 * a1 * a2 * std::sqrt(tau * (v1 + v2) + tau * tau * v1 * v2 + 1) - 4 * s.a * s.a * v1 * v2;
}

/// The polynomial y_1 of errata 3.4, from Cartesian states.
inline double polynomial_y1(const guidance::FocalState& s) {
  const auto cross = [](const Eigen::Vector2d& p, const Eigen::Vector2d& q) {
    return p.x() * q.y() - p.y() * q.x();
  };
  const Eigen::Vector2d v = (s.velocities[0] + s.velocities[1]) / 2 - s.velocity;
  const double b2 = s.a * s.a - (s.foci[0] - s.foci[1]).squaredNorm() / 4;
  return 4 * v.squaredNorm() *
         (cross(s.foci[0] - s.position, v) * cross(s.foci[1] - s.position, v) - b2 * v.squaredNorm());
}

/// K_r's sign in (4.16): printed and corrected.
inline double sign_4_16(double alpha, double theta, Form form) {
  const double pi = std::acos(-1.0);
  const double argument = form == Form::printed ? alpha - theta - pi / 2
                                                : pi / 2 - std::abs(std::remainder(alpha - theta, 2 * pi));
  return argument < 0 ? -1 : 1;
}

}  // namespace vericone::testing
