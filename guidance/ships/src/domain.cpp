// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/ships/ships.h>
#include <cmath>

namespace vericone::ships {

using Eigen::Vector2d;

namespace {

constexpr double kNauticalMile = 1852;  // m

}  // namespace

Domain Domain::fujii(double length) { return {{4 * length, 1.6 * length}, {0, 0}}; }

Domain Domain::coldwell(double length) {
  return {{5 * length, 2.5 * length}, {1.1 * length, -0.75 * length}};
}

Domain Domain::coldwell_overtaking(double length) { return {{6 * length, 1.75 * length}, {0, 0}}; }

Domain Domain::goodwin() {
  return {{0.75 * kNauticalMile, 0.85 * kNauticalMile}, {0.105 * kNauticalMile, -0.09 * kNauticalMile}};
}

Ellipse Domain::about(const Vector2d& position, double heading) const {
  const Eigen::Matrix2d turned = rotation_2d(heading);
  return Ellipse::from_axes(position + turned * center, half, turned);
}

double Domain::reach() const { return (center.norm() + half.maxCoeff()) * (1 + 1e-15); }

VelocityHalfPlane pass_with(Side side, const Ellipse& a, const Ellipse& b, const Vector2d& velocity_of_b) {
  const Sector sector = sector_by_support(a, b);
  if (sector.relation != Relation::disjoint) throw InputError("bodies", to_string(sector.relation), "apart");
  // With b to port a goes to the right of it: beyond the clockwise edge.
  const Vector2d edge = side == Side::port ? sector.right.direction : sector.left.direction;
  const Vector2d normal = side == Side::port ? Vector2d(edge.y(), -edge.x()) : Vector2d(-edge.y(), edge.x());
  return {normal, normal.dot(velocity_of_b)};
}

}  // namespace vericone::ships
