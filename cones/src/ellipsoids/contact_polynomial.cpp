// SPDX-License-Identifier: BSD-3-Clause
#include "ellipsoids/contact_polynomial.h"

#include <vericone/internal/geometry/requires.h>
#include <cmath>
#include "ellipsoids/pair_on_grid.h"

namespace vericone::exact {
namespace {

template <int D>
IntegerMatrix<D> adjugate(const IntegerMatrix<D>& m) {
  IntegerMatrix<D> r;
  if constexpr (D == 2) {
    r = {{{m[1][1], -m[0][1]}, {-m[1][0], m[0][0]}}};
  } else {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const int r0 = (j + 1) % 3, r1 = (j + 2) % 3, c0 = (i + 1) % 3, c1 = (i + 2) % 3;
        r[i][j] = m[r0][c0] * m[r1][c1] - m[r0][c1] * m[r1][c0];
      }
  }
  return r;
}

/// Trace of m n.
template <int D>
Integer inner(const IntegerMatrix<D>& m, const IntegerMatrix<D>& n) {
  Integer sum = 0;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) sum += m[i][j] * n[j][i];
  return sum;
}

template <int D>
Integer expand_determinant(const IntegerMatrix<D>& m, const IntegerMatrix<D>& adj) {
  Integer sum = 0;
  for (int j = 0; j < D; ++j) sum += m[0][j] * adj[j][0];
  return sum;
}

}  // namespace

template <int D>
ShapePencil<D>::ShapePencil(const IntegerMatrix<D>& a, const IntegerMatrix<D>& b) {
  const auto adj_a = exact::adjugate<D>(a), adj_b = exact::adjugate<D>(b);
  const Integer det_a = expand_determinant<D>(a, adj_a), det_b = expand_determinant<D>(b, adj_b);
  if constexpr (D == 2) {
    adjugate = {adj_a, adj_b};
    determinant = {det_a, inner<2>(adj_a, b), det_b};
  } else {
    IntegerMatrix<3> mixed;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) mixed[i][j] = a[i][j] + b[i][j];
    mixed = exact::adjugate<3>(mixed);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) mixed[i][j] -= adj_a[i][j] + adj_b[i][j];
    adjugate = {adj_a, mixed, adj_b};
    determinant = {det_a, inner<3>(adj_a, b), inner<3>(a, adj_b), det_b};
  }
}
template struct ShapePencil<2>;
template struct ShapePencil<3>;

template <int D>
Polynomial contact_polynomial(const PairOnGrid<D>& pair) {
  const ShapePencil<D> pencil(pair.a, pair.b);
  Polynomial p(D + 2, Integer(0));
  for (int i = 0; i < D; ++i) p[i + 1] += bilinear_form<D>(pencil.adjugate[i], pair.c, pair.c);
  for (int i = 0; i <= D; ++i) {
    p[i] -= pencil.determinant[i];
    p[i + 1] -= pencil.determinant[i];
  }
  return p;
}

template Polynomial contact_polynomial<2>(const PairOnGrid<2>&);
template Polynomial contact_polynomial<3>(const PairOnGrid<3>&);

int distinct_positive_roots(const Polynomial& p) {
  const auto chain = sturm_chain(p);
  return sign_changes_at_zero(chain) - sign_changes_at_infinity(chain);
}

Dyadic between_positive_roots(const Polynomial& p, double guess) {
  VERICONE_REQUIRES(distinct_positive_roots(p) == 2 && p.front() < 0 && p.back() < 0);
  if (std::isfinite(guess) && guess > 0 && guess < 1e200) {
    Dyadic x = Dyadic::of(guess);
    if (sign_at(p, x) > 0) return x;
  }
  // Isolating intervals do not overlap, and no root lies at an end.
  return positive_roots(p).front().hi();
}

IntegerVector<3> contact_normal(const PairOnGrid<3>& pair, const Dyadic& x) {
  IntegerMatrix<3> m;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) m[i][j] = (pair.a[i][j] << x.exponent) + x.numerator * pair.b[i][j];
  const auto adj = adjugate<3>(m);
  IntegerVector<3> n;
  for (int i = 0; i < 3; ++i) n[i] = adj[i][0] * pair.c[0] + adj[i][1] * pair.c[1] + adj[i][2] * pair.c[2];
  return n;
}

template <int D>
std::optional<int> side_of_contact(const PairOnGrid<D>& pair, const IntegerVector<D>& w) {
  std::vector<RealRoot> roots = positive_roots(contact_polynomial<D>(pair));
  if (roots.empty()) return std::nullopt;
  const ShapePencil<D> pencil(pair.a, pair.b);
  Polynomial along;  // n.w as a polynomial in x
  for (int i = 0; i < D; ++i) along.push_back(bilinear_form<D>(pencil.adjugate[i], w, pair.c));
  trim(along);
  if (along.empty()) return 0;
  return roots.size() == 1 ? sign_at(along, roots[0]) : sign_at(along, roots[0].hi());
}
template std::optional<int> side_of_contact<2>(const PairOnGrid<2>&, const IntegerVector<2>&);
template std::optional<int> side_of_contact<3>(const PairOnGrid<3>&, const IntegerVector<3>&);

}  // namespace vericone::exact
