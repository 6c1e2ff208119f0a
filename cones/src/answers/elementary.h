// SPDX-License-Identifier: BSD-3-Clause
//
// Elementary functions that several predicates share.
#pragma once

#include <vericone/geometry/interval.h>
#include <vericone/internal/geometry/tracked.h>
#include <Eigen/Core>
#include <cmath>

namespace vericone {

/// Half a unit in the last place of 1: the largest relative error of one rounding.
inline constexpr double kUnitRoundoff = 0x1p-53;

/// Positive where y is to the left of x.
inline double cross(const Eigen::Vector2d& x, const Eigen::Vector2d& y) {
  return x.x() * y.y() - x.y() * y.x();
}

/// Exactly the power of two in [|x|, 2|x|), as an exponent; 0 for 0.
inline int binary_exponent(double x) { return x == 0 ? 0 : std::ilogb(x) + 1; }

/// A number times a power of two, as the first or the second rung takes it: the last argument says which.
inline Tracked scaled(double x, double scale, const Tracked*) { return Tracked::of(x * scale); }
inline Interval scaled(double x, double scale, const Interval*) { return {x * scale, Interval::kTiny}; }

}  // namespace vericone
