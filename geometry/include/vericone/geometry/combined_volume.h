// SPDX-License-Identifier: BSD-3-Clause
//
// Volume and area of combined quadrics (combined.h).
#pragma once

#include <vericone/geometry/combined.h>

namespace vericone {

struct VolumeEstimate {
  double value = 0;  // m^3
  /// Estimate of the error (m^3) from two quadrature rules, and of rounding; not a proved bound.
  double error = 0;
};

/// Closed form on every half-plane through an axis of the body, adaptive quadrature over the half-planes.
/// With one delimiter the integrand is analytic; the error is then one of rounding.
[[nodiscard]] VolumeEstimate volume(const CombinedEllipsoid& body);

/// Area of a planar body, m^2, in closed form: right to rounding.
[[nodiscard]] double area(const CombinedEllipse& body);

}  // namespace vericone
