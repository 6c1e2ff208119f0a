// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/internal/cones/assembly/convex_reach.h>
#include <vericone/internal/cones/cone_size.h>
#include <vericone/internal/geometry/requires.h>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>

namespace vericone {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;
using DirectionLoop = std::vector<Vector3d>;

/// The direction at angle t from the axis towards `side` on the great circle with this normal, 0 < t < pi.
Vector3d on_half_plane(const Vector3d& normal, const Vector3d& axis, const Vector3d& side) {
  Vector3d d = -normal.dot(side) * axis + normal.dot(axis) * side;
  if (d.dot(side) < 0) d = -d;
  return d.normalized();
}

/// Corners of the outer cone from the half-plane `from` on, up to but without the next one. Beyond a
/// half-plane a convex cone stays below the great circle through what it reaches on the one before (`low`,
/// proved to collide) and what it does not exceed on this one (`high`): if x were above, the arc from x to
/// `low` would cross this half-plane above `high`. The same from the other side; where the two great circles
/// do not meet in between, or are the same to rounding, the first alone.
void append_outer(DirectionLoop& outer, const Vector3d& axis, const std::array<Vector3d, 4>& low,
                  const std::array<Vector3d, 4>& high) {
  constexpr double kSame = 1e-9;
  const Vector3d before = low[0].cross(high[1]).normalized(), after = high[2].cross(low[3]).normalized();
  Vector3d meet = before.cross(after);
  if (meet.dot(high[1] + high[2]) < 0) meet = -meet;
  outer.push_back(high[1]);
  const bool between = axis.dot(high[1].cross(meet)) >= 0 && axis.dot(meet.cross(high[2])) >= 0;
  if (meet.norm() > kSame && between) {
    outer.push_back(meet.normalized());
  } else {
    const Vector3d side = (high[2] - high[2].dot(axis) * axis).normalized();
    const Vector3d end = on_half_plane(before, axis, side);
    if (axis.dot(end) < axis.dot(high[2])) outer.push_back(end);
  }
}

PolyhedralCone sized(DirectionLoop directions, const Vector3d& axis) {
  PolyhedralCone cone;
  cone.solid_angle = polygon_solid_angle(axis, directions);
  cone.cross_section_area = polygon_section_area(axis, directions);
  cone.directions = std::move(directions);
  return cone;
}

}  // namespace

ConvexReach convex_reach(const AssemblyOracle& oracle, const Vector3d& inside, int half_planes,
                         double angle) {
  VERICONE_REQUIRES(oracle.relation() == Relation::disjoint && oracle.obstacle().size() == 1);
  const AxisFrame frame(inside);
  const auto reached = oracle.extremes(frame.axis, half_planes, angle);
  DirectionLoop low, high, outer;
  for (std::size_t i = 0; i < reached.size(); ++i) {
    const double azimuth = 2 * pi * static_cast<double>(i) / half_planes;
    const Vector3d side = frame.across(azimuth);
    low.push_back(std::cos(reached[i].low) * frame.axis + std::sin(reached[i].low) * side);
    high.push_back(std::cos(reached[i].high) * frame.axis + std::sin(reached[i].high) * side);
  }
  const std::size_t n = reached.size();
  for (std::size_t i = 0; i < n; ++i) {
    const auto around = [&](const DirectionLoop& v) {
      return std::array<Vector3d, 4>{v[(i + n - 1) % n], v[i], v[(i + 1) % n], v[(i + 2) % n]};
    };
    append_outer(outer, frame.axis, around(low), around(high));
  }
  return {frame.axis, sized(std::move(low), frame.axis), sized(std::move(outer), frame.axis)};
}

}  // namespace vericone
