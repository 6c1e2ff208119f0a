// SPDX-License-Identifier: BSD-3-Clause
#include "times/moving_contact.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "ellipsoids/contact_polynomial.h"
#include "ellipsoids/pair_on_grid.h"

namespace vericone::exact {
namespace {

/// A positive multiple of the discriminant of the polynomial with the coefficients p, lowest first.
template <typename N>
N discriminant_of(const std::vector<N>& p) {
  const auto times = [](long k, const N& x) { return N(x * Integer(k)); };
  if (p.size() == 3) return p[1] * p[1] - times(4, p[0] * p[2]);
  if (p.size() == 4) {
    const auto &d = p[0], &c = p[1], &b = p[2], &a = p[3];
    const N bc = b * c, ad = a * d;
    return bc * bc - times(4, a * c * c * c + b * b * b * d) + ad * (times(18, bc) - times(27, ad));
  }
  const auto &e = p[0], &d = p[1], &c = p[2], &b = p[3], &a = p[4];
  const N ae = a * e, bd = b * d, cc = c * c;
  const N i = times(12, ae) - times(3, bd) + cc;
  const N j = c * (times(72, ae) + times(9, bd) - times(2, cc)) - times(27, a * d * d + b * b * e);
  return times(4, i * i * i) - j * j;
}

}  // namespace

MovingContact::MovingContact(const PairOnGrid<3>& pair, const IntegerVector<3>& w, int unit) {
  const ShapePencil<3> pencil(pair.a, pair.b);
  for (Polynomial& q : by_time_) q.assign(5, Integer(0));
  for (int i = 0; i < 3; ++i) {
    const auto& e = pencil.adjugate[i];
    by_time_[0][i + 1] = bilinear_form<3>(e, pair.c, pair.c);
    by_time_[1][i + 1] = -2 * bilinear_form<3>(e, pair.c, w);
    by_time_[2][i + 1] = bilinear_form<3>(e, w, w);
  }
  for (int i = 0; i < 4; ++i) {
    by_time_[0][i] -= pencil.determinant[i];
    by_time_[0][i + 1] -= pencil.determinant[i];
  }
  std::array<Polynomial, 3> trimmed = by_time_;
  for (Polynomial& q : trimmed) trim(q);
  const Polynomial fixed = gcd(gcd(trimmed[0], trimmed[1]), trimmed[2]);
  if (fixed.size() > 1)
    for (Polynomial& q : by_time_) q = divide_exactly(std::move(q), fixed);
  // From units of time to seconds, t -> 2^-unit t, and without common powers of two.
  unsigned twos = std::numeric_limits<unsigned>::max();
  for (int k = 0; k < 3; ++k)
    for (Integer& x : by_time_[k]) {
      x <<= unit > 0 ? (2 - k) * unit : k * -unit;
      if (x != 0) twos = std::min(twos, static_cast<unsigned>(lsb(Integer(abs(x)))));
    }
  const Integer common = Integer(1) << twos;
  for (Polynomial& q : by_time_)
    for (Integer& x : q) x /= common;
}

bool MovingContact::same_as(const MovingContact& other) const {
  const std::size_t n = by_time_[0].size();
  if (n != other.by_time_[0].size()) return false;
  const auto proportional = [&](const auto& index) {
    const Integer &one = by_time_[0][0], &another = other.by_time_[0][index(0)];  // neither is zero
    for (std::size_t i = 0; i < n; ++i)
      for (int k = 0; k < 3; ++k)
        if (by_time_[k][i] * another != other.by_time_[k][index(i)] * one) return false;
    return true;
  };
  return proportional([](std::size_t i) { return i; }) ||
         proportional([&](std::size_t i) { return n - 1 - i; });
}

Polynomial MovingContact::discriminant() const {
  std::vector<Polynomial> p;
  for (std::size_t i = 0; i < by_time_[0].size(); ++i) {
    p.push_back({by_time_[0][i], by_time_[1][i], by_time_[2][i]});
    trim(p.back());
  }
  return discriminant_of(p);
}

bool MovingContact::surely_overlapping(const Dyadic& t) const {
  // p at t = m / 2^k, times 2^2k.
  std::vector<Integer> p;
  for (std::size_t i = 0; i < by_time_[0].size(); ++i)
    p.push_back(((by_time_[2][i] * t.numerator + (by_time_[1][i] << t.exponent)) * t.numerator) +
                (by_time_[0][i] << (2 * t.exponent)));
  return discriminant_of(p) < 0;
}

}  // namespace vericone::exact
