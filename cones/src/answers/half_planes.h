// SPDX-License-Identifier: BSD-3-Clause
//
// A sector from what is known of its two half-planes.
#pragma once

#include <vericone/cones/plane_sector.h>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace vericone {

/// Two points of two bodies that pass each other, metres, as they stand now, and the unit normal between
/// them, from A towards B.
struct Passing {
  Eigen::Vector3d on_a, on_b, normal;
};

/// The largest angle from an axis at which a half-plane's directions collide: at `low` one does, beyond
/// `high` none; `any`: whether there is one.
struct HalfPlaneReach {
  bool any = false;
  double low = 0, high = 0;
};

/// `reach`(axis, side) -> HalfPlaneReach; `passing`(direction) -> std::optional<Passing> of a direction that
/// just misses. `from`, `to`: the ends of the line of sight; e perpendicular to it, unit. Nothing where no
/// direction of the plane collides, proved.
template <typename Reach, typename Pass>
std::optional<PlaneSector> sector_of_half_planes(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                                 const Eigen::Vector3d& e, const Reach& reach,
                                                 const Pass& passing) {
  using std::numbers::pi;
  constexpr double kBeside = 1e-6;  // rad, from which the passing points are those of the edge
  PlaneSector sector;
  sector.distance = (to - from).norm();
  sector.line_of_sight = (to - from) / sector.distance;
  sector.across = e;
  const Eigen::Vector3d& u = sector.line_of_sight;
  const HalfPlaneReach left = reach(u, e), right = reach(u, Eigen::Vector3d(-e));
  const bool known = left.any || right.any;
  if (!known && !(left.high > 0) && !(right.high > 0)) return std::nullopt;
  const auto put = [&](PlaneSector::Edge& edge, const HalfPlaneReach& found, const Eigen::Vector3d& side) {
    HalfPlaneReach ends = found;
    if (!found.any && !known) {
      ends = {true, 0, found.high};  // what may collide, and no more is known
    } else if (!found.any) {
      // The cone lies on one side of the line of sight, and its near edge is the far one seen from behind.
      const HalfPlaneReach behind = reach(Eigen::Vector3d(-u), Eigen::Vector3d(-side));
      ends = {true, behind.low - pi, found.high > 0 ? found.high : behind.high - pi};
    }
    edge.angle = 0.5 * (ends.low + ends.high);
    edge.error = 0.5 * (ends.high - ends.low);
    const double beside = ends.high + kBeside;
    const Eigen::Vector3d outside = std::cos(beside) * u + std::sin(beside) * side,
                          d = std::cos(edge.angle) * u + std::sin(edge.angle) * side;
    if (edge.error > kBeside) return;
    const std::optional<Passing> met = passing(outside);
    if (!met) return;
    Eigen::Vector3d normal = met->normal - met->normal.dot(d) * d;
    // Where they are nearest now, and not on the way, it is no grazing contact.
    if (!(normal.norm() > 0.9)) return;
    edge.normal = normal.normalized();
    edge.on_a = met->on_a - from;
    edge.on_b = met->on_b - to;
    edge.contact = met->on_b - met->on_a;
  };
  put(sector.left, left, e);
  put(sector.right, right, -e);
  return sector;
}

}  // namespace vericone
