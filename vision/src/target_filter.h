// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace vericone::vision {

/// A point and how it is moved by a plane's motion from picture to picture.
struct PlaneStep {
  Eigen::Vector2d to = Eigen::Vector2d::Zero();
  Eigen::Matrix2d slope = Eigen::Matrix2d::Identity();  // of `to` by the point
  [[nodiscard]] double turn() const;                    // rad, u to v
  [[nodiscard]] double scale() const;
};
[[nodiscard]] PlaneStep plane_step(const Eigen::Matrix3d& ground, const Eigen::Vector2d& from);

/// Constant velocity over the ground, in pixels of the newest picture: a camera that turns or shakes changes
/// nothing of it.
class TargetFilter {
 public:
  TargetFilter() = default;
  /// `speed`: standard deviation of the first velocity, px a picture; `acceleration`: of its change from
  /// picture to picture.
  TargetFilter(const Eigen::Vector2d& centre, double position, double speed, double acceleration);

  /// `turn`: of the velocity over the ground, rad a picture.
  void predict(const Eigen::Matrix3d& ground, double turn = 0);
  /// Somebody else knows where the target is; its velocity stays.
  void place(const Eigen::Vector2d& centre, const Eigen::Matrix2d& covariance);
  void update(const Eigen::Vector2d& centre, const Eigen::Matrix2d& covariance);
  /// What it did before is no guide: `velocity` in px a picture; `position` and `speed`: standard deviations.
  void restart(const Eigen::Vector2d& centre, const Eigen::Vector2d& velocity, double position, double speed);

  [[nodiscard]] Eigen::Vector2d centre() const { return x_.head<2>(); }
  [[nodiscard]] Eigen::Vector2d velocity() const { return x_.tail<2>(); }  // px a picture
  [[nodiscard]] Eigen::Matrix2d covariance() const { return p_.topLeftCorner<2, 2>(); }
  void set_acceleration(double a) { acceleration_ = a; }

 private:
  Eigen::Vector4d x_ = Eigen::Vector4d::Zero();
  Eigen::Matrix4d p_ = Eigen::Matrix4d::Identity();
  double acceleration_ = 0;
};

}  // namespace vericone::vision
