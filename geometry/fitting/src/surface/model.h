// SPDX-License-Identifier: BSD-3-Clause
//
// Bodies as vectors of parameters, and distances of points from them with derivatives.
#pragma once

#include <vericone/fitting/hull.h>
#include <Eigen/Core>
#include <vector>

namespace vericone::fitting {

/// Which surfaces there are. The parameters are
///   centre p (planar: 2), the triangular factor G of the ellipsoid |G (x - p)| = 1 (logarithms of the
///   diagonal, then what is below it): positive definite for all values and regular at the ball,
///   for each delimiter a vector v along its axis and the triangular factor K of what is across it, in two
///   axes perpendicular to v that turn with it: v v^T - K K^T (dents) or its negative (a waist). So the
///   signature stays while v and the diagonal of K are not zero.
/// Planar: the third row and column of the ellipsoid's matrix are zero, an upright cylinder.
struct SurfaceModel {
  struct Delimiting {
    int sheets = 2;                                      // 2: dents, 1: a waist
    Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  // the axes to turn; the first is that of v at start
  };
  bool planar = false;
  std::vector<Delimiting> delimiters;

  static constexpr int kMost = 27;
  int center_size() const { return planar ? 2 : 3; }
  int ellipsoid_size() const { return planar ? 5 : 9; }
  int size() const { return ellipsoid_size() + 6 * static_cast<int>(delimiters.size()); }
};

using Parameters = Eigen::VectorXd;

/// Parameters of an ellipsoid (cylinder) { x : (x-p)^T M (x-p) = 1 }, M positive definite.
Parameters ellipsoid_parameters(bool planar, const Eigen::Vector3d& center, const Eigen::Matrix3d& matrix);

/// Appends a delimiter with these semi-axes (hyperboloid() of combined.h), its axis first.
void append_delimiter(SurfaceModel& model, Parameters& parameters, int sheets,
                      const Eigen::Vector3d& semi_axes, const Eigen::Matrix3d& axes);

/// The surfaces { x : (x-p)^T M (x-p) = 1 } at some parameters.
class Surfaces {
 public:
  struct Surface {
    Eigen::Matrix3d matrix, axes;
    Eigen::Vector3d eigenvalues;  // increasing, along the columns of `axes`
    int first = 0, count = 0;     // its parameters
    /// Derivatives of xx, yy, zz, 2xy, 2xz, 2yz of the matrix by each of them.
    Eigen::Matrix<double, 6, 6> derivative = Eigen::Matrix<double, 6, 6>::Zero();
  };

  Surfaces(const SurfaceModel& model, const Parameters& parameters);

  const Eigen::Vector3d& center() const { return center_; }
  const std::vector<Surface>& all() const { return all_; }

  /// Signed distance of a point from the boundary of the body: the largest of those to the surfaces, outside
  /// near a rim (where two surfaces meet) that to the rim. `gradient`, if not null: by the parameters
  /// (size()); with f = 0 the surface it is (df/dtheta) / |grad f| at the nearest point.
  double distance(const Eigen::Vector3d& x, double* gradient) const;

  /// Of the ellipsoid alone.
  double ellipsoid_distance(const Eigen::Vector3d& x) const;

  CombinedEllipsoid body() const;  // not planar
  Ellipse footprint() const;       // planar

  /// Semi-axes of the ellipsoid, decreasing, and their derivatives by the parameters (rows).
  Eigen::Vector3d semi_axes() const;
  Eigen::MatrixXd semi_axes_derivative() const;

 private:
  bool planar_;
  int size_, center_size_;
  Eigen::Vector3d center_;
  std::vector<Surface> all_;
};

}  // namespace vericone::fitting
