// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace vericone {

/// Where a body stands: x_W = position + rotation x_B for a point x_B of the body's own frame; metres.
struct Pose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  // orthonormal, determinant +1

  /// Turned by the quaternion (w, x, y, z), |q| = 1 to 1e-6. Throws InputError naming "rotation".
  [[nodiscard]] static Pose from_quaternion(const Eigen::Vector3d& position, const Eigen::Vector4d& wxyz);

  [[nodiscard]] Eigen::Vector3d to_world(const Eigen::Vector3d& x) const { return position + rotation * x; }
  [[nodiscard]] Eigen::Vector3d to_body(const Eigen::Vector3d& x) const {
    return rotation.transpose() * (x - position);
  }
};

/// The nearest rotation of a matrix that is one up to accumulated rounding: one step of Newton's iteration
/// for the polar factor, whose error is the square of what it is given.
template <int D>
[[nodiscard]] Eigen::Matrix<double, D, D> orthonormal(const Eigen::Matrix<double, D, D>& r) {
  using Matrix = Eigen::Matrix<double, D, D>;
  const Matrix defect = Matrix::Identity() - r.transpose() * r;
  return r + 0.5 * (r * defect);
}

/// R M R^T, in the unit of M, symmetric bit for bit.
template <int D>
[[nodiscard]] Eigen::Matrix<double, D, D> turned(const Eigen::Matrix<double, D, D>& r,
                                                 const Eigen::Matrix<double, D, D>& m) {
  const Eigen::Matrix<double, D, D> image = r * m * r.transpose();
  return 0.5 * (image + image.transpose());
}

/// An axis-aligned solid box between two opposite corners, low <= high in each coordinate; metres. Flat ones
/// and points are boxes too.
struct Box {
  Eigen::Vector3d low = Eigen::Vector3d::Zero(), high = Eigen::Vector3d::Zero();

  [[nodiscard]] Eigen::Vector3d center() const { return 0.5 * (low + high); }
  [[nodiscard]] Eigen::Vector3d half_widths() const { return 0.5 * (high - low); }
  [[nodiscard]] bool contains(const Eigen::Vector3d& x) const {
    return (low.array() <= x.array()).all() && (x.array() <= high.array()).all();
  }
  void include(const Box& other) {
    low = low.cwiseMin(other.low);
    high = high.cwiseMax(other.high);
  }
};

}  // namespace vericone
