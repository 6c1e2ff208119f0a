// SPDX-License-Identifier: BSD-3-Clause
#include "ellipsoids/apart.h"

#include <vericone/geometry/error.h>
#include <vericone/internal/geometry/double_double.h>
#include <array>
#include <cmath>
#include <string>
#include <utility>

namespace vericone {
namespace {

using Eigen::Vector3d;

/// hi + lo of a sum of four, cut off after lo: sums without error are passed upwards until nothing moves.
DoubleDouble leading(std::array<double, 4> x) {
  for (bool moved = true; moved;) {
    moved = false;
    for (int i = 1; i < 4; ++i) {
      const DoubleDouble s = DoubleDouble::two_sum(x[i], x[i - 1]);
      moved = moved || s.hi != x[i] || s.lo != x[i - 1];
      x[i] = s.hi;
      x[i - 1] = s.lo;
    }
  }
  return {x[3], x[2]};
}

struct Centers {
  Vector3d a, b;
};

Centers centers_apart(const Vector3d& a, const Vector3d& a_at, const Vector3d& b, const Vector3d& b_at) {
  Centers centers{a + a_at, b + b_at};
  for (int i = 0; i < 3; ++i) {
    const DoubleDouble sum_a = DoubleDouble::two_sum(a(i), a_at(i)),
                       sum_b = DoubleDouble::two_sum(b(i), b_at(i));
    for (const double sum : {sum_a.hi, sum_b.hi, sum_b.hi - sum_a.hi})
      if (!std::isfinite(sum))
        throw InputError("pose.position[" + std::to_string(i) + "]", to_text(b_at(i)),
                         "one whose sums with the bodies' numbers are below 1.8e308");
    if (sum_a.lo == 0 && sum_b.lo == 0) continue;
    const DoubleDouble c = leading({sum_b.hi, sum_b.lo, -sum_a.hi, -sum_a.lo});
    centers.a(i) = -c.lo;
    centers.b(i) = c.hi;
  }
  return centers;
}

Ellipsoid at(const Ellipsoid& body, const Vector3d& center) {
  return Ellipsoid::trusted(center, body.shape(), body.factor(), body.defined_by_factor());
}
CombinedEllipsoid at(const CombinedEllipsoid& body, const Vector3d& center) {
  return CombinedEllipsoid::trusted(at(body.ellipsoid(), center), body.delimiters());
}

template <class Body>
BodiesApart<Body> bodies_apart(const Body& a, const Vector3d& a_at, const Body& b, const Vector3d& b_at) {
  const Centers centers = centers_apart(a.center(), a_at, b.center(), b_at);
  return {at(a, centers.a), at(b, centers.b), a.center() + a_at, b.center() + b_at};
}

}  // namespace

BodiesApart<Ellipsoid> apart(const Ellipsoid& a, const Vector3d& a_at, const Ellipsoid& b,
                             const Vector3d& b_at) {
  return bodies_apart(a, a_at, b, b_at);
}
BodiesApart<CombinedEllipsoid> apart(const CombinedEllipsoid& a, const Vector3d& a_at,
                                     const CombinedEllipsoid& b, const Vector3d& b_at) {
  return bodies_apart(a, a_at, b, b_at);
}

}  // namespace vericone
