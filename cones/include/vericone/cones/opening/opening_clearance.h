// SPDX-License-Identifier: BSD-3-Clause
//
// How well an agent that moves along w gets through an opening: a length with its gradient, for laws.
#pragma once

#include <vericone/cones/opening/opening.h>
#include <vericone/geometry/ellipsoid.h>
#include <vericone/geometry/world_body.h>

namespace vericone {

/// m(w): how far the agent's shadow along w is inside the opening's, metres. With h the supports of the two
/// shadows, over unit n perpendicular to w,
///
///   of convex openings    m = min over n of h_opening(n) - h_agent(n),
///   of other polygons     m = min over rim points x of max over n of n.x - h_agent(n), where the shadow of
///                         the agent's middle is inside; else minus how far the agent's shadow reaches beyond
///                         the edge, or from the vertex, that is nearest to its middle.
///
/// Positive: the distance of the agent to the rim as they pass each other; zero: grazing; negative: the agent
/// is to be displaced by no less than -m to be just inside of a convex opening (along -n, where the opening
/// is wide enough for it), by about that to be inside of another. Positive iff OrificeOracle says `passes`,
/// but for rounding and for which way w leads: m(-w) = m(w), and in a passage still to come time > 0.
struct OpeningClearance {
  double distance = 0;                                // m(w)
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();   // n*, unit, from the agent towards the rim
  Eigen::Vector3d rim = Eigen::Vector3d::Zero();      // the point of the rim that n* belongs to
  Eigen::Vector3d support = Eigen::Vector3d::Zero();  // and the agent's: m = n*.(rim - support)
  double time = 0;  // s, when these two pass each other; negative: in the past

  /// Derivatives by the envelope theorem: of m with respect to the opening's centre less the agent's, and to
  /// w.
  [[nodiscard]] Eigen::Vector3d gradient_center() const { return normal; }
  [[nodiscard]] Eigen::Vector3d gradient_velocity() const { return -time * normal; }
};

/// To rounding, not certified. Throws InputError naming "relative_velocity" where w is zero or not finite.
/// The least of several minima is searched for on 24 directions that start at the opening's thin one, or on
/// the edges of a polygon, and refined; so openings and agents more than some 1e6 times as long as wide are
/// seen to fewer digits. A w along the wall sees a line of the opening: m is negative then. Cost: 1.6 us
/// for circles and ellipses, linear in the vertices of a polygon (docs/measured/predicates.md).
[[nodiscard]] OpeningClearance opening_clearance(const Ellipsoid& agent, const PlacedOpening& opening,
                                                 const Eigen::Vector3d& w);

/// Ellipsoids and hulls of points, placed or not (WorldBody::support_point()); some 100 supports of a hull.
/// Throws InputError naming "agent" for any other.
[[nodiscard]] OpeningClearance opening_clearance(const WorldBody& agent, const PlacedOpening& opening,
                                                 const Eigen::Vector3d& w);

}  // namespace vericone
