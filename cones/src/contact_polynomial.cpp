// SPDX-License-Identifier: BSD-3-Clause
#include "contact_polynomial.h"

#include <cmath>

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

template <int D>
Integer quadratic_form(const IntegerMatrix<D>& m, const IntegerVector<D>& v) {
  Integer sum = 0;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) sum += m[i][j] * v[i] * v[j];
  return sum;
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
Integer determinant(const IntegerMatrix<D>& m, const IntegerMatrix<D>& adj) {
  Integer sum = 0;
  for (int j = 0; j < D; ++j) sum += m[0][j] * adj[j][0];
  return sum;
}

}  // namespace

template <int D>
Polynomial contact_polynomial(const PairOnGrid<D>& pair) {
  const auto &a = pair.a, &b = pair.b;
  const auto adj_a = adjugate<D>(a), adj_b = adjugate<D>(b);
  const Integer det_a = determinant<D>(a, adj_a), det_b = determinant<D>(b, adj_b);
  Polynomial e, d;  // c^T adj(A + x B) c and det(A + x B)
  if constexpr (D == 2) {
    e = {quadratic_form<2>(adj_a, pair.c), quadratic_form<2>(adj_b, pair.c)};
    d = {det_a, inner<2>(adj_a, b), det_b};
  } else {
    IntegerMatrix<3> sum;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) sum[i][j] = a[i][j] + b[i][j];
    const Integer ea = quadratic_form<3>(adj_a, pair.c), eb = quadratic_form<3>(adj_b, pair.c);
    e = {ea, quadratic_form<3>(adjugate<3>(sum), pair.c) - ea - eb, eb};
    d = {det_a, inner<3>(adj_a, b), inner<3>(a, adj_b), det_b};
  }
  Polynomial p(d.size() + 1, Integer(0));
  for (std::size_t i = 0; i < e.size(); ++i) p[i + 1] += e[i];
  for (std::size_t i = 0; i < d.size(); ++i) {
    p[i] -= d[i];
    p[i + 1] -= d[i];
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

}  // namespace vericone::exact
