// SPDX-License-Identifier: BSD-3-Clause
#include "proof/convex.h"

#include <vericone/geometry/error.h>
#include <vericone/geometry/pose.h>
#include <vericone/internal/geometry/decompositions.h>
#include <vericone/internal/simulation/shape_in_time.h>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

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

Convex of_ellipsoid(const Ellipsoid& body) {
  Convex convex;
  convex.center = body.center();
  const LeftSingular<3> svd = left_singular<3>(body.factor());
  convex.semi_axes = svd.values;
  convex.axes = svd.u;
  if (convex.axes.determinant() < 0) convex.axes.col(0) = -convex.axes.col(0);
  return convex;
}

}  // namespace

double Convex::support(const Vector3d& n) const {
  if (!hull()) return n.dot(center) + semi_axes.cwiseProduct(axes.transpose() * n).norm();
  double most = n.dot(points.front());
  for (const Vector3d& x : points) most = std::max(most, n.dot(x));
  return most;
}

Vector3d Convex::support_point(const Vector3d& n) const {
  if (!hull()) {
    const Vector3d u = semi_axes.cwiseProduct(axes.transpose() * n);
    return center + axes * semi_axes.cwiseProduct(u.normalized());
  }
  return *std::max_element(points.begin(), points.end(),
                           [&](const Vector3d& x, const Vector3d& y) { return n.dot(x) < n.dot(y); });
}

double Convex::reach() const {
  constexpr double kUp = 1 + 1e-14;
  if (!hull()) return (center.norm() + semi_axes.maxCoeff()) * kUp;
  double most = 0;
  for (const Vector3d& x : points) most = std::max(most, x.norm());
  return most * kUp;
}

Convex Convex::posed(const Vector3d& position, const Matrix3d& rotation) const {
  Convex image{position + rotation * center, semi_axes, orthonormal<3>(Matrix3d(rotation * axes)), points};
  for (Vector3d& x : image.points) x = position + rotation * x;
  return image;
}

RimDistance Convex::rim(const PlacedOpening& opening, const RimQuestion& question) const {
  if (hull()) return rim_distance(WorldBody(HullBody(points)), opening, question);
  return rim_distance(ellipsoid(), opening, question);
}

double Chords::support(const Vector3d& n) const { return std::max(from.support(n), to.support(n)); }

Vector3d Chords::support_point(const Vector3d& n) const {
  const Vector3d x = from.support_point(n), y = to.support_point(n);
  return n.dot(x) >= n.dot(y) ? x : y;
}

RimDistance Chords::rim(const PlacedOpening& opening, const RimQuestion& question) const {
  if (!from.hull()) return rim_distance(from.ellipsoid(), to.ellipsoid(), opening, question);
  std::vector<Vector3d> points = from.points;
  points.insert(points.end(), to.points.begin(), to.points.end());
  return rim_distance(WorldBody(HullBody(std::move(points))), opening, question);
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
  around.semi_axes *= 1 + 1e-9;
  return around;
}

}  // namespace vericone::simulation
