// SPDX-License-Identifier: BSD-3-Clause
//
// Ways of vehicles on the ground, by formulas: lane changes and the squircle of chapters 3 and 4
// (errata 2.1).
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
};

/// Constant velocity, and pulses across it: `acceleration` to the left for `seconds`, then as much to the
/// right.
struct LaneChange {
  double at = 0, seconds = 2, acceleration = 1;
};
[[nodiscard]] std::shared_ptr<const Road> lane_road(const Eigen::Vector2d& start,
                                                    const Eigen::Vector2d& velocity,
                                                    std::vector<LaneChange> changes);
/// Fernandez-Guasti's squircle, moved so that it begins at `start` at the middle of its southern side.
[[nodiscard]] std::shared_ptr<const Road> squircle_road(const Eigen::Vector2d& start, double radius,
                                                        double squareness, double period);

/// The road as curves for a Track, to `error` m.
[[nodiscard]] std::vector<Curve> curves_of(const Road& road, double height, double from, double to,
                                           double error);

}  // namespace vericone::simulation
