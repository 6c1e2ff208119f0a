// SPDX-License-Identifier: BSD-3-Clause
//
// Combined quadrics: an ellipsoid (ellipse) delimited by hyperboloids (hyperbolas) about the same centre.
// Dents (biconcave ellipsoid, source (6.8)), waists (biconvex hyperboloid, (6.9)), stars, and in the plane
// the source's "confocal" conic (5.5).
#pragma once

#include <vericone/geometry/ellipsoid.h>
#include <vericone/geometry/quadric.h>
#include <vericone/geometry/sign.h>
#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

namespace vericone {

/// The region { y : y^T M y <= level } about the centre of a body; level >= 0, so that it contains the
/// centre. M indefinite: the side of a hyperboloid (level > 0) or of its asymptotic cone (level = 0) that the
/// centre is on; y in metres. What an exact predicate takes as the region are these stored numbers.
template <int D>
struct Delimiter {
  Eigen::Matrix<double, D, D> matrix;  // symmetric bit for bit, 1 / m^2
  double level = 1;                    // dimensionless, as is value()

  [[nodiscard]] double value(const Eigen::Matrix<double, D, 1>& y) const { return y.dot(matrix * y) - level; }
};

/// How a delimiter changes beyond moving and turning with its body.
template <int D>
struct DelimiterRate {
  Eigen::Matrix<double, D, D> matrix = Eigen::Matrix<double, D, D>::Zero();  // 1 / (m^2 s)
  double level = 0;                                                          // 1 / s
};

/// How a body changes beyond moving and turning; zero for rigid ones. Of a planar body the x and y parts
/// count.
struct BodyRate {
  Eigen::Matrix3d shape = Eigen::Matrix3d::Zero();  // of the ellipsoid's S, m^2/s
  std::vector<DelimiterRate<3>> delimiters;         // missing ones are zero
};

/// The centre's side of the hyperboloid with semi-axes (a, b, c), its axis along the first column of
/// `rotation`:
///   sheets = 2:  x^2/a^2 - y^2/b^2 - z^2/c^2 <= 1 cuts two dents,
///   sheets = 1: -x^2/a^2 + y^2/b^2 + z^2/c^2 <= 1 cuts a waist.
/// Throws InputError naming "sheets", "semi_axes[i]" or "rotation".
[[nodiscard]] Delimiter<3> hyperboloid(int sheets, const Eigen::Vector3d& semi_axes,
                                       const Eigen::Matrix3d& rotation = Eigen::Matrix3d::Identity());

/// The centre's side of the hyperbola x^2/a^2 - y^2/b^2 = 1, its x axis turned counter-clockwise by `angle`:
/// dents at both ends of that axis. Throws InputError naming "semi_axes[i]" or "angle".
[[nodiscard]] Delimiter<2> hyperbola(const Eigen::Vector2d& semi_axes, double angle = 0);

/// { x : x in E, (x-p)^T M_i (x-p) <= level_i for all i }, p the centre of the ellipsoid E; lengths in
/// metres.
///
/// All regions have the same centre and contain it, so the body is symmetric about it and *star-shaped* about
/// it: with x it contains the whole segment from p to x. That is what the cones of these bodies rest on
/// (docs/explanation/theory.md, 6). No delimiter: the ellipsoid itself. A new combination is a new list of
/// delimiters; no code knows particular shapes.
template <int D>
class BasicCombined {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;
  using Matrix = Eigen::Matrix<double, D, D>;

  BasicCombined() = default;
  BasicCombined(const BasicEllipsoid<D>& ellipsoid) : ellipsoid_(ellipsoid) {}  // NOLINT: an ellipsoid is one

  /// Delimiter matrices in the axes of space (not of the body). Throws InputError naming
  /// "hyperboloids[i].matrix" or "hyperboloids[i].level" where they are not finite, not symmetric or
  /// negative, and "hyperboloids[i]" where the surface does not cut the ellipsoid: it then delimits nothing,
  /// which is a mistake in the parameters.
  BasicCombined(const BasicEllipsoid<D>& ellipsoid, std::vector<Delimiter<D>> delimiters);

  [[nodiscard]] const BasicEllipsoid<D>& ellipsoid() const { return ellipsoid_; }
  [[nodiscard]] const std::vector<Delimiter<D>>& delimiters() const { return delimiters_; }
  [[nodiscard]] const Vector& center() const { return ellipsoid_.center(); }
  [[nodiscard]] bool is_ellipsoid() const { return delimiters_.empty(); }

  /// 1 / r(u), where p + r(u) u is on the boundary: positively homogeneous, below 1 inside, above 1 outside.
  /// Infinity for directions in which the body has no extent (level 0).
  [[nodiscard]] double gauge(const Vector& u) const;

  /// The surfaces as quadrics, the ellipsoid's first; rounded where the centre is not the origin.
  [[nodiscard]] std::vector<BasicQuadric<D>> quadrics() const;

  /// An ellipsoid that contains the body: of least volume among the nonnegative combinations of the quadrics
  /// (any such combination contains the body), widened by a few roundings.
  [[nodiscard]] BasicEllipsoid<D> bounding_ellipsoid() const;

  /// An ellipsoid about the centre that the body contains, narrowed by a few roundings. Nothing where the
  /// body has no interior at its centre (level 0). Largest for one delimiter, not necessarily for several.
  [[nodiscard]] std::optional<BasicEllipsoid<D>> inscribed_ellipsoid() const;

  [[nodiscard]] BasicCombined translated(const Vector& by) const;
  /// The image under x -> scale * x, scale > 0.
  [[nodiscard]] BasicCombined scaled(double scale) const;

  /// Without any check; for images of valid bodies.
  [[nodiscard]] static BasicCombined trusted(const BasicEllipsoid<D>& ellipsoid,
                                             std::vector<Delimiter<D>> delimiters);

 private:
  BasicEllipsoid<D> ellipsoid_;
  std::vector<Delimiter<D>> delimiters_;
};

using CombinedEllipse = BasicCombined<2>;
using CombinedEllipsoid = BasicCombined<3>;

/// The source's conic (5.5), (x'/a_c)^2 + |(y'/b_c)^2 - k| = 1 with x' at the angle phi: the ellipse with
/// semi-axes a_c sqrt(1+k), b_c sqrt(1+k) delimited by the hyperbola with a_c sqrt(1-k), b_c sqrt(1-k), dents
/// at the x' ends. k = 0: the ellipse (a_c, b_c); k = 1: pinched to a point at the centre. The source calls
/// it confocal; the two conics share their foci for k = (b_c/a_c)^2 only (errata, 3.5). Throws InputError
/// naming "semi_axes[i]", "k" or "phi".
[[nodiscard]] CombinedEllipse dented_conic(const Eigen::Vector2d& center, double a_c, double b_c, double k,
                                           double phi);

/// A corner of a planar body: where two of its boundary conics cross. Conic 0 is the ellipse, i + 1 the
/// delimiter i.
struct Corner {
  Eigen::Vector2d point = Eigen::Vector2d::Zero();  // m
  int first = 0, second = 0;
};

/// All corners, counter-clockwise; they come in opposite pairs. None for an ellipse. Each is a root of a
/// homogeneous quadratic in the direction from the centre, so right to a few roundings.
[[nodiscard]] std::vector<Corner> corners(const CombinedEllipse& body);

/// The section of a body by a plane through its centre, in coordinates of the plane (orthonormal axes),
/// placed at `center`. A hyperboloid's section may be an ellipse, or not there (then it is left out).
[[nodiscard]] CombinedEllipse central_section(const CombinedEllipsoid& body, const Eigen::Vector3d& x_axis,
                                              const Eigen::Vector3d& y_axis, const Eigen::Vector2d& center);

// On which side of a quadric, of a body, or of a combination of quadrics a point lies. Exact.
//
// Laws (tests/geometry/quadric_side_test.cpp): a positive multiple of the matrix changes nothing, a negative
// one negates the answer; a body and its quadric agree where both are exact; the side of a combination is the
// largest of its members' sides; rungs that answer agree.

/// Sign of x~^T Q x~, x~ = (x, 1): negative inside where the quadric is written that way (Ellipsoid::quadric,
/// docs/reference/formats.md). A polynomial of degree 1 in Q and 2 in x. Throws InputError naming "point[i]"
/// for coordinates that are not finite. Cost: about 20 ns where the first rung decides.
template <int D>
[[nodiscard]] Sign side(const BasicQuadric<D>& quadric, const Eigen::Matrix<double, D, 1>& point,
                        Rung* rung = nullptr);

/// The same for a body, as the matrix that defines it says: negative inside, zero on the surface. In
/// determinants, sign of |adj(F)(x - p)|^2 - det(F)^2 or of (x - p)^T adj(S) (x - p) - det S.
template <int D>
[[nodiscard]] Sign side(const BasicEllipsoid<D>& body, const Eigen::Matrix<double, D, 1>& point,
                        Rung* rung = nullptr);

/// The same for combined quadrics: negative inside, zero on the boundary, positive outside. A delimiter's
/// value d^T M d - level, d = x - p, is of degree 1 in M and 2 in d. `rung`: the highest one asked.
template <int D>
[[nodiscard]] Sign side(const BasicCombined<D>& body, const Eigen::Matrix<double, D, 1>& point,
                        Rung* rung = nullptr);

/// Side of the combination { x : x~^T Q_i x~ <= 0 for all i }: negative in its interior, zero on its
/// boundary, positive outside. Empty: all of space. `rung`: the last one asked.
template <int D>
Sign side(std::span<const BasicQuadric<D>> quadrics, const Eigen::Matrix<double, D, 1>& point,
          Rung* rung = nullptr);

/// Tags of the ladders for rung_counts().
struct PointQuadric;
struct PointBody;
struct PointCombined;

}  // namespace vericone
