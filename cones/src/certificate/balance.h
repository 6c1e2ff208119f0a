// SPDX-License-Identifier: BSD-3-Clause
//
// Two ellipsoids, or their shadows, grown about their centers until they touch: where that is, to any number
// of bits, and exactly where they touch as they are.
#pragma once

#include <array>
#include <optional>

#include "ellipsoids/contact_polynomial.h"

namespace vericone::certificates {

/// With m(x) = adj(A + x B) c the bodies grown by one factor touch at the x where m^T A m = x^2 m^T B m, with
/// the normal m; there is one such x > 0, a simple root, as the contact function is strictly concave. The
/// points y_A = A m / det, from A's center, and c - x B m / det coincide.
template <int D>
class Balance {
 public:
  Balance(const exact::IntegerMatrix<D>& a, const exact::IntegerMatrix<D>& b, exact::IntegerVector<D> c);

  /// Right to about `bits` bits; c != 0. `guess`: where to look first.
  [[nodiscard]] exact::Dyadic root(double guess, int bits) const;

  /// m(x) 2^(k (D - 1)) and det(A + x B) 2^(k D), for x = numerator / 2^k.
  [[nodiscard]] exact::IntegerVector<D> normal(const exact::Dyadic& x) const;
  [[nodiscard]] exact::Integer determinant(const exact::Dyadic& x) const;

  /// The double positive root of the contact polynomial where the bodies touch as they are, which is then
  /// rational: numerator, denominator > 0. Nothing where they surely do not touch.
  [[nodiscard]] std::optional<std::array<exact::Integer, 2>> touching_root() const;
  /// m(x) up to a positive factor.
  [[nodiscard]] exact::IntegerVector<D> normal(const std::array<exact::Integer, 2>& x) const;

 private:
  exact::IntegerMatrix<D> a_, b_;
  exact::IntegerVector<D> c_;
  exact::ShapePencil<D> pencil_;
  std::array<exact::IntegerVector<D>, D> m_;  // coefficients of m(x)
};

}  // namespace vericone::certificates
