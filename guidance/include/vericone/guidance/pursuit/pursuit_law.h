// SPDX-License-Identifier: BSD-3-Clause
//
// A pursuit law of our own: it meets the ellipse (or disc) and matches its velocity, and always has a
// command.
#pragma once

#include <vericone/guidance/pursuit/enclosing_ellipse.h>
#include <Eigen/Core>

namespace vericone::guidance {

struct PursuitGains {
  double distance = 0.5;  // 1/s: the closing speed wanted is this times the distance, far away less
  double speed = 1;       // 1/s, of the velocity error
  double most = 10;       // m/s^2, of the whole
};

struct PursuitStep {
  Eigen::Vector2d acceleration = Eigen::Vector2d::Zero();  // m/s^2, saturated
  double demanded = 0;                                     // m/s^2
  double m = 0;  // m: miss distance of the ellipse; negative: A is on a course that meets it
  double y1 = 0, y2 = 0;
};

/// `covariance`: of relative position and velocity (4 numbers), zero where it is not known.
[[nodiscard]] PursuitStep pursuit_law(const Eigen::Vector2d& position, const Eigen::Vector2d& velocity,
                                      const EnclosingEllipse& target,
                                      const Eigen::Vector2d& target_acceleration, const PursuitGains& gains);

/// What noise leaves of the cone: probability that the relative velocity is in it, and bounds of y.
struct ConeConfidence {
  double probability = 0;  // in [0, 1]
  double y_low = 0, y_high = 0;
};
[[nodiscard]] ConeConfidence cone_confidence(const Eigen::Vector2d& position, const Eigen::Vector2d& velocity,
                                             const EnclosingEllipse& target,
                                             const Eigen::Matrix4d& covariance, double deviations = 3);

}  // namespace vericone::guidance
