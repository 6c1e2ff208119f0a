// SPDX-License-Identifier: BSD-3-Clause
//
// The collision cone from nothing but questions of membership.
#pragma once

#include <vericone/cones/cone_geometry.h>
#include <vericone/cones/ellipsoids/predicates.h>
#include <numbers>

namespace vericone::testing {

/// The angle from the axis at which the cone ends on the half-plane spanned by `axis` and `across`; the cone
/// is convex and contains the axis, so there is one end.
inline double edge_by_bisection(const ConeOracle& oracle, const Eigen::Vector3d& axis,
                                const Eigen::Vector3d& across, double tolerance = 1e-11) {
  double in = 0, out = std::numbers::pi;
  while (out - in > tolerance) {
    const double mid = 0.5 * (in + out);
    const bool hit = oracle.membership(std::cos(mid) * axis + std::sin(mid) * across) != Membership::out;
    (hit ? in : out) = mid;
  }
  return in;
}

/// Trapezoidal rule over `count` half-planes.
inline double solid_angle_by_bisection(const ConeOracle& oracle, int count) {
  const AxisFrame frame(oracle.b().center() - oracle.a().center());
  double sum = 0;
  for (int i = 0; i < count; ++i) {
    const double t = 2 * std::numbers::pi * i / count;
    const double half = std::sin(
        0.5 * edge_by_bisection(oracle, frame.axis, std::cos(t) * frame.e1 + std::sin(t) * frame.e2));
    sum += 2 * half * half;
  }
  return sum * 2 * std::numbers::pi / count;
}

}  // namespace vericone::testing
