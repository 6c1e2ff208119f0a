// SPDX-License-Identifier: BSD-3-Clause
//
// A body of any kind as it stands in the world at an instant, in the plane or in space.
#pragma once

#include <vericone/geometry/body.h>
#include <optional>
#include <utility>
#include <variant>

namespace vericone {

/// In world coordinates, metres. Planar bodies lie in the plane z = 0 and move in it. An ellipsoid is a
/// combined body without delimiters. Rigid bodies of any kind (meshes, clouds, maps, unions) are placed:
/// moving and turning them copies no points. Who needs a body's kind asks here; who serves two kinds is asked
/// of pair.h and plane_cones.h.
class WorldBody {
 public:
  /// The unit disc about the origin.
  WorldBody() = default;
  WorldBody(CombinedEllipse flat) : kind_(std::move(flat)) {}          // NOLINT: each of these is one
  WorldBody(CombinedEllipsoid quadric) : kind_(std::move(quadric)) {}  // NOLINT
  WorldBody(HullBody hull) : kind_(std::move(hull)) {}                 // NOLINT
  WorldBody(Placed placed) : kind_(std::move(placed)) {}               // NOLINT

  [[nodiscard]] bool planar() const;
  /// Whether hyperboloids or hyperbolas cut it, so that it need not be convex. False of placed bodies.
  [[nodiscard]] bool delimited() const;

  // Its numbers, where it is that; otherwise null.
  [[nodiscard]] const CombinedEllipse* flat() const;
  [[nodiscard]] const CombinedEllipsoid* quadric() const;
  [[nodiscard]] const HullBody* hull() const;
  [[nodiscard]] const Placed* placed() const;

  /// What Pair takes. Allocates where it is not placed already. Throws InputError naming "bodies" for a
  /// planar body.
  [[nodiscard]] Placed as_placed() const;

  /// The point farthest along n of an ellipsoid or a hull, placed or not, rounded; nothing of other bodies.
  [[nodiscard]] std::optional<Eigen::Vector3d> support_point(const Eigen::Vector3d& n) const;

  /// Below 1 inside, above 1 outside: BasicCombined::gauge() about the centre. Throws InputError naming
  /// "body" unless it is flat() or quadric().
  [[nodiscard]] double gauge(const Eigen::Vector3d& x) const;

  /// The ellipse that stands for a body where only that will do, and contains it: itself, or
  /// bounding_ellipsoid(). Throws InputError naming "body" unless it is planar().
  [[nodiscard]] Ellipse containing_ellipse() const;

  /// The ellipsoid. An ellipsoid is itself; a combined body's is its bounding_ellipsoid(); a hull's is about
  /// the mean of its points, of their covariance, widened until it holds them all: linear in their number,
  /// not least. Of a placed body: Placed::containing_ellipsoid(), found once a body. Throws InputError naming
  /// "body" for a planar one.
  [[nodiscard]] Ellipsoid containing_ellipsoid() const;

  /// The largest distance of a point of the body from the origin, rounded up; of a placed body that of the
  /// farthest corner of its bounds. Requires flat() and quadric() to be about the origin.
  [[nodiscard]] double reach() const;

  /// The body about the origin taken to a position and turned by a rotation, right to rounding: its image is
  /// made orthonormal, ellipsoids are defined by their factors. Requires flat() and quadric() to be about the
  /// origin.
  [[nodiscard]] WorldBody posed(const Eigen::Vector3d& position, const Eigen::Matrix3d& rotation) const;

  /// The body moved from a reference point to another, turned about it by the rotation vector `turn`, and
  /// changed for `dt` seconds at a rate. S becomes X S X^T with X = I + S' S^{-1} dt/2, which is S + S' dt to
  /// first order and positive definite for every dt. Hulls and placed bodies are rigid.
  [[nodiscard]] WorldBody moved(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                const Eigen::Vector3d& turn, const BodyRate& rate, double dt) const;

  /// A body that contains all points within `distance` > 0 of this one. The ellipsoid: of the ellipsoids
  /// (1 + 1/p) S + (1 + p) distance^2, which all contain the sum with the ball, one that fits round bodies. A
  /// delimiter: (y + e)^T M (y + e) <= level + 2 |e| |M y| + |e|^2 |M| with y in the ellipsoid. Throws
  /// InputError naming "body" unless it is flat() or quadric().
  [[nodiscard]] WorldBody inflated(double distance) const;

 private:
  std::variant<CombinedEllipse, CombinedEllipsoid, HullBody, Placed> kind_;
};

}  // namespace vericone
