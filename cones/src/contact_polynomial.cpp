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

void trim(Polynomial& p) {
  while (!p.empty() && p.back() == 0) p.pop_back();
}

Polynomial derivative(const Polynomial& p) {
  Polynomial d;
  for (std::size_t i = 1; i < p.size(); ++i) d.push_back(p[i] * static_cast<long>(i));
  return d;
}

/// A positive multiple of -(a mod b): every elimination step is scaled by |leading coefficient of b|.
Polynomial negative_remainder(Polynomial a, const Polynomial& b) {
  const Integer lead = abs(b.back());
  const int lead_sign = b.back().sign();
  while (a.size() >= b.size()) {
    const Integer f = lead_sign > 0 ? a.back() : Integer(-a.back());
    const std::size_t shift = a.size() - b.size();
    for (auto& x : a) x *= lead;
    for (std::size_t i = 0; i < b.size(); ++i) a[i + shift] -= f * b[i];
    a.pop_back();
  }
  trim(a);
  if (a.empty()) return a;
  // Without its content the chain's numbers stay a few times as long as the coefficients.
  Integer content = 0;
  for (const auto& x : a) content = gcd(content, x);
  for (auto& x : a) x = -x / content;
  return a;
}

std::vector<Polynomial> sturm_chain(const Polynomial& p) {
  std::vector<Polynomial> chain{p, derivative(p)};
  while (chain.back().size() > 1) {
    Polynomial next = negative_remainder(chain[chain.size() - 2], chain.back());
    if (next.empty()) break;
    chain.push_back(std::move(next));
  }
  return chain;
}

template <typename Sign>
int sign_changes(const std::vector<Polynomial>& chain, Sign&& sign_of) {
  int changes = 0, last = 0;
  for (const Polynomial& p : chain) {
    const int s = sign_of(p);
    if (s != 0 && last != 0 && s != last) ++changes;
    if (s != 0) last = s;
  }
  return changes;
}

int sign_at(const Polynomial& p, const Dyadic& x) {
  // 2^(k n) p(m / 2^k) = sum p_i m^i 2^(k (n - i)), by Horner.
  Integer sum = 0;
  unsigned shift = 0;
  for (auto it = p.rbegin(); it != p.rend(); ++it) {
    sum = sum * x.numerator + (*it << shift);
    shift += x.exponent;
  }
  return sum.sign();
}

int changes_at(const std::vector<Polynomial>& chain, const Dyadic& x) {
  return sign_changes(chain, [&](const Polynomial& p) { return sign_at(p, x); });
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
  return sign_changes(chain, [](const Polynomial& q) { return q.front().sign(); }) -
         sign_changes(chain, [](const Polynomial& q) { return q.back().sign(); });
}

Dyadic between_positive_roots(const Polynomial& p, double guess) {
  if (std::isfinite(guess) && guess > 0 && guess < 1e200) {
    const int e = grid_exponent(guess, 0);
    Dyadic x = e >= 0 ? Dyadic{on_grid(guess, 0), 0} : Dyadic{on_grid(guess, e), static_cast<unsigned>(-e)};
    if (sign_at(p, x) > 0) return x;
  }
  const auto chain = sturm_chain(p);
  const int at_zero = sign_changes(chain, [](const Polynomial& q) { return q.front().sign(); });
  const auto roots_up_to = [&](const Dyadic& x) { return at_zero - changes_at(chain, x); };
  Dyadic hi{1, 0}, lo{0, 0};
  while (roots_up_to(hi) < 2) hi.numerator *= 4;
  for (;;) {  // ends: the roots are distinct
    Dyadic mid{lo.numerator + hi.numerator, hi.exponent + 1};
    lo.numerator *= 2;
    hi.numerator *= 2;
    lo.exponent = hi.exponent = mid.exponent;
    const int count = roots_up_to(mid);
    if (count == 1 && sign_at(p, mid) > 0) return mid;
    (count == 2 ? hi : lo) = mid;
  }
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
