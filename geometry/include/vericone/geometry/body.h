// SPDX-License-Identifier: BSD-3-Clause
//
// One type for every body, and one for a body that stands somewhere.
#pragma once

#include <vericone/geometry/assembly.h>
#include <vericone/geometry/combined.h>
#include <vericone/geometry/convex.h>
#include <vericone/geometry/hull_body.h>
#include <vericone/geometry/pose.h>
#include <array>
#include <cstdint>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

namespace vericone {

enum class BodyKind : std::uint8_t {
  ellipsoid,
  combined,  // an ellipsoid delimited by hyperboloids: dents, waists, stars
  hull,      // the convex hull of points
  mesh,      // triangles, without what they enclose
  cloud,     // balls about points
  boxes,     // solid boxes, as of an octree map
  pieces,    // the union of ellipsoids and combined quadrics, or of convex bodies
  convex,    // a cylinder, a capsule, a cone, any of the kinds before with a margin: convex.h
};
inline constexpr std::array<BodyKind, 8> kBodyKinds{BodyKind::ellipsoid, BodyKind::combined, BodyKind::hull,
                                                    BodyKind::mesh,      BodyKind::cloud,    BodyKind::boxes,
                                                    BodyKind::pieces,    BodyKind::convex};
[[nodiscard]] const char* to_string(BodyKind kind);

/// A body of any kind in its own frame, metres. Immutable; a copy shares what it holds and costs no more than
/// a pointer.
class Body {
 public:
  /// What a body is made of: one combined quadric (an ellipsoid is one without delimiters), the hull of
  /// points, an assembly of convex pieces, the union of combined quadrics, or one convex body of flat, round
  /// and straight parts.
  using Shape = std::variant<CombinedEllipsoid, HullBody, Assembly, std::vector<CombinedEllipsoid>, Convex>;

  /// The unit ball about the origin.
  Body();
  Body(const Ellipsoid& ellipsoid);     // NOLINT: each of these is a body
  Body(const CombinedEllipsoid& body);  // NOLINT
  Body(HullBody hull);                  // NOLINT
  Body(Assembly assembly);              // NOLINT
  Body(Convex convex);                  // NOLINT

  /// Their union. Throws InputError naming "pieces" where there is none.
  [[nodiscard]] static Body pieces(std::vector<CombinedEllipsoid> pieces);

  [[nodiscard]] BodyKind kind() const;
  [[nodiscard]] const Shape& shape() const;

  // Its parts, where it is made of that; otherwise null.
  [[nodiscard]] const CombinedEllipsoid* quadric() const;
  [[nodiscard]] const HullBody* hull() const;
  [[nodiscard]] const Assembly* assembly() const;
  [[nodiscard]] const std::vector<CombinedEllipsoid>* quadrics() const;  // of a union
  [[nodiscard]] const Convex* convex() const;

  /// Support function max n.x over the body; rounded to a few units in the last place of the largest term. Of
  /// a combined body, the ellipsoid's that contains it: it may be too large, never too small. Linear in the
  /// points of a hull and the pieces of a union, a descent of the tree of an assembly. No allocation.
  [[nodiscard]] double support(const Eigen::Vector3d& n) const;

  /// A point amid the body: the centre of a combined quadric, the mean of a hull's points, the middle of the
  /// bounds of an assembly or a union.
  [[nodiscard]] Eigen::Vector3d middle() const;

  /// Around the body, at most a few roundings too small.
  [[nodiscard]] Box bounds() const;

  /// An ellipsoid that contains the body: the least one of points and triangles, the bounding ellipsoid of a
  /// combined body. Balls and flat bodies make it a little larger than the least. Found on the first call
  /// (100,000 points: 20 ms) and kept; safe in several threads.
  [[nodiscard]] const Ellipsoid& containing_ellipsoid() const;

 private:
  struct Data;
  std::shared_ptr<const Data> data_;
};

/// A body that stands somewhere: x_W = pose(x_B). Moving and turning it copies no points.
struct Placed {
  Body body;
  Pose pose;

  Placed(Body what, Pose where = {})
      : body(std::move(what)), pose(std::move(where)) {}  // NOLINT: at the origin

  [[nodiscard]] double support(const Eigen::Vector3d& n) const {  // m
    return n.dot(pose.position) + body.support(pose.rotation.transpose() * n);
  }
  [[nodiscard]] Eigen::Vector3d middle() const { return pose.to_world(body.middle()); }  // m
  /// Its numbers are rounded once.
  [[nodiscard]] Ellipsoid containing_ellipsoid() const;
};

/// Bodies in the world: every number is rounded once, none where the pose is the identity. A rotation that is
/// not orthonormal to 1e-12 is refused: InputError naming "pose.rotation".
[[nodiscard]] Ellipsoid in_world(const Ellipsoid& body, const Pose& pose);
[[nodiscard]] CombinedEllipsoid in_world(const CombinedEllipsoid& body, const Pose& pose);
[[nodiscard]] HullBody in_world(const HullBody& body, const Pose& pose);

/// All within `margin` metres of the body: the Minkowski sum with a ball, of each of its parts. Margins add,
/// rounded once; 0 leaves the body as it is. An assembly becomes one of convex bodies, a cloud stays one.
/// Throws InputError naming "margin": not finite, negative, or of a body that hyperboloids delimit.
[[nodiscard]] Body swollen(const Body& body, double margin);

/// x_C = first(second(x)).
[[nodiscard]] Pose composed(const Pose& first, const Pose& second);
[[nodiscard]] Pose inverse(const Pose& pose);

/// A planar body as a spatial one: a third semi-axis of `height` metres along z, hyperbolas become cylinders.
/// At every z its section is contained in the one at z = 0. So of two bodies raised to heights no shorter
/// than all their semi-axes, which move in the plane, relation, verdict and contact time are those of the
/// planar bodies, and of ellipses the signed distance of their shadows is as well: it is largest at a normal
/// in the plane.
[[nodiscard]] CombinedEllipsoid raised(const CombinedEllipse& body, double height);

}  // namespace vericone
