// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/planar/sector.h>
#include <vericone/internal/cones/planar/enclose_sector.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "answers/interval_vector.h"

namespace vericone {
namespace {

using Eigen::Vector2d;

/// Angle of the vectors in a box on the positive side of the y axis.
Interval atan2_enclosed(const Interval& y, const Interval& x) {
  double lo = std::numeric_limits<double>::infinity(), hi = -lo;
  for (double py : {y.lo(), y.hi()})
    for (double px : {x.lo(), x.hi()}) {
      const Interval angle = rounded_by_library(std::atan2(py, px));
      lo = std::min(lo, angle.lo());
      hi = std::max(hi, angle.hi());
    }
  return Interval::between(lo, hi);
}

/// Angle from u counter-clockwise to v, about 0 to pi.
Interval angle_between(const Vector2d& u, const Vector2d& v) {
  const Interval cross = Interval(u.x()) * Interval(v.y()) - Interval(u.y()) * Interval(v.x());
  const Interval dot = Interval(u.x()) * Interval(v.x()) + Interval(u.y()) * Interval(v.y());
  if (dot.negative()) return Interval(std::numbers::pi, 0x1p-52) - atan2_enclosed(cross, -dot);
  return atan2_enclosed(cross, dot);
}

/// Between a direction in the sector and one out of it, in that order counter-clockwise for the left edge.
std::optional<DirectionEnclosure> enclose_edge(const SectorOracle& oracle, const SectorEdge& edge,
                                               bool left) {
  // The rounded edge is off by a few units in the last place at most, but nothing is taken on trust.
  for (int bits = 53; bits > 1; --bits) {
    const double step = std::ldexp(1.0, -bits);
    const Vector2d inside = edge.direction + step * edge.normal,
                   outside = edge.direction - step * edge.normal;
    const Interval turn =
        Interval(inside.x()) * Interval(outside.y()) - Interval(inside.y()) * Interval(outside.x());
    if (left ? !turn.positive() : !turn.negative()) continue;
    if (oracle.membership(inside) == Membership::out || oracle.membership(outside) == Membership::in)
      continue;
    return left ? DirectionEnclosure{inside, outside} : DirectionEnclosure{outside, inside};
  }
  return std::nullopt;
}

}  // namespace

std::optional<SectorEnclosure> enclose_sector(const Ellipse& a, const Ellipse& b) {
  const SectorOracle oracle(a, b);
  if (oracle.relation() != Relation::disjoint) return std::nullopt;
  const Sector sector = sector_by_support(a, b);
  const auto left = enclose_edge(oracle, sector.left, true),
             right = enclose_edge(oracle, sector.right, false);
  if (!left || !right) return std::nullopt;
  SectorEnclosure result{*left, *right, {}, {}};
  // In between in the sector's own sense: from the inner ends of the brackets to the outer ones.
  result.psi = hull(angle_between(right->to, left->from), angle_between(right->from, left->to));
  const Interval start = hull(rounded_by_library(std::atan2(right->from.y(), right->from.x())),
                              rounded_by_library(std::atan2(right->from.y(), right->from.x())) +
                                  angle_between(right->from, right->to));
  result.theta_b = start + result.psi * Interval(0.5);
  const Interval turn(2 * std::numbers::pi, 0x1p-51);
  if (result.theta_b.mid() > std::numbers::pi) result.theta_b = result.theta_b - turn;
  if (result.theta_b.mid() <= -std::numbers::pi) result.theta_b = result.theta_b + turn;
  return result;
}

}  // namespace vericone
