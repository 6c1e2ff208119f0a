// SPDX-License-Identifier: BSD-3-Clause
//
// The ellipse of least area around several vehicles (source 4.2.1, Algorithm 1), with the rates of its axes
// and foci, and labels of the foci that stay when it passes through a circle.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

namespace vericone::guidance {

struct EnclosingEllipse {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  // m
  double a = 0, b = 0;                               // semi-axes, a >= b, m
  double angle = 0;  // of the major axis, rad, unwrapped from ellipse to ellipse
  std::array<Eigen::Vector2d, 2> foci{Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};  // m
  // Rates, of points that move with given velocities: analytic (implicit differentiation of the optimum).
  Eigen::Vector2d centre_rate = Eigen::Vector2d::Zero();  // m/s
  double a_rate = 0, b_rate = 0, angle_rate = 0;          // m/s, m/s, rad/s
  std::array<Eigen::Vector2d, 2> foci_rates{Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};  // m/s
  /// a = b within 1e-9 of a: no axis, foci in the centre, their rates those of the centre, angle as before.
  bool circle = false;

  /// Half the width across the unit vector n, m: how far the ellipse reaches along n from its centre.
  [[nodiscard]] double reach(const Eigen::Vector2d& n) const;
};

/// The ellipse of least area around points, one a column (in Python one a row), and its rates: m and m/s.
/// `near`: an angle, from which the major axis is at most a quarter turn away. Where a point begins or ceases
/// to hold the ellipse its rates jump: they are those of the points that hold it now. Near a circle the foci
/// move fast without bound, as the root of a^2 - b^2. Throws InputError naming "points" or "velocities".
/// Error: 1e-10 of the size, rates 1e-7 of the speeds away from circles. Cost: 10 us for 12 points.
[[nodiscard]] EnclosingEllipse enclosing_ellipse(const Eigen::Ref<const Eigen::Matrix2Xd>& points,
                                                 const Eigen::Ref<const Eigen::Matrix2Xd>& velocities,
                                                 double near);

/// One ellipse after another of the same vehicles.
class EllipseFollower {
 public:
  /// `side`: of the axis-parallel square around every vehicle's centre, m (the source's 8).
  explicit EllipseFollower(double side);
  /// Of the vehicles' centres and velocities, m and m/s, at least one. Throws InputError naming "centres".
  const EnclosingEllipse& step(std::span<const Eigen::Vector2d> centres,
                               std::span<const Eigen::Vector2d> velocities);
  [[nodiscard]] const EnclosingEllipse& ellipse() const { return ellipse_; }

 private:
  double side_;
  EnclosingEllipse ellipse_;
};

}  // namespace vericone::guidance
