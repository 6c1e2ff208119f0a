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

// A pursuit law of our own: it meets the ellipse (or disc) and matches its velocity, and always has a
// command. With x from the ellipse's centre to A and w its velocity (relative), it steers w towards
//   w_d = -k x / sqrt(1 + k^2 |x| / most),
// slow enough far away that half of `most` brakes it: a = a_T + w_d' + K (w_d - w). Unsaturated, w - w_d
// decays as e^(-K t), then x as e^(-k t): w_d points to the centre, so that the course meets the ellipse
// (m < 0) before they have met, and y_2 = w^2 goes to 0 with x. Nothing is divided by: not by the distance,
// nor by the relative velocity, nor by the distance of the foci.

struct PursuitGains {
  double distance = 0.5;  // k, 1/s: the closing speed wanted is this times the distance, far away less
  double speed = 1;       // K, 1/s, of the velocity error
  double most = 10;       // m/s^2, of the whole, above 0
};

struct PursuitStep {
  Eigen::Vector2d acceleration = Eigen::Vector2d::Zero();  // in fixed axes, m/s^2, saturated
  double demanded = 0;                                     // m/s^2
  double m = 0;                                            // m: see miss_distance
  double y1 = 0, y2 = 0;  // the polynomial form of FocalLaw, and w^2, m^2/s^2
};

/// How far the half-line from x along w (both relative to the ellipse: from its centre, to its velocity)
/// passes the ellipse, m: the distance where it passes or leaves, minus the depth of its line where it meets.
/// Negative exactly where a straight motion from now on meets the inside of the ellipse. w = 0: the distance
/// of the point. Error: rounding of the sizes. Cost: 0.1 us.
[[nodiscard]] double miss_distance(const Eigen::Vector2d& x, const Eigen::Vector2d& w,
                                   const EnclosingEllipse& target);

/// `position` and `velocity`: of A, in fixed axes, m and m/s. `target_acceleration`: of the ellipse's centre,
/// m/s^2. Continuous in all of them. No allocation, no throw. Cost: 0.2 us.
[[nodiscard]] PursuitStep pursuit_law(const Eigen::Vector2d& position, const Eigen::Vector2d& velocity,
                                      const EnclosingEllipse& target,
                                      const Eigen::Vector2d& target_acceleration, const PursuitGains& gains);

/// What noise leaves of the cone: probability that the relative velocity is in it, and bounds of y.
struct ConeConfidence {
  double probability = 0;  // in [0, 1]
  double y_low = 0, y_high = 0;
};

/// `covariance`: of (x, y, v_x, v_y) relative to the ellipse, m and m/s, positive semidefinite; the ellipse
/// itself counts as known. The probability is that of m < 0 with Gaussian errors: a cubature of 509 points
/// over three directions, exact in the fourth, within 0.015 of 10^6 draws on all random cases of the test.
/// The bounds hold for every position and velocity within `deviations` of the mean (Mahalanobis), so with at
/// least the probability that chi-squared of 4 degrees is below deviations^2: 0.939 for 3; they are not the
/// least. No allocation, no throw. Cost: 40 us.
[[nodiscard]] ConeConfidence cone_confidence(const Eigen::Vector2d& position, const Eigen::Vector2d& velocity,
                                             const EnclosingEllipse& target,
                                             const Eigen::Matrix4d& covariance, double deviations = 3);

}  // namespace vericone::guidance
