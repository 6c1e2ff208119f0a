// SPDX-License-Identifier: BSD-3-Clause
//
// The polynomial whose sign is that of the contact function minus one, over any ring of numbers, and the
// exact count of its positive roots.
//
// With x = lambda / (1 - lambda) > 0, multiplying f - 1 by (1 + x) det(A + x B) > 0 gives
//
//   p(x) = x c^T adj(A + x B) c - (1 + x) det(A + x B),
//
// of degree 3 in the plane and 4 in space. f is concave in lambda and p < 0 at both ends, so p has no, one
// double, or two simple positive roots: overlapping, touching, disjoint.
#pragma once

#include <vericone/internal/geometry/exact/algebraic.h>
#include <vericone/internal/geometry/exact/integer.h>
#include <array>
#include <optional>
#include "ellipsoids/pair_on_grid.h"

namespace vericone {

/// Symmetric 2x2 [[a, b], [b, c]].
template <typename N>
struct Symmetric2 {
  N a, b, c;
};

/// Discriminant of k3 x^3 - k2 x^2 - k1 x + k0. The cubic has two distinct positive roots iff it is positive
/// and k1 > 0 or k2 > 0: with k3, k0 > 0 one root is negative, and by Descartes' rule the others are positive
/// exactly when the signs (+, -k2, -k1, +) change.
template <typename N>
constexpr N cubic_discriminant(const N& k0, const N& k1, const N& k2, const N& k3) {
  const N k12 = k1 * k2, k03 = k0 * k3;
  const N u = (k2 * k2) * (k2 * k0) + (k1 * k1) * (k1 * k3);
  return (k12 * (k12 + k03 * 18) + u * 4) - k03 * k03 * 27;
}

/// Coefficients of -p for two ellipses with shapes A and B, centre line d: k3 x^3 - k2 x^2 - k1 x + k0, where
/// k3 = det B > 0 and k0 = det A > 0.
template <typename N>
struct ContactCubic {
  N k3, k2, k1, k0;

  constexpr ContactCubic(const Symmetric2<N>& a, const Symmetric2<N>& b, const N& dx, const N& dy) {
    const N xx = dx * dx, yy = dy * dy, xy = dx * dy;
    const N xy2 = xy + xy;
    const N nab = -a.b, nbb = -b.b;
    k0 = a.a * a.c + a.b * nab;
    k3 = b.a * b.c + b.b * nbb;
    const N off = nab * b.b;
    const N mixed = (a.a * b.c + a.c * b.a) + (off + off);
    k1 = (xx * a.c + yy * a.a + xy2 * nab) - (mixed + k0);
    k2 = (xx * b.c + yy * b.a + xy2 * nbb) - (mixed + k3);
  }

  constexpr N discriminant() const { return cubic_discriminant(k0, k1, k2, k3); }
};

/// Shadow of the quadratic form S along w: L S L^T with L dropping coordinate k, (L x)_1 = w_k x_i - w_i x_k
/// and (L x)_2 = w_k x_j - w_j x_k. `s(r, c)` gives the entries of S.
template <typename N, typename Entry>
constexpr Symmetric2<N> shadow(const Entry& s, const N& wi, const N& wj, const N& wk, int i, int j, int k) {
  const N kk = wk * wk, ki = wk * wi, kj = wk * wj;
  const N t1 = ki * s(i, k);
  const N t3 = kj * s(j, k);
  return {kk * s(i, i) - (t1 + t1) + wi * wi * s(k, k),
          kk * s(i, j) - kj * s(i, k) - ki * s(j, k) + wi * wj * s(k, k),
          kk * s(j, j) - (t3 + t3) + wj * wj * s(k, k)};
}

/// The same for w = (u, v, 1) in the order i, j, k, given -u and -v.
template <typename N, typename Entry>
constexpr Symmetric2<N> affine_shadow(const Entry& s, const N& minus_u, const N& minus_v, int i, int j,
                                      int k) {
  const N ik = s(i, k) + minus_u * s(k, k), jk = s(j, k) + minus_v * s(k, k);
  return {s(i, i) + minus_u * (s(i, k) + ik), (s(i, j) + minus_v * s(i, k)) + minus_u * jk,
          s(j, j) + minus_v * (s(j, k) + jk)};
}

namespace exact {

/// Coefficients of adj(A + x B) and det(A + x B), lowest first.
template <int D>
struct ShapePencil {
  std::array<IntegerMatrix<D>, D> adjugate;
  std::array<Integer, D + 1> determinant;

  ShapePencil(const IntegerMatrix<D>& a, const IntegerMatrix<D>& b);
};

/// v^T m w.
template <int D>
Integer bilinear_form(const IntegerMatrix<D>& m, const IntegerVector<D>& v, const IntegerVector<D>& w) {
  Integer sum = 0;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) sum += m[i][j] * v[i] * w[j];
  return sum;
}

/// p for two bodies; Polynomial of degree D + 1.
template <int D>
Polynomial contact_polynomial(const PairOnGrid<D>& pair);

/// Number of distinct roots in (0, infinity), by Sturm's theorem; p(0) != 0.
int distinct_positive_roots(const Polynomial& p);

/// A dyadic number x = numerator / 2^exponent strictly between the two positive roots of p, where p > 0.
/// Requires distinct_positive_roots(p) == 2 and p < 0 at 0 and infinity. `guess` is tried first.
Dyadic between_positive_roots(const Polynomial& p, double guess);

/// adj(A + x B) c, up to a positive factor: proportional to S_K^{-1} c, which separates the bodies where p(x)
/// > 0.
IntegerVector<3> contact_normal(const PairOnGrid<3>& pair, const Dyadic& x);

/// Sign of n.w, with n a normal that separates disjoint bodies, or the common normal of touching ones, from A
/// towards B. Nothing for overlapping bodies: they have none.
template <int D>
std::optional<int> side_of_contact(const PairOnGrid<D>& pair, const IntegerVector<D>& w);

}  // namespace exact
}  // namespace vericone
