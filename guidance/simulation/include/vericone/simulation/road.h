// SPDX-License-Identifier: BSD-3-Clause
//
// Ways of vehicles on the ground, by formulas: lane changes and the squircle of chapters 3 and 4
// (errata 4.3).
#pragma once

#include <vericone/simulation/curve.h>
#include <Eigen/Core>
#include <memory>
#include <vector>

namespace vericone::simulation {

/// Where a vehicle is at a time, with velocity and acceleration: m, m/s, m/s^2.
struct RoadPoint {
  Eigen::Vector2d position = Eigen::Vector2d::Zero(), velocity = Eigen::Vector2d::Zero(),
                  acceleration = Eigen::Vector2d::Zero();
};

class Road {
 public:
  virtual ~Road() = default;
  [[nodiscard]] virtual RoadPoint at(double t) const = 0;  // t >= 0, s
  /// Times at which the acceleration jumps, ascending, s.
  [[nodiscard]] virtual std::vector<double> jumps() const { return {}; }
};

/// Constant velocity, and pulses across it: `acceleration` to the left for `seconds`, then as much to the
/// right: acceleration seconds^2 aside. Pulses that overlap add up.
struct LaneChange {
  double at = 0, seconds = 2, acceleration = 1;  // s, s, m/s^2
};
/// Throws InputError naming "velocity" (none to change lanes of, or not finite) or "changes[i].at",
/// "...seconds",
/// "...acceleration".
[[nodiscard]] std::shared_ptr<const Road> lane_road(const Eigen::Vector2d& start,
                                                    const Eigen::Vector2d& velocity,
                                                    std::vector<LaneChange> changes);

/// Fernandez-Guasti's squircle x^2 + y^2 - s^2 x^2 y^2 / r^2 = r^2, counter-clockwise once in `period` s, by
/// the parameter p = 2 pi t / period - pi/2 (errata 4.3); moved so that it begins at `start`, the middle of
/// its southern side, to the east. r: `radius`, m; s: `squareness`, 0 (a circle) to below 1 (a square).
/// Position and both derivatives are analytic. Throws InputError naming "radius", "squareness" or "period".
[[nodiscard]] std::shared_ptr<const Road> squircle_road(const Eigen::Vector2d& start, double radius,
                                                        double squareness, double period);

/// What a body on it starts as, z = height.
[[nodiscard]] Motion start_of(const Road& road, double height);

/// The road as curves for a Track, z = height, x ahead along the velocity; the road's own time is t -
/// `begins`. Pieces from jump to jump, halved until each is within half of `error` m of the road at eight
/// places. At rest the heading is 0. Throws InputError naming "to" or
/// "error". Cost: 10 us a curve.
[[nodiscard]] std::vector<Curve> curves_of(const Road& road, double height, double from, double to,
                                           double error, double begins = 0);

}  // namespace vericone::simulation
