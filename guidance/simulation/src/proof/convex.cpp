// SPDX-License-Identifier: BSD-3-Clause
#include "proof/convex.h"

#include <vericone/geometry/decompositions.h>
#include <vericone/geometry/error.h>
#include <algorithm>
#include <cmath>

namespace vericone::simulation {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Convex of_hull(const std::vector<Vector3d>& points) {
  Convex convex;
  for (const Vector3d& x : points) convex.center += x / static_cast<double>(points.size());
  convex.points = points;
  return convex;
}

Convex of_ellipsoid(const Ellipsoid& body) { return {body.center(), body.factor(), {}}; }

}  // namespace

double Convex::support(const Vector3d& n) const {
  if (!hull()) return n.dot(center) + (factor.transpose() * n).norm();
  double most = n.dot(points.front());
  for (const Vector3d& x : points) most = std::max(most, n.dot(x));
  return most;
}

Vector3d Convex::support_point(const Vector3d& n) const {
  if (!hull()) {
    const Vector3d u = factor.transpose() * n;
    return center + factor * u.normalized();
  }
  return *std::max_element(points.begin(), points.end(),
                           [&](const Vector3d& x, const Vector3d& y) { return n.dot(x) < n.dot(y); });
}

double Convex::reach() const {
  constexpr double kUp = 1 + 1e-14;
  if (!hull()) return (center.norm() + left_singular<3>(factor).values.maxCoeff()) * kUp;
  double most = 0;
  for (const Vector3d& x : points) most = std::max(most, x.norm());
  return most * kUp;
}

Convex Convex::posed(const Vector3d& position, const Matrix3d& rotation) const {
  Convex image{position + rotation * center, rotation * factor, points};
  for (Vector3d& x : image.points) x = position + rotation * x;
  return image;
}

Convex convex_around(const ShapeInTime& shape, double from, double to) {
  if (planar(shape))
    throw InputError("agent", "a body of the plane", "a body of space, which an opening can let through");
  const WorldBody body = shape_over(shape, from, to, Vector3d::Zero(), Matrix3d::Identity());
  if (body.hull()) return of_hull(body.hull()->points());
  if (body.quadric()) return of_ellipsoid(body.quadric()->ellipsoid());
  const Placed& placed = *body.placed();
  if (const HullBody* hull = placed.body.hull())
    return of_hull(hull->points()).posed(placed.pose.position, placed.pose.rotation);
  // It contains them but for rounding.
  Convex around = of_ellipsoid(placed.containing_ellipsoid());
  around.factor *= 1 + 1e-9;
  return around;
}

}  // namespace vericone::simulation
