// SPDX-License-Identifier: BSD-3-Clause
//
// Feet of perpendiculars on a quadric about the origin.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace vericone::fitting {

struct Foot {
  Eigen::Vector3d point;
  double distance = 0;
};

/// { y : y^T M y = level }, level >= 0, M with a positive eigenvalue: ellipsoids, hyperboloids of both kinds,
/// cones. All lengths about 1, so that squares do not overflow.
class CenteredQuadric {
 public:
  CenteredQuadric(const Eigen::Matrix3d& matrix, double level);
  /// An ellipsoid; from its axes, since the long ones of thin bodies are lost in the matrix.
  static CenteredQuadric ellipsoid(const Eigen::Matrix3d& axes, const Eigen::Vector3d& semi_axes);

  /// y^T M y - level, of the sign that says on which side y is.
  double value(const Eigen::Vector3d& y) const;

  /// The nearest point of the surface.
  Foot nearest(const Eigen::Vector3d& x) const;

  /// Adds every other point y of the surface within `reach` of the origin at which the distance from x has a
  /// local minimum on the surface and x - y points to where y^T M y grows; and perhaps other points of the
  /// surface.
  void add_other_feet(const Eigen::Vector3d& x, double reach, std::vector<Eigen::Vector3d>& feet) const;

 private:
  CenteredQuadric() = default;

  Eigen::Matrix3d axes_;  // orthonormal columns
  Eigen::Vector3d values_;
  double level_ = 1;
};

}  // namespace vericone::fitting
