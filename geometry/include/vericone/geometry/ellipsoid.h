// SPDX-License-Identifier: BSD-3-Clause
//
// Ellipses and ellipsoids, the convex quadric bodies.
#pragma once

#include <vericone/geometry/sound_arithmetic.h>
#include <vericone/internal/geometry/alignment.h>
#include <Eigen/Core>

namespace vericone {

template <int D>
class BasicQuadric;

/// A solid ellipse (D = 2) or ellipsoid (D = 3), lengths in metres.
///
/// The body is { p + F u : |u| <= 1 } with centre p and factor F (D x D, invertible), or, what is the same,
/// { x : (x-p)^T S^{-1} (x-p) <= 1 } with shape matrix S = F F^T (symmetric positive definite; its
/// eigenvalues are the squared semi-axes).
///
/// What an *exact* predicate takes as the body depends on how it was made, and is never a rounded number:
/// from axes it is defined by the stored factor, S = F F^T without rounding; from a shape or quadric matrix
/// it is defined by the stored shape(). Both matrices are always there, the other one rounded.
template <int D>
class BasicEllipsoid {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;
  using Matrix = Eigen::Matrix<double, D, D>;

  /// Unit ball about the origin.
  BasicEllipsoid() = default;

  /// From semi-axes (positive) along the columns of `rotation` (orthonormal to 1e-6, determinant +1; replaced
  /// by the nearest rotation when it is not orthonormal to rounding). Throws InputError naming "center",
  /// "semi_axes[i]" or "rotation".
  [[nodiscard]] static BasicEllipsoid from_axes(const Vector& center, const Vector& semi_axes,
                                                const Matrix& rotation = Matrix::Identity());

  /// From the shape matrix S, symmetric (bit for bit) and positive definite. Definiteness is decided exactly,
  /// so a matrix is never accepted or refused by rounding. Throws InputError naming "center" or "shape".
  [[nodiscard]] static BasicEllipsoid from_shape(const Vector& center, const Matrix& shape);

  /// From a quadric matrix Q, x~^T Q x~ = 0 with x~ = (x, 1), of either sign and any scale (source, (6.2)).
  /// Centre and shape are solved for in rational arithmetic and rounded once, so bodies far from the origin
  /// lose nothing. Throws InputError naming "quadric" when Q is not that of a real ellipsoid.
  [[nodiscard]] static BasicEllipsoid from_quadric(const BasicQuadric<D>& quadric);

  [[nodiscard]] const Vector& center() const { return center_; }
  [[nodiscard]] const Matrix& shape() const { return shape_; }
  [[nodiscard]] const Matrix& factor() const { return factor_; }
  [[nodiscard]] bool defined_by_factor() const { return defined_by_factor_; }

  /// Semi-axes in decreasing order, and the matching orthonormal directions in the columns.
  [[nodiscard]] Vector semi_axes() const;
  [[nodiscard]] Matrix axis_directions() const;

  /// rho(n) = sqrt(n^T S n): half the width of the body along n, times |n|. Relative error below 8 eps times
  /// the ratio of |F||n| to the result.
  [[nodiscard]] double radius(const Vector& n) const { return (factor_.transpose() * n).norm(); }

  /// Support function h(n) = max n.x over the body = n.p + rho(n).
  [[nodiscard]] double support(const Vector& n) const { return n.dot(center_) + radius(n); }

  /// The point of the body farthest along n != 0: p + S n / rho(n).
  [[nodiscard]] Vector support_point(const Vector& n) const {
    const Vector u = factor_.transpose() * n;
    return center_ + factor_ * (u / u.norm());
  }

  /// Quadric matrix of the surface, negative inside, scaled so that the centre has the value -1.
  [[nodiscard]] BasicQuadric<D> quadric() const;

  [[nodiscard]] double volume() const;

  [[nodiscard]] BasicEllipsoid translated(const Vector& by) const;

  /// The image under x -> scale * x, scale > 0.
  [[nodiscard]] BasicEllipsoid scaled(double scale) const;

  /// Of another one's stored numbers, without any check: the same body bit for bit.
  [[nodiscard]] static BasicEllipsoid trusted(const Vector& center, const Matrix& shape, const Matrix& factor,
                                              bool defined_by_factor) {
    BasicEllipsoid body;
    body.center_ = center;
    body.shape_ = shape;
    body.factor_ = factor;
    body.defined_by_factor_ = defined_by_factor;
    return body;
  }

 private:
  Vector center_ = Vector::Zero();
  Matrix shape_ = Matrix::Identity();
  Matrix factor_ = Matrix::Identity();
  bool defined_by_factor_ = true;
};

using Ellipse = BasicEllipsoid<2>;
using Ellipsoid = BasicEllipsoid<3>;

/// Counter-clockwise rotation of the plane by `angle` radians.
[[nodiscard]] Eigen::Matrix2d rotation_2d(double angle);

/// Rotation matrix of the quaternion (w, x, y, z), |q| = 1 to 1e-6; the remaining factor |q| is divided out.
/// Throws InputError naming "rotation".
[[nodiscard]] Eigen::Matrix3d rotation_3d(const Eigen::Vector4d& wxyz);

/// Body x axis at `azimuth` in the xy plane and `elevation` above it, no roll; radians (source, (6.5), where
/// gamma_z = azimuth and gamma_y = -elevation).
[[nodiscard]] Eigen::Matrix3d rotation_from_heading(double azimuth, double elevation);

}  // namespace vericone
