// SPDX-License-Identifier: BSD-3-Clause
#include "round/branches.h"

#include <algorithm>
#include <utility>

namespace vericone::round {

using exact::derivative;
using exact::primitive_part;
using exact::operator*;
using exact::operator-;
using exact::operator+;
namespace {

Integer at(const Quadratic& q, const Fraction& t) {
  return q[0] * t.d * t.d + (q[1] * t.d + q[2] * t.m) * t.m;
}

/// d q'(m / d).
Integer slope_of(const Quadratic& q, const Fraction& t) { return q[1] * t.d + 2 * q[2] * t.m; }

bool is_square_of_linear(const Quadratic& q) { return q[1] * q[1] == 4 * q[0] * q[2]; }

Integer floor_quotient(const Integer& x, const Integer& y) {  // y > 0
  Integer r = x / y;
  return r * y > x ? Integer(r - 1) : r;
}

/// x / y for all x, y in the ranges, y > 0.
Range quotient(const Integer& x, const Range& y) {
  const Integer& low_by = x >= 0 ? y.hi : y.lo;
  const Integer& high_by = x >= 0 ? y.lo : y.hi;
  return {floor_quotient(x, low_by), floor_quotient(x, high_by) + 1};
}

/// (sqrt(p) + sqrt(q))^2 where q = s^2 p with s rational.
std::optional<Quadratic> merged(const Quadratic& p, const Quadratic& q) {
  const int k = p[0] != 0 ? 0 : 2;  // q >= 0: p[1] = 0 where both are
  for (int i = 0; i < 3; ++i)
    if (p[i] * q[k] != q[i] * p[k]) return std::nullopt;
  const auto root = whole_root(p[k] * q[k]);
  if (!root) return std::nullopt;
  Quadratic sum;
  for (int i = 0; i < 3; ++i) sum[i] = p[i] + q[i] + 2 * p[i] * *root / p[k];
  return sum;
}

/// a, b with q = (a t + b)^2.
std::optional<std::array<Integer, 2>> linear_root(const Quadratic& q) {
  if (!is_square_of_linear(q)) return std::nullopt;
  const auto a = whole_root(q[2]), b = whole_root(q[0]);
  if (!a || !b) return std::nullopt;
  return std::array{*a, q[1] < 0 ? Integer(-*b) : *b};
}

Polynomial polynomial(std::initializer_list<Integer> coefficients) {
  Polynomial p(coefficients);
  exact::trim(p);
  return p;
}

Polynomial polynomial(const Quadratic& q) { return polynomial({q[0], q[1], q[2]}); }

/// Around 2^bits 2^(n e) p(x) for lo <= 2^e x <= hi, p of degree at most n.
Range enclose_values(const Integer* p, int n, const Range& x, unsigned exponent, unsigned bits) {
  Range sum;
  unsigned shift = bits;
  for (int i = n; i >= 0; --i, shift += exponent) {
    const auto [low, high] = std::minmax(
        {Integer(sum.lo * x.lo), Integer(sum.lo * x.hi), Integer(sum.hi * x.lo), Integer(sum.hi * x.hi)});
    const Integer term = p[i] << shift;
    sum = {low + term, high + term};
  }
  return sum;
}

/// A root's interval as whole numbers over 2^exponent.
struct Around {
  Range x;
  unsigned exponent;

  explicit Around(const RealRoot& root) : exponent(std::max(root.lo().exponent, root.hi().exponent)) {
    x = {root.lo().numerator << (exponent - root.lo().exponent),
         root.hi().numerator << (exponent - root.hi().exponent)};
  }

  [[nodiscard]] Range linear(const std::array<Integer, 2>& l, unsigned bits) const {
    return enclose_values(l.data(), 1, x, exponent, bits);
  }
  [[nodiscard]] Range root_of(const Quadratic& q, unsigned bits) const {
    const Range square = enclose_values(q.data(), 2, x, exponent, 2 * bits);
    return {floor_root(square.lo), floor_root(square.hi) + 1};
  }
};

int sign_of(const Range& r) { return r.lo > 0 ? 1 : r.hi < 0 ? -1 : 0; }

}  // namespace

RootSum value(const Branch& f, const Fraction& t) {
  RootSum sum{f.l[0] * t.d + f.l[1] * t.m, {}};
  for (const Quadratic& q : f.q) sum.squares.push_back(at(q, t));
  return sum;
}

Range enclose_slope(const Branch& f, const Fraction& t, unsigned bits) {
  Range sum{f.l[1] << bits, f.l[1] << bits};
  for (const Quadratic& q : f.q) {
    const Integer along = slope_of(q, t);
    if (along == 0) continue;  // q(t) = 0 too, where 0 is among the subgradients
    sum += quotient(along << (2 * bits), enclose_root(4 * at(q, t), bits));
  }
  return sum;
}

std::vector<Branch> simplified(const Branch& f) {
  Branch merged_f{f.l, {}};
  for (Quadratic q : f.q) {
    // A sum may have become a multiple of another one.
    for (std::size_t i = 0; i < merged_f.q.size();) {
      const auto both = merged(merged_f.q[i], q);
      if (!both) {
        ++i;
        continue;
      }
      q = *both;
      merged_f.q.erase(merged_f.q.begin() + static_cast<std::ptrdiff_t>(i));
      i = 0;
    }
    merged_f.q.push_back(std::move(q));
  }
  std::vector<Branch> branches{{f.l, {}}};
  for (const Quadratic& q : merged_f.q) {
    const auto line = linear_root(q);
    const std::size_t n = branches.size();
    for (std::size_t i = 0; i < n; ++i) {
      if (!line) {
        branches[i].q.push_back(q);
        continue;
      }
      Branch other = branches[i];
      for (int c = 0; c < 2; ++c) {
        branches[i].l[c] += (*line)[1 - c];
        other.l[c] -= (*line)[1 - c];
      }
      branches.push_back(std::move(other));
    }
  }
  return branches;
}

Polynomial norm(const Branch& f) {
  const Polynomial l = polynomial({f.l[0], f.l[1]});
  std::vector<Polynomial> q;
  for (const Quadratic& x : f.q) q.push_back(polynomial(x));
  const Polynomial x = l * l;
  switch (q.size()) {
    case 0:
      return primitive_part(l);
    case 1:
      return primitive_part(x - q[0]);
    case 2: {
      const Polynomial u = x - q[0] - q[1];
      return primitive_part(u * u - q[0] * q[1] * Integer(4));
    }
    default: {
      const Polynomial u = x + q[0] - q[1] - q[2];
      const Polynomial s = u * u - x * q[0] * Integer(4) - q[1] * q[2] * Integer(4);
      return primitive_part(s * s - x * q[0] * q[1] * q[2] * Integer(64));
    }
  }
}

std::vector<Fraction> kinks(const Branch& f) {
  std::vector<Fraction> t;
  for (const Quadratic& q : f.q)
    if (q[2] > 0 && is_square_of_linear(q)) t.push_back({-q[1], 2 * q[2]});
  return t;
}

int sign_at(const Branch& f, const Polynomial& norm, RealRoot& x) {
  std::optional<bool> conjugate_is_zero;
  for (int bits = 32;; bits *= 2) {
    x.refine(bits);
    const Around around(x);
    const auto digits = static_cast<unsigned>(bits);
    const Range l = around.linear(f.l, digits);
    std::vector<Range> roots;
    for (const Quadratic& q : f.q) roots.push_back(around.root_of(q, digits));
    Range sum = l;
    for (const Range& r : roots) sum += r;
    if (const int s = sign_of(sum)) return s;
    if (!conjugate_is_zero) conjugate_is_zero = exact::sign_at(norm, x) == 0;
    if (!*conjugate_is_zero) continue;
    // Some conjugate is 0. The others are smaller than f, so that f is 0 where all of them are not.
    bool others_negative = true;
    for (unsigned signs = 1; signs < 1U << roots.size(); ++signs) {
      Range other = l;
      for (std::size_t i = 0; i < roots.size(); ++i)
        other += signs >> i & 1 ? Range{-roots[i].hi, -roots[i].lo} : roots[i];
      others_negative = others_negative && sign_of(other) < 0;
    }
    if (others_negative) return 0;
  }
}

int slope_sign_at_zero(const Branch& f, const Polynomial& norm, RealRoot& x) {
  // The derivative of the norm is f' times the other conjugates, none of them 0.
  if (exact::sign_at(derivative(norm), x) == 0) return 0;
  for (int bits = 32;; bits *= 2) {
    x.refine(bits);
    const Around around(x);
    const auto digits = static_cast<unsigned>(bits);
    Range sum{f.l[1] << digits, f.l[1] << digits};
    bool known = true;
    for (const Quadratic& q : f.q) {
      const std::array<Integer, 2> along{q[1], 2 * q[2]};
      const Range slope = around.linear(along, 2 * digits);
      Range root = around.root_of(q, digits);
      root = {2 * root.lo, 2 * root.hi};
      known = known && root.lo > 0;
      if (!known) break;
      sum.lo += quotient(slope.lo, root).lo;
      sum.hi += quotient(slope.hi, root).hi;
    }
    if (!known) continue;
    if (const int s = sign_of(sum)) return s;
  }
}

Slopes slopes_at_zero(const Branch& f, const Fraction& t) {
  // f(t) = 0: all roots are whole. Where q(t) = 0, sqrt(q) has the slopes -+ sqrt(q_2).
  Integer denominator = 1;
  std::vector<std::pair<Integer, Integer>> slopes;
  RootSum corners;
  for (const Quadratic& q : f.q) {
    const Integer square = at(q, t);
    if (square == 0) {
      if (q[2] > 0) corners.squares.push_back(q[2]);
      continue;
    }
    slopes.emplace_back(slope_of(q, t), 2 * floor_root(square));
    denominator = lcm(denominator, slopes.back().second);
  }
  Integer smooth = f.l[1] * denominator;
  for (const auto& [along, by] : slopes) smooth += along * (denominator / by);
  for (Integer& x : corners.squares) x *= denominator * denominator;
  RootSum right = corners, left = corners;
  right.whole = smooth;
  left.whole = -smooth;
  return {-sign(left), sign(right)};
}

}  // namespace vericone::round
