// SPDX-License-Identifier: BSD-3-Clause
//
// Convex bodies with flat, round and straight parts: cylinders, capsules, cones, boxes, swollen bodies.
#pragma once

#include <vericone/geometry/ellipsoid.h>
#include <vericone/geometry/hull_body.h>
#include <vericone/geometry/pose.h>
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace vericone {

/// The convex hull of finitely many points, ellipses and ellipsoids, swollen by one ball:
///
///     C = hull( p_1 + F_1 U, ..., p_m + F_m U ) + margin U      U the unit ball
///     h(n) = max_i ( n.p_i + |F_i^T n| ) + margin |n|
///
/// in the body's own frame, metres. A cylinder is the hull of two discs, a capsule that of two points with a
/// margin, a box that of its corners (docs/explanation/shapes.md). What is proved of it is proved of these
/// numbers as they are stored. Round named bodies have the axis z; each is about the middle of its height.
/// Sizes may be 0: a cylinder without height is a disc, one without radius a segment. Immutable.
class Convex {
 public:
  struct Piece {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();  // p, m
    Eigen::Matrix3d factor = Eigen::Matrix3d::Zero();  // F, m; its columns from `rank` on are zero
    int rank = 0;                                      // 0 a point, 2 an ellipse, 3 an ellipsoid
    /// Of an ellipsoid that is defined by its shape matrix S (ellipsoid.h): S, and F F^T is S but rounded.
    std::optional<Eigen::Matrix3d> shape;

    bool operator==(const Piece&) const = default;
  };

  // Each throws InputError naming the parameter that is negative or not finite.
  [[nodiscard]] static Convex cylinder(double radius, double height);
  /// With semi-axes a along x and b along y.
  [[nodiscard]] static Convex elliptic_cylinder(double a, double b, double height);
  /// `length`: between the centres of its two ends, so length + 2 radius from tip to tip.
  [[nodiscard]] static Convex capsule(double radius, double length);
  /// The apex is at z = height / 2.
  [[nodiscard]] static Convex cone(double radius, double height);
  /// Radii at z = -height / 2 and height / 2.
  [[nodiscard]] static Convex frustum(double bottom, double top, double height);
  /// Flat, in the plane z = 0.
  [[nodiscard]] static Convex disc(double radius);
  [[nodiscard]] static Convex ellipse(double a, double b);
  [[nodiscard]] static Convex box(const Eigen::Vector3d& half_widths);
  [[nodiscard]] static Convex point(const Eigen::Vector3d& at = Eigen::Vector3d::Zero());
  [[nodiscard]] static Convex segment(const Eigen::Vector3d& from, const Eigen::Vector3d& to);
  /// A body and all that is within `margin` of it.
  [[nodiscard]] static Convex rounded(const HullBody& hull, double margin);
  [[nodiscard]] static Convex rounded(const Ellipsoid& ellipsoid, double margin);
  [[nodiscard]] static Convex hull_of(const Ellipsoid& first, const Ellipsoid& second);
  /// Of pieces as they are. Throws InputError naming "pieces" (none), "pieces[i].rank" (not 0, 2 or 3),
  /// "pieces[i].center[k]" or "pieces[i].factor" (not finite, or columns that are dependent to 1e-13), or
  /// "margin".
  [[nodiscard]] static Convex of_pieces(std::vector<Piece> pieces, double margin = 0);

  /// One or more; no two are the same, and balls that all pieces have alike are part of the margin.
  [[nodiscard]] const std::vector<Piece>& pieces() const { return pieces_; }
  [[nodiscard]] double margin() const { return margin_; }  // m, >= 0
  /// What it was made as: "cylinder", "capsule", ...; of others "convex". No answer depends on it.
  [[nodiscard]] const std::string& word() const { return word_; }
  [[nodiscard]] Convex called(std::string word) const;

  /// Whether all pieces are points and there is no margin: a hull.
  [[nodiscard]] bool is_hull() const;

  /// Whether it may lie in a plane: false is certain.
  [[nodiscard]] bool is_flat() const;

  /// Support function max n.x over the body; rounded. Linear in the number of pieces.
  [[nodiscard]] double support(const Eigen::Vector3d& n) const;
  /// The point of the body farthest along n; rounded. Any one of them where there are several.
  [[nodiscard]] Eigen::Vector3d support_point(const Eigen::Vector3d& n) const;

  /// Around the body, outwards by a few roundings.
  [[nodiscard]] Box bounds() const;
  /// Points whose convex hull, rounded by margin(), contains the body, and is the body where is_hull() or it
  /// is one of points with a margin: around ellipses and ellipsoids the corners of what their axes span.
  [[nodiscard]] std::vector<Eigen::Vector3d> corners() const;

  /// A point amid the body: the mean of the pieces' centres.
  [[nodiscard]] Eigen::Vector3d middle() const;

  /// All within `by` >= 0 metres of it; the margin is rounded once. Throws InputError naming "margin".
  [[nodiscard]] Convex swollen(double by) const;
  /// Each centre is rounded once.
  [[nodiscard]] Convex translated(const Eigen::Vector3d& by) const;
  /// The image under x -> scale * x, scale > 0; each number is rounded once.
  [[nodiscard]] Convex scaled(double scale) const;

  bool operator==(const Convex&) const = default;

 private:
  Convex(std::vector<Piece> pieces, double margin, std::string word);
  friend Convex in_world(const Convex& body, const Pose& pose);

  std::vector<Piece> pieces_;
  double margin_ = 0;
  std::string word_;
};

/// In the world: every number is rounded once, none where the pose is the identity; factors that were equal
/// stay so. Throws InputError naming "pose.rotation" as the others of body.h.
[[nodiscard]] Convex in_world(const Convex& body, const Pose& pose);

}  // namespace vericone
