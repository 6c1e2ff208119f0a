// SPDX-License-Identifier: BSD-3-Clause
//
// The source's formulas term by term: as printed, and as corrected where the print is wrong
// (docs/reference/errata.md). Written from the print, not from the library, which uses other forms.
#pragma once

#include <vericone/guidance/laws.h>

#include <cmath>

namespace vericone::testing {

enum class Form { printed, corrected };

/// (5.9): V_r_hat, V_theta_hat.
inline Eigen::Vector2d equation_5_9(double v_r, double v_theta, double theta, double theta_b, Form form) {
  const double c = std::cos(theta - theta_b), s = std::sin(theta - theta_b);
  if (form == Form::printed) return {c * v_r + s * v_theta, -s * v_r + c * v_theta};
  return {c * v_r - s * v_theta, s * v_r + c * v_theta};
}

/// (5.10), (6.14): right as printed.
inline double equation_5_10(double v_r, double v_theta, double theta, double theta_b, double psi) {
  const double c = std::cos(theta - theta_b), s = std::sin(theta - theta_b), half = std::sin(psi / 2);
  return (v_theta * v_theta * c * c + v_r * v_r * s * s + 2 * v_r * v_theta * c * s) /
             (v_r * v_r + v_theta * v_theta) -
         half * half;
}

/// What all of the source's laws share: K, w, and the terms of (5.12).
struct SourceTerms {
  double k, w, v_r, v_theta, v2, y, psi_rate, theta_b_rate, sin_psi;
  double alpha, beta;  // from the line of sight
  double d1, d2, n1, n2;

  SourceTerms(const guidance::PlanarState& s, const guidance::PlaneCone& cone, double gain, double reference)
      : k(gain),
        w(reference),
        v_r(s.v_r),
        v_theta(s.v_theta),
        v2(v_r * v_r + v_theta * v_theta),
        y(equation_5_10(v_r, v_theta, s.theta, cone.theta_b, cone.psi)),
        psi_rate(cone.psi_rate),
        theta_b_rate(cone.theta_b_rate),
        sin_psi(std::sin(cone.psi)),
        alpha(s.alpha - s.theta),
        beta(s.beta - s.theta) {
    const double twice = 2 * (s.theta - cone.theta_b);
    d1 = 2 * v_r * v_theta * std::cos(twice) + (v_r * v_r - v_theta * v_theta) * std::sin(twice);
    d2 = 2 * (v_r * std::cos(alpha) + v_theta * std::sin(alpha));
    n1 = v2 * (2 * k * (w - y) + psi_rate * sin_psi);
    n2 = theta_b_rate *
         (4 * v_theta * v_r * std::cos(twice) + 2 * (v_r * v_r - v_theta * v_theta) * std::sin(twice));
  }
};

/// (5.12), (6.17): right as printed.
inline double law_5_12(const SourceTerms& s) { return -s.v2 * (s.n1 + s.n2) / (s.d1 * s.d2); }

/// first a_1 + second a_2 = right.
struct Equation {
  double first, second, right;

  /// The solution of least a_1^2 + a_2^2.
  Eigen::Vector2d least() const {
    return right / (first * first + second * second) * Eigen::Vector2d(first, second);
  }
};

/// (5.14) in a_lat,A and a_lat,B. Printed: the sign of A_12's second term.
inline Equation equation_5_14(const SourceTerms& s, Form form) {
  const double sign = form == Form::printed ? -1 : 1;
  const double a11 = s.v_r * std::cos(s.alpha) + s.v_theta * std::sin(s.alpha);
  const double a12 = -(s.v_r * std::cos(s.beta) + sign * s.v_theta * std::sin(s.beta));
  const double b11 = s.v2 * s.v2 * (s.k * (s.w - s.y) + 0.5 * s.psi_rate * s.sin_psi);
  return {a11, a12, -(b11 + s.theta_b_rate * s.d1 * s.v2) / s.d1};
}

/// (5.16) in a_lat,A and a_long,A: right as printed.
inline Equation equation_5_16(const SourceTerms& s) {
  const double a14 = s.v_r * std::sin(s.alpha) - s.v_theta * std::cos(s.alpha);
  const Equation same = equation_5_14(s, Form::corrected);
  return {same.first, a14, same.right};
}

/// (5.17). Printed: A_16 is the coefficient of a_lat,B.
inline Equation equation_5_17(const SourceTerms& s, double k_2, Form form) {
  const double a15 = 2 * s.v_r * std::sin(s.alpha) - 2 * s.v_theta * std::cos(s.alpha);
  const double a16 = form == Form::printed ? 2 * s.v_theta * std::cos(s.beta) - 2 * s.v_r * std::sin(s.beta)
                                           : -2 * (s.v_r * std::cos(s.alpha) + s.v_theta * std::sin(s.alpha));
  return {a15, a16, -k_2 * s.v2};
}

inline Eigen::Vector2d solved(const Equation& f, const Equation& g) {
  const double determinant = f.first * g.second - f.second * g.first;
  return Eigen::Vector2d(f.right * g.second - f.second * g.right, f.first * g.right - f.right * g.first) /
         determinant;
}

/// (6.18) in a_A and a_B. Printed: D_1 for D_2, V^2 / 2 missing, the sign in N_3.
inline Equation equation_6_18(const SourceTerms& s, Form form) {
  const double sign = form == Form::printed ? -1 : 1;
  const double n3 = -(s.v_r * std::cos(s.beta) + sign * s.v_theta * std::sin(s.beta));
  if (form == Form::printed) return {0.5 * s.d1, n3, -(s.n1 + s.theta_b_rate * s.d1 * s.v2) / s.d1};
  return {0.5 * s.d2, n3, -s.v2 * (s.n1 + s.n2) / (2 * s.d1)};
}

/// (6.19): a_A from (6.18) with a_B = mu a_A.
inline double law_6_19(const SourceTerms& s, double mu, Form form) {
  const Equation f = equation_6_18(s, form);
  return f.right / (f.first + mu * f.second);
}

/// The V_phi row of (6.10). Printed: -V_theta V_r.
inline double row_6_10_v_phi(const guidance::SpatialState& s, const guidance::DirectedAcceleration& a,
                             const guidance::DirectedAcceleration& b, Form form) {
  const auto g = [&](const guidance::DirectedAcceleration& i) {
    const double gamma = i.direction.elevation, delta = i.direction.azimuth;
    return i.magnitude * (std::cos(gamma) * std::sin(s.phi) * std::cos(delta - s.theta) -
                          std::sin(gamma) * std::cos(s.phi));
  };
  const double product = (form == Form::printed ? s.v_theta : s.v_phi) * s.v_r;
  return (-product - s.v_theta * s.v_theta * std::tan(s.phi)) / s.r + g(a) - g(b);
}

}  // namespace vericone::testing
