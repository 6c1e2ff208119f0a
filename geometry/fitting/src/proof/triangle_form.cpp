// SPDX-License-Identifier: BSD-3-Clause
#include "proof/triangle_form.h"

#include <algorithm>

namespace vericone::fitting {
namespace {

using exact::Integer;
using exact::Rational;

Known negative(const Interval& x) {
  if (!x.finite()) return Known::unsure;
  return x.mid() < -x.rad() ? Known::yes : x.mid() >= x.rad() ? Known::no : Known::unsure;
}
Known negative(const Integer& x) { return x.sign() < 0 ? Known::yes : Known::no; }

Known opposite(Known k) { return k == Known::yes ? Known::no : k == Known::no ? Known::yes : Known::unsure; }

/// Row sums of the adjugate of a symmetric matrix, and the determinant.
template <typename Number>
struct Bordered {
  std::array<Number, 3> row;
  Number sum, det;

  explicit Bordered(const std::array<std::array<Number, 3>, 3>& m) {
    const auto cofactor = [&](std::size_t r, std::size_t c) {
      const std::size_t r0 = (r + 1) % 3, r1 = (r + 2) % 3, c0 = (c + 1) % 3, c1 = (c + 2) % 3;
      return Number(m[r0][c0] * m[r1][c1] - m[r0][c1] * m[r1][c0]);
    };
    const Number c00 = cofactor(0, 0), c01 = cofactor(0, 1), c02 = cofactor(0, 2), c11 = cofactor(1, 1),
                 c12 = cofactor(1, 2), c22 = cofactor(2, 2);
    row = {Number(c00 + c01 + c02), Number(c01 + c11 + c12), Number(c02 + c12 + c22)};
    sum = row[0] + row[1] + row[2];
    det = m[0][0] * c00 + m[0][1] * c01 + m[0][2] * c02;
  }
};

template <typename Number>
Known copositive(const std::array<std::array<Number, 3>, 3>& m) {
  int perhaps_negative = 0;
  Known edges = Known::yes;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const Known below = negative(m[i][j]);
    if (below == Known::no) continue;
    ++perhaps_negative;
    const Known dips = negative(Number(m[i][i] * m[j][j] - m[i][j] * m[i][j]));
    if (below == Known::yes && dips == Known::yes) return Known::no;
    if (dips != Known::no) edges = Known::unsure;
  }
  if (perhaps_negative <= 1 || edges != Known::yes) return edges;

  const Bordered<Number> b(m);
  Known fails = Known::yes;
  for (const Number& x : {Number(-b.sum), Number(-(m[0][0] - m[0][2] - m[0][2] + m[2][2])), Number(-b.row[0]),
                          Number(-b.row[1]), Number(-b.row[2]), b.det}) {
    const Known k = negative(x);
    if (k == Known::no) return Known::yes;
    if (k == Known::unsure) fails = Known::unsure;
  }
  return opposite(fails);
}

template <typename Number>
std::array<std::array<Number, 3>, 3> negated(std::array<std::array<Number, 3>, 3> m) {
  for (auto& row : m)
    for (Number& x : row) x = -x;
  return m;
}

}  // namespace

Known not_positive(const std::array<std::array<Interval, 3>, 3>& c) { return copositive(negated(c)); }
Known not_positive(const exact::IntegerMatrix<3>& c) { return copositive(negated(c)); }

Rational greatest_value(const exact::RationalMatrix<3>& c) {
  Rational best = std::max({c[0][0], c[1][1], c[2][2]});
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const Rational rise = c[i][j] - c[i][i], fall = c[i][j] - c[j][j];
    if (rise.sign() > 0 && fall.sign() > 0)
      best = std::max(best, Rational(c[i][i] + rise * rise / (rise + fall)));
  }
  const Bordered<Rational> b(c);
  const Rational curvature = c[0][0] - c[0][2] - c[0][2] + c[2][2];
  if (curvature.sign() < 0 && b.sum.sign() > 0 && b.row[0].sign() > 0 && b.row[1].sign() > 0 &&
      b.row[2].sign() > 0)
    best = std::max(best, Rational(b.det / b.sum));
  return best;
}

}  // namespace vericone::fitting
