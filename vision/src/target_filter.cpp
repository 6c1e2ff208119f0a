// SPDX-License-Identifier: BSD-3-Clause
#include "target_filter.h"

#include <Eigen/Dense>
#include <cmath>

namespace vericone::vision {

double PlaneStep::turn() const { return std::atan2(slope(1, 0) - slope(0, 1), slope(0, 0) + slope(1, 1)); }
double PlaneStep::scale() const { return std::sqrt(std::abs(slope.determinant())); }

PlaneStep plane_step(const Eigen::Matrix3d& ground, const Eigen::Vector2d& from) {
  const Eigen::Vector3d q = ground * from.homogeneous();
  PlaneStep step;
  step.to = q.hnormalized();
  step.slope = (ground.topLeftCorner<2, 2>() - step.to * ground.block<1, 2>(2, 0)) / q.z();
  return step;
}

TargetFilter::TargetFilter(const Eigen::Vector2d& centre, double position, double speed, double acceleration)
    : acceleration_(acceleration) {
  restart(centre, Eigen::Vector2d::Zero(), position, speed);
}

void TargetFilter::predict(const Eigen::Matrix3d& ground, double turn) {
  const PlaneStep step = plane_step(ground, x_.head<2>() + x_.tail<2>());
  Eigen::Matrix4d f = Eigen::Matrix4d::Zero();
  f.topLeftCorner<2, 2>() = f.topRightCorner<2, 2>() = step.slope;
  f.bottomRightCorner<2, 2>() = step.slope * Eigen::Rotation2Dd(turn).toRotationMatrix();
  x_.head<2>() = step.to;
  x_.tail<2>() = f.bottomRightCorner<2, 2>() * x_.tail<2>();
  p_ = f * p_ * f.transpose();
  const double a = acceleration_ * acceleration_;
  for (int i = 0; i < 2; ++i) {
    p_(i, i) += 0.25 * a;
    p_(i, i + 2) += 0.5 * a;
    p_(i + 2, i) += 0.5 * a;
    p_(i + 2, i + 2) += a;
  }
}

void TargetFilter::place(const Eigen::Vector2d& centre, const Eigen::Matrix2d& covariance) {
  x_.head<2>() = centre;
  p_.topLeftCorner<2, 2>() = covariance;
  p_.topRightCorner<2, 2>().setZero();
  p_.bottomLeftCorner<2, 2>().setZero();
}

void TargetFilter::restart(const Eigen::Vector2d& centre, const Eigen::Vector2d& velocity, double position,
                           double speed) {
  x_ << centre, velocity;
  const double p = position * position, v = speed * speed;
  p_ = Eigen::Vector4d(p, p, v, v).asDiagonal();
}

void TargetFilter::update(const Eigen::Vector2d& centre, const Eigen::Matrix2d& covariance) {
  const Eigen::Matrix<double, 4, 2> ph = p_.leftCols<2>();
  const Eigen::Matrix2d s = ph.topRows<2>() + covariance;
  const Eigen::Matrix<double, 4, 2> k = ph * s.inverse();
  x_ += k * (centre - x_.head<2>());
  Eigen::Matrix4d i = Eigen::Matrix4d::Identity();
  i.leftCols<2>() -= k;
  p_ = i * p_ * i.transpose() + k * covariance * k.transpose();  // Joseph's form stays definite
}

}  // namespace vericone::vision
