// SPDX-License-Identifier: BSD-3-Clause
//
// How far a convex body is from the rim of an opening, as it stands: proved bounds.
#pragma once

#include <vericone/cones/opening/opening.h>
#include <vericone/geometry/ellipsoid.h>
#include <vericone/geometry/world_body.h>
#include <cstdint>
#include <limits>

namespace vericone {

/// The distance of a body to the rim is between `least` and `most`; metres.
struct RimDistance {
  double least = 0;  // proved
  double most = std::numeric_limits<double>::infinity();
  /// Points of the rim and of the body that are `most` apart, to rounding; one and the same where the rim
  /// pierces the body.
  Eigen::Vector3d rim = Eigen::Vector3d::Zero(), body = Eigen::Vector3d::Zero();
  std::uint32_t points = 0;  // of the rim that were looked at
};

/// When to stop. Whatever stops first, both bounds hold.
struct RimQuestion {
  double tolerance = 1e-3;  // relative: most - least <= tolerance * most
  /// Metres: also as soon as least > threshold or most <= threshold, which is cheap. Negative: none.
  double threshold = -1;
  std::uint32_t most_points = 10000;
};

/// Branch and bound over arcs and edges of the rim: for a unit vector n the body stays below its support
/// h(n), so an arc on which n.x >= h(n) + d is d away. n points from the body to a point of the arc, from the
/// body's nearest point. All that is rounded (supports, points of the rim) is padded by 1e-14 of the largest
/// length or coordinate in play, so differences below a few such paddings are not resolved: `least` may stay
/// 0 for a body that is nearer than that, and `most` that small for one that the rim pierces.
///
/// An ellipsoid is the one that is defined exactly (ellipsoid.h). Numbers that are not finite, or axes
/// without a plane, give [0, infinity]. Cost:
/// 1 to 4 us for an ellipsoid, to 1e-2; about 1 us for a threshold (docs/measured/predicates.md).
[[nodiscard]] RimDistance rim_distance(const Ellipsoid& body, const PlacedOpening& opening,
                                       const RimQuestion& question = {});

/// Of the convex hull of two ellipsoids: of all straight ways from one to the other, as of a body at both
/// ends of a piece of time. `least` is within the tolerance of `most` where they are nearly parallel;
/// otherwise it may stay lower.
[[nodiscard]] RimDistance rim_distance(const Ellipsoid& from, const Ellipsoid& to,
                                       const PlacedOpening& opening, const RimQuestion& question = {});

/// Ellipsoids, and hulls of points, placed or not: whatever has a WorldBody::support_point(). A hull costs
/// some ten supports for each point of the rim. Throws InputError naming "body" for any other.
[[nodiscard]] RimDistance rim_distance(const WorldBody& body, const PlacedOpening& opening,
                                       const RimQuestion& question = {});

}  // namespace vericone
