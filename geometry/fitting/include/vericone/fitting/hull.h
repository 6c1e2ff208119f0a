// SPDX-License-Identifier: BSD-3-Clause
//
// What is fitted: points, or a mesh; and the frame in which fits are computed.
#pragma once

#include <vericone/geometry/combined.h>
#include <vericone/geometry/quadric.h>
#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace vericone::fitting {

/// Points in metres. A mesh has triangles besides, as indices into the points; what a fit has to do with are
/// then the points that triangles use, and the triangles between them.
struct Sample {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  [[nodiscard]] bool is_mesh() const { return !triangles.empty(); }
};

/// Coordinates that belong to the sample: origin at its mean, axes along its principal directions (signs by
/// the third moments), and a length. x = origin + scale * axes * y.
struct Frame {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  // a rotation
  double scale = 1;

  [[nodiscard]] Eigen::Vector3d to_frame(const Eigen::Vector3d& x) const {
    return axes.transpose() * (x - origin) / scale;
  }
  [[nodiscard]] Eigen::Vector3d to_world(const Eigen::Vector3d& y) const {
    return origin + scale * (axes * y);
  }
};

/// Coordinates rounded to 2^-26, a hundred-millionth of the unit ball. Those of the same sample in another
/// frame differ by some 1e-15 and are then (but for one in ten million) the same numbers: searches that
/// branch are done with them, so that they take the same way.
[[nodiscard]] Eigen::Vector3d rounded(const Eigen::Vector3d& y);

// Quadric hulls: unions of combined quadrics, and what is proved of them.

enum class Shape {
  ellipse,  // footprint on the xy plane; as a body the upright elliptic cylinder over it
  ellipsoid,
  biconcave,  // ellipsoid and the outside of a two-sheeted hyperboloid (source, (6.8))
  biconvex,   // ellipsoid and the inside of a one-sheeted hyperboloid (source, (6.9))
  star,       // ellipsoid and two or more hyperboloids of either kind
};
[[nodiscard]] std::string to_string(Shape shape);

/// 5 for an ellipse, 9 for an ellipsoid, 6 more for each delimiter: of a star the least that it has, 21.
[[nodiscard]] int parameters(Shape shape);

/// One body of a hull. A point is in it where it is on the negative side of all its quadrics.
struct Piece {
  /// In space; for the shape `ellipse` not used.
  CombinedEllipsoid body;

  /// For the shape `ellipse` only: the footprint, and where z ends (low = high: the points are planar).
  std::optional<Ellipse> footprint;
  double low = 0, high = 0;  // m

  /// What is proved is proved of these numbers. The first is the ellipsoid (or elliptic cylinder), then one
  /// for each delimiter (or, where low < high, the slab between them).
  std::vector<Quadric> quadrics;
};

/// What exact arithmetic says of a hull and a sample. Coverage is the part of the points that is inside.
struct Certificate {
  std::size_t points = 0, points_inside = 0;
  /// Of a mesh. A triangle counts as inside where one piece contains all of it.
  std::size_t triangles = 0, triangles_inside = 0;
  /// Points whose ball of radius `margin` (m) intervals prove to be inside one piece: one that touches the
  /// boundary to rounding may count as outside. points_inside where the margin is 0.
  double margin = 0;
  std::size_t margins_inside = 0;
  /// Points and triangles that intervals did not decide.
  std::size_t by_exact = 0;
  /// Indices of the points nearest to the boundary of the piece in which they are deepest, nearest first, at
  /// most 20: values above -1e-9 where the centre has -1.
  std::vector<std::size_t> touching;

  [[nodiscard]] bool all_inside() const {
    return points_inside == points && triangles_inside == triangles && margins_inside == points;
  }
  [[nodiscard]] double coverage() const { return points ? double(points_inside) / double(points) : 1; }
};

/// Points and triangles of a mesh (the points that triangles use), or of a cloud, against pieces given by
/// quadrics. Nothing but the numbers of `quadrics` enters, so that anyone can repeat it from what is
/// written. Decided by intervals, else in rational arithmetic: a triangle is inside where the greatest value
/// of each quadric on it is not positive, which the corners, the edges along which the quadric is concave,
/// and the plane where it is concave on it tell. Throws InputError naming "pieces" or "pieces[i]" where there
/// is none or no quadric, "points[i]", "triangles[i]" or "margin". Linear in points times pieces.
[[nodiscard]] Certificate check(const std::vector<std::vector<Quadric>>& pieces, const Sample& sample,
                                double margin = 0);

/// A claim and its proof as text, or why there is none.
struct InsideCertificate {
  std::string text;    // one JSON object, on one line; empty where there is none
  std::string reason;  // empty where there is one
};

/// That everything that counts in the sample is inside, each point or triangle in one piece, for a program
/// that checks it and knows nothing of this library (docs/reference/certificates.md): all numbers of the
/// sample and of the quadrics, and which piece contains what. There is none where check() finds something
/// outside. Margins are no part of it. Throws as check(). Costs a check, and some 100 bytes a point.
[[nodiscard]] InsideCertificate inside_certificate(const std::vector<std::vector<Quadric>>& pieces,
                                                   const Sample& sample);

/// Which piece is to contain what; -1: none has to. Sizes of points and triangles of the sample.
struct Assignment {
  std::vector<int> points, triangles;
};

/// Inflates each surface of each piece about its centre by the least factor for which exact arithmetic says
/// that it contains what is assigned to its piece, with balls of radius `margin` about the points: `body` (by
/// combined.h) as well as `quadrics`, which are set here. The factors are 1 + a few roundings where the
/// fit was tight; `quadrics` far from the origin and of very thin bodies need more
/// (docs/explanation/fitting-proof.md). Surfaces are only ever moved outwards, so that a delimiter may come
/// to miss its ellipsoid. Returns the largest factor applied to a body. Throws InputError as check, and
/// naming "assignment.points" or "assignment.triangles".
double enclose(std::vector<Piece>& pieces, const Sample& sample, const Assignment& assignment,
               double margin = 0);

}  // namespace vericone::fitting
