// SPDX-License-Identifier: BSD-3-Clause
//
// Signs of sums of a whole number and square roots of whole numbers, which is what a support function of
// round bodies is along a rational direction.
#pragma once

#include <vericone/internal/geometry/exact/integer.h>
#include <optional>
#include <vector>

namespace vericone::round {

using exact::Integer;
using exact::IntegerMatrix;
using exact::IntegerVector;

/// Whole numbers lo <= x <= hi around x.
struct Range {
  Integer lo = 0, hi = 0;

  Range& operator+=(const Range& other) {
    lo += other.lo;
    hi += other.hi;
    return *this;
  }
};

/// whole + sqrt(squares[0]) + sqrt(squares[1]) + ..., no square negative.
struct RootSum {
  Integer whole = 0;
  std::vector<Integer> squares;
};

/// The largest r with r^2 <= x, x >= 0.
[[nodiscard]] Integer floor_root(const Integer& x);

/// sqrt(x) where that is whole.
[[nodiscard]] std::optional<Integer> whole_root(const Integer& x);

/// Around 2^bits sqrt(x), of width 0 or 1.
[[nodiscard]] Range enclose_root(const Integer& x, unsigned bits);

/// Around 2^bits times the sum.
[[nodiscard]] Range enclose(const RootSum& sum, unsigned bits);

/// Exact. Roots with positive factors add up to a whole number only where each is one, so that a sum that is
/// not of whole roots is not 0, and enough digits decide it.
[[nodiscard]] int sign(const RootSum& sum);

}  // namespace vericone::round
