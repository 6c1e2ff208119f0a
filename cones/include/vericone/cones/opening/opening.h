// SPDX-License-Identifier: BSD-3-Clause
//
// Flat openings of any outline: a circle, an ellipse, a simple polygon; and where one is.
#pragma once

#include <vericone/geometry/ellipsoid.h>
#include <vericone/geometry/world_body.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <limits>
#include <vector>

namespace vericone {

/// The outline of an opening in its own plane, metres, about the origin of that plane.
class Opening {
 public:
  /// Throw InputError naming "radius", "semi_axes[i]", "polygon" (fewer than 3 vertices, or no area) or
  /// "polygon[i]" (not finite, equal to the vertex before, or an edge that meets another: exact). A polygon
  /// of n vertices whose edges are short takes n log n steps, others n^2 at most, and n for its deepest().
  [[nodiscard]] static Opening circle(double radius);
  [[nodiscard]] static Opening ellipse(const Eigen::Vector2d& semi_axes);
  /// Closed by itself; either sense of rotation is taken, and kept counterclockwise.
  [[nodiscard]] static Opening polygon(std::vector<Eigen::Vector2d> vertices);

  [[nodiscard]] bool polygonal() const { return !vertices_.empty(); }
  /// Of a circle or an ellipse; zero of polygons.
  [[nodiscard]] const Eigen::Vector2d& semi_axes() const { return semi_axes_; }
  /// Of a polygon, counterclockwise; empty of the others.
  [[nodiscard]] const std::vector<Eigen::Vector2d>& vertices() const { return vertices_; }
  /// Whether the region inside is convex; decided exactly of polygons.
  [[nodiscard]] bool convex() const { return convex_; }

  /// The largest distance of a point of the rim from the origin, rounded up.
  [[nodiscard]] double reach() const { return reach_; }
  /// Of a point of the plane to the rim, positive inside, negative outside; metres, to rounding. Linear in
  /// the vertices.
  [[nodiscard]] double depth(const Eigen::Vector2d& point) const;
  /// The point that lies deepest inside, to 1 % of its depth; of circles and ellipses the origin.
  [[nodiscard]] const Eigen::Vector2d& deepest() const { return deepest_; }

 private:
  Opening() = default;

  Eigen::Vector2d semi_axes_ = Eigen::Vector2d::Zero();
  std::vector<Eigen::Vector2d> vertices_;
  Eigen::Vector2d deepest_ = Eigen::Vector2d::Zero();
  double reach_ = 0;
  bool convex_ = true;
};

/// An opening in the world. Its rim is exactly { center + x axes.col(0) + y axes.col(1) : (x, y) of the
/// outline }, so axes that are not quite orthonormal give an opening that is a little sheared, and exact
/// answers are about that one.
struct PlacedOpening {
  Opening opening = Opening::circle(1);
  Eigen::Vector3d center = Eigen::Vector3d::Zero();                            // metres
  Eigen::Matrix<double, 3, 2> axes = Eigen::Matrix<double, 3, 2>::Identity();  // linearly independent

  /// Perpendicular to the plane, of unit length up to rounding where the axes are.
  [[nodiscard]] Eigen::Vector3d normal() const {
    return Eigen::Vector3d(axes.col(0)).cross(Eigen::Vector3d(axes.col(1)));
  }
  /// A point of the opening's own plane in the world; rounded.
  [[nodiscard]] Eigen::Vector3d at(const Eigen::Vector2d& own) const { return center + axes * own; }
};

// How well an agent that moves along w gets through an opening: a length with its gradient, for laws.

/// m(w): how far the agent's shadow along w is inside the opening's, metres. With h the supports of the two
/// shadows, over unit n perpendicular to w,
///
///   of convex openings    m = min over n of h_opening(n) - h_agent(n),
///   of other polygons     m = min over edges of max over n of min over the edge of n.x - h_agent(n), where
///                         the shadow of the agent's middle is inside: how far the agent is from the edge,
///                         or, negative, the shift that parts them; else minus how far the agent's shadow
///                         reaches beyond the edge, or from the vertex, that is nearest to its middle.
///
/// Positive: the distance of the agent to the rim as they pass each other; zero: grazing; negative: the agent
/// is to be displaced by no less than -m to be just inside of a convex opening (along -n, where the opening
/// is wide enough for it), by about that to be inside of another. Positive iff OrificeOracle says `passes` of
/// w or of -w, but for rounding: m does not know which way leads to the wall.
struct OpeningClearance {
  double distance = 0;                                // m(w)
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();   // n*, unit, from the agent towards the rim
  Eigen::Vector3d rim = Eigen::Vector3d::Zero();      // the point of the rim that n* belongs to
  Eigen::Vector3d support = Eigen::Vector3d::Zero();  // and the agent's: m = n*.(rim - support)
  double time = 0;  // s, when these two pass each other: (rim - support).w / |w|^2

  /// Derivatives by the envelope theorem: of m with respect to the opening's centre less the agent's, and to
  /// w.
  [[nodiscard]] Eigen::Vector3d gradient_center() const { return normal; }
  [[nodiscard]] Eigen::Vector3d gradient_velocity() const { return -time * normal; }
};

/// To rounding, not certified. Throws InputError naming "relative_velocity" where w is zero or not finite.
/// The least of several minima is searched for on 24 directions and more at the shadows' thin ones, or on
/// the edges of a polygon, and refined; so openings and agents more than some 1e6 times as long as wide are
/// seen to fewer digits. A w along the wall sees a line of the opening: m is negative then. Cost: 2 us
/// for circles and ellipses, linear in the vertices of a polygon (docs/measured/predicates.md).
[[nodiscard]] OpeningClearance opening_clearance(const Ellipsoid& agent, const PlacedOpening& opening,
                                                 const Eigen::Vector3d& w);

/// Ellipsoids and hulls of points, placed or not (WorldBody::support_point()); some 100 supports of a hull.
/// Throws InputError naming "agent" for any other.
[[nodiscard]] OpeningClearance opening_clearance(const WorldBody& agent, const PlacedOpening& opening,
                                                 const Eigen::Vector3d& w);

// How far a convex body is from the rim of an opening, as it stands: proved bounds.

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
