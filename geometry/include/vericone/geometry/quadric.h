// SPDX-License-Identifier: BSD-3-Clause
//
// Conics and quadrics as symmetric matrices of homogeneous coordinates.
#pragma once

#include <vericone/geometry/ellipsoid.h>
#include <Eigen/Geometry>

namespace vericone {

/// What the zero set of a quadric is; planes, pairs and empty sets are `degenerate`.
enum class QuadricKind {
  ellipsoid,              // D = 2: ellipse
  imaginary_ellipsoid,    // no real point
  one_sheet_hyperboloid,  // D = 2: hyperbola (both kinds coincide there)
  two_sheet_hyperboloid,
  paraboloid,  // elliptic or hyperbolic; D = 2: parabola
  degenerate,  // det Q = 0
};

/// x~^T Q x~ with x~ = (x, 1): a conic (D = 2; source, (5.2)-(5.3)) or a quadric (D = 3; source,
/// (6.1)-(6.2)). Q has any scale; what is measured by it has that unit.
template <int D>
class BasicQuadric {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;
  using Matrix = Eigen::Matrix<double, D + 1, D + 1>;

  /// `matrix` must be finite, symmetric bit for bit and not zero. Throws InputError naming "quadric".
  explicit BasicQuadric(const Matrix& matrix);

  [[nodiscard]] const Matrix& matrix() const { return matrix_; }

  /// x~^T Q x~.
  [[nodiscard]] double value(const Vector& x) const;

  /// Class of the zero set, decided in rational arithmetic: never wrong by rounding. Note that the source's
  /// statement on det(Q) swaps the hyperboloids (errata, 3.6).
  [[nodiscard]] QuadricKind kind() const;

  /// The polar hyperplane Q p~ of the point p: its tangent there when p is on the surface (source, 5.2.1).
  [[nodiscard]] Eigen::Matrix<double, D + 1, 1> polar(const Vector& p) const {
    return matrix_ * p.homogeneous();
  }

 private:
  Matrix matrix_;
};

using Conic = BasicQuadric<2>;
using Quadric = BasicQuadric<3>;

/// A plane in space with its own coordinates: the point (a, b) of the plane is origin + a x_axis + b y_axis.
/// The axes are orthonormal for lengths and angles in the plane to be those of space.
struct PlaneFrame {
  Eigen::Vector3d origin, x_axis, y_axis;

  [[nodiscard]] Eigen::Vector3d normal() const { return x_axis.cross(y_axis); }
  [[nodiscard]] Eigen::Vector3d to_space(const Eigen::Vector2d& p) const {
    return origin + p.x() * x_axis + p.y() * y_axis;
  }
  [[nodiscard]] Eigen::Vector3d direction_to_space(const Eigen::Vector2d& v) const {
    return v.x() * x_axis + v.y() * y_axis;
  }
  [[nodiscard]] Eigen::Vector2d direction_to_plane(const Eigen::Vector3d& v) const {
    return {v.dot(x_axis), v.dot(y_axis)};
  }
};

/// The conic in which a plane cuts a quadric, P^T Q P (source, (6.11), (6.13)).
[[nodiscard]] Conic section(const Quadric& quadric, const PlaneFrame& plane);

}  // namespace vericone
