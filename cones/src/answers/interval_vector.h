// SPDX-License-Identifier: BSD-3-Clause
//
// Vectors and matrices of intervals in space.
#pragma once

#include <vericone/geometry/interval.h>
#include <array>

namespace vericone {

using IntervalVector3 = std::array<Interval, 3>;
using IntervalMatrix3 = std::array<std::array<Interval, 3>, 3>;

inline IntervalVector3 operator*(const IntervalMatrix3& m, const IntervalVector3& v) {
  IntervalVector3 r;
  for (int i = 0; i < 3; ++i) r[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
  return r;
}

inline Interval dot(const IntervalVector3& x, const IntervalVector3& y) {
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

inline IntervalVector3 cross(const IntervalVector3& x, const IntervalVector3& y) {
  return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}

inline Interval norm(const IntervalVector3& v) { return sqrt(square(v[0]) + square(v[1]) + square(v[2])); }

/// x with what a function of the mathematics library may be off.
inline Interval rounded_by_library(double x) { return {x, 2.01 * 0x1p-52 * std::abs(x) + Interval::kTiny}; }

}  // namespace vericone
