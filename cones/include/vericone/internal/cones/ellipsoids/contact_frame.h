// SPDX-License-Identifier: BSD-3-Clause
//
// Two ellipsoids in the coordinates in which they are simplest.
#pragma once

#include <vericone/cones/ellipsoids/predicates.h>
#include <vericone/geometry/ellipsoid.h>
#include <optional>

namespace vericone {

/// A linear map of space that turns body A into the unit ball and body B into an axis-aligned ellipsoid, and
/// the Perram-Wertheim contact function of the pair in these coordinates.
///
/// Everything the library computes about two ellipsoids starts here. With S_A = T T^T and
/// S_B = T diag(sigma^2) T^T the contact function
///
///   f(lambda) = lambda (1 - lambda) c^T [(1 - lambda) S_A + lambda S_B]^{-1} c = c^T S_K(lambda)^{-1} c,
///   S_K(lambda) = S_A / lambda + S_B / (1 - lambda),
///
/// is a sum of D fractions, concave on (0, 1). The ellipsoid { x : (x-c)^T S_K^{-1} (x-c) <= 1 } contains the
/// Minkowski sum K = B + (-A) for every lambda (Cauchy-Schwarz), touches it at the maximiser, and so the
/// bodies are apart iff max f > 1; then n = S_K^{-1} c separates them.
///
/// Cost: about 0.5 us for D = 3, no allocation.
template <int D>
struct ContactFrame {
  using Vector = Eigen::Matrix<double, D, 1>;
  using Matrix = Eigen::Matrix<double, D, D>;

  Vector center_line;  // c = p_B - p_A, in space
  Matrix to_space;     // T; a point of the frame is at p_A + T y in space
  Matrix to_frame;     // T^{-1}
  Vector sigma;        // semi-axes of B in the frame
  Vector center;       // c in the frame
  double ratio = 1;    // x = lambda / (1 - lambda) at the maximiser of f; equals rho_A(n) / rho_B(n) there
  double contact = 0;  // max f: squared scale at which K, grown about its centre, would reach the origin

  ContactFrame(const BasicEllipsoid<D>& a, const BasicEllipsoid<D>& b)
      : ContactFrame(a.factor(), b.factor(), b.center() - a.center()) {}

  /// From the factors of the two shapes and the line of centres.
  ContactFrame(const Matrix& factor_a, const Matrix& factor_b, const Vector& center_line);

  /// Diagonal of S_K at the maximiser, in the frame.
  [[nodiscard]] Vector bounding_shape() const {
    return (1 + ratio) * (Vector::Constant(1 / ratio) + sigma.cwiseAbs2());
  }

  /// The normal S_K^{-1} c at the maximiser, in space coordinates (not normalised). It separates the bodies,
  /// g(n) = n.c - rho_A(n) - rho_B(n) > 0, iff contact > 1 (up to rounding: see predicates.h for a proof).
  [[nodiscard]] Vector separating_normal() const {
    return to_frame.transpose() * center.cwiseQuotient(bounding_shape());
  }
};

/// Maximiser of f for a centre line `center` given in the frame; returns x = lambda / (1 - lambda), which
/// keeps its relative accuracy where lambda would round to 0 or 1.
template <int D>
[[nodiscard]] double maximise_contact(const Eigen::Matrix<double, D, 1>& center,
                                      const Eigen::Matrix<double, D, 1>& sigma);

/// f at x = lambda / (1 - lambda), dimensionless.
template <int D>
[[nodiscard]] double contact_value(double ratio, const Eigen::Matrix<double, D, 1>& center,
                                   const Eigen::Matrix<double, D, 1>& sigma) {
  double sum = 0;
  for (int i = 0; i < D; ++i) sum += center(i) * center(i) / (1 + ratio * sigma(i) * sigma(i));
  return ratio / (1 + ratio) * sum;
}

/// The same where the contact frame of the pair is at hand; the answer does not depend on its accuracy.
template <int D>
[[nodiscard]] Relation relation(const BasicEllipsoid<D>& a, const BasicEllipsoid<D>& b,
                                const ContactFrame<D>& frame, Rung* rung = nullptr);

/// First two rungs: a plane that separates the bodies, or a point inside of both, found in floating point and
/// certified. Nothing when rounding could matter. Never answer `touching`.
template <int D>
[[nodiscard]] std::optional<Relation> triage_relation(const BasicEllipsoid<D>& a, const BasicEllipsoid<D>& b,
                                                      const ContactFrame<D>& frame);
template <int D>
[[nodiscard]] std::optional<Relation> interval_relation(const BasicEllipsoid<D>& a,
                                                        const BasicEllipsoid<D>& b,
                                                        const ContactFrame<D>& frame);

}  // namespace vericone
