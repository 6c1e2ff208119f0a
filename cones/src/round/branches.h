// SPDX-License-Identifier: BSD-3-Clause
//
// Functions f(t) = l(t) + sqrt(q_1(t)) + ... + sqrt(q_k(t)), k <= 3, with integer coefficients, l of degree 1
// and q >= 0 of degree 2: the support function of two pieces and a margin along a line of normals.
#pragma once

#include <vericone/internal/geometry/exact/algebraic.h>
#include <array>
#include <vector>

#include "round/root_sum.h"

namespace vericone::round {

using exact::Polynomial;
using exact::RealRoot;

/// m / d, d > 0.
struct Fraction {
  Integer m = 0, d = 1;
};

using Quadratic = std::array<Integer, 3>;  // lowest first

struct Branch {
  std::array<Integer, 2> l{0, 0};
  std::vector<Quadratic> q;  // none of them 0

  bool operator==(const Branch&) const = default;
};

/// d f(m / d).
[[nodiscard]] RootSum value(const Branch& f, const Fraction& t);

/// Around 2^bits times a subgradient of f at t.
[[nodiscard]] Range enclose_slope(const Branch& f, const Fraction& t, unsigned bits);

/// Functions whose largest is f, in which no sqrt(q) is |a t + b| with rational a, b and no two q differ by
/// the square of a rational factor: their norms are not 0 everywhere.
[[nodiscard]] std::vector<Branch> simplified(const Branch& f);

/// Product of the conjugates of f (all signs of the roots) up to a factor, of degree at most 2^k: every zero
/// of f is one of it. f is simplified.
[[nodiscard]] Polynomial norm(const Branch& f);

/// Where a q vanishes.
[[nodiscard]] std::vector<Fraction> kinks(const Branch& f);

/// Sign of f at a root x of any polynomial where no q vanishes; `norm` is that of f.
[[nodiscard]] int sign_at(const Branch& f, const Polynomial& norm, RealRoot& x);

/// Sign of f' at x, where f is 0 and no q is.
[[nodiscard]] int slope_sign_at_zero(const Branch& f, const Polynomial& norm, RealRoot& x);

/// Signs of the slopes of f to the left and to the right of t, where f is 0.
struct Slopes {
  int left = 0, right = 0;
};
[[nodiscard]] Slopes slopes_at_zero(const Branch& f, const Fraction& t);

}  // namespace vericone::round
