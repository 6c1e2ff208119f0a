// SPDX-License-Identifier: BSD-3-Clause
//
// The arithmetic of the first rung: a polynomial's value together with its value on absolute values, and the
// count of roundings that turns the latter into an error bound. Both are evaluations of the *same* template
// as every other rung, so a bound cannot go stale: change a formula and its constant follows.
#pragma once

#include <vericone/geometry/sign.h>
#include <vericone/geometry/sound_arithmetic.h>
#include <cmath>
#include <concepts>
#include <limits>

namespace vericone {

/// Most roundings on any path from an input to a result. A monomial of the result is the product of inputs
/// and of at most `roundings` factors 1 + d, |d| <= u: sums take the larger count plus one, products the sum
/// plus one.
struct RoundingCount {
  int roundings = 0;

  friend constexpr RoundingCount operator+(RoundingCount x, RoundingCount y) {
    return {(x.roundings > y.roundings ? x.roundings : y.roundings) + 1};
  }
  friend constexpr RoundingCount operator-(RoundingCount x, RoundingCount y) { return x + y; }
  friend constexpr RoundingCount operator-(RoundingCount x) { return x; }
  friend constexpr RoundingCount operator*(RoundingCount x, RoundingCount y) {
    return {x.roundings + y.roundings + 1};
  }
  friend constexpr RoundingCount operator*(RoundingCount x, std::same_as<int> auto factor) {
    return {x.roundings + ((factor & (factor - 1)) == 0 ? 0 : 1)};
  }

  /// What to multiply a magnitude by: error <= bound() * magnitude. With K roundings a monomial is off by at
  /// most ((1 + u)^K - 1) of itself, and the magnitude was computed with K roundings too, so it is at least
  /// (1 - u)^K of the exact one. ((1+u)^K - 1) / (1-u)^K < 1.0001 K u for K <= 1000, proved by
  /// tests/geometry/bounds.
  [[nodiscard]] constexpr double bound() const { return 1.0001 * roundings * 0x1p-53; }
};

/// A floating-point value of a polynomial in the inputs together with the same polynomial evaluated on
/// absolute values. Both live in one vector register: tracking costs no extra instruction.
struct Tracked {
  using Pair = double __attribute__((vector_size(16)));
  using Bits = long long __attribute__((vector_size(16)));
  Pair pair;

  [[nodiscard]] double value() const { return pair[0]; }
  [[nodiscard]] double magnitude() const { return pair[1]; }

  [[nodiscard]] static Tracked of(double value, double magnitude) { return {Pair{value, magnitude}}; }
  [[nodiscard]] static Tracked of(const double (&entry)[2]) { return {Pair{entry[0], entry[1]}}; }
  [[nodiscard]] static Tracked of(double x) { return {Pair{x, std::abs(x)}}; }
  [[nodiscard]] static Tracked minus(double x) { return {Pair{-x, std::abs(x)}}; }

  friend Tracked operator+(Tracked x, Tracked y) { return {x.pair + y.pair}; }
  friend Tracked operator-(Tracked x) {
    constexpr Bits kSignOfValue = {std::numeric_limits<long long>::min(), 0};
    return {reinterpret_cast<Pair>(reinterpret_cast<Bits>(x.pair) ^ kSignOfValue)};
  }
  friend Tracked operator-(Tracked x, Tracked y) { return x + (-y); }
  friend Tracked operator*(Tracked x, Tracked y) { return {x.pair * y.pair}; }
  friend Tracked operator*(Tracked x, std::same_as<int> auto factor) {
    return {x.pair * static_cast<double>(factor)};
  }

  /// 1 or -1 where the exact value certainly is positive or negative, else 0 for uncertain. `underflow`: an
  /// absolute bound of what all products that left the normal numbers may have lost together.
  [[nodiscard]] int certain(RoundingCount count, double underflow) const {
    const double bound = count.bound() * magnitude() + underflow;
    return static_cast<int>(value() > bound) - static_cast<int>(value() < -bound);
  }
  [[nodiscard]] FilteredSign sign(RoundingCount count, double underflow) const {
    const int s = certain(count, underflow);
    return s > 0 ? FilteredSign::positive : s < 0 ? FilteredSign::negative : FilteredSign::uncertain;
  }
};

}  // namespace vericone
