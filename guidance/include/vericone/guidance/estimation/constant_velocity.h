// SPDX-License-Identifier: BSD-3-Clause
//
// A body that keeps nearly its velocity: the filter of an obstacle's state.
#pragma once

#include <vericone/guidance/estimation/kalman.h>

namespace vericone::guidance {

struct ConstantVelocityOptions {
  /// Of the white acceleration, along each axis, m^2/s^3; 0: the velocity is constant.
  double intensity = 0;
  /// Largest normalised innovation squared that is taken: 30 refuses one right measurement of six numbers in
  /// 25,000.
  double gate = 30;
};

/// Position (m) and velocity (m/s) in fixed axes, both measured. No allocation, no throw. Cost: 0.5 us a
/// step.
class ConstantVelocityFilter {
 public:
  using State = Eigen::Matrix<double, 6, 1>;  // position, then velocity
  using Covariance = Eigen::Matrix<double, 6, 6>;

  explicit ConstantVelocityFilter(const ConstantVelocityOptions& options = {})
      : options_(options), gate_(options.gate) {}

  /// The first measurement is the first belief. Times, s, do not go back.
  Innovation<6> step(const State& measured, const Covariance& noise, double time);

  [[nodiscard]] bool started() const { return started_; }
  [[nodiscard]] Eigen::Vector3d position() const { return belief_.mean.head<3>(); }
  [[nodiscard]] Eigen::Vector3d velocity() const { return belief_.mean.tail<3>(); }
  [[nodiscard]] const Belief<6>& belief() const { return belief_; }

 private:
  ConstantVelocityOptions options_;
  Gate gate_;
  Belief<6> belief_;
  double time_ = 0;
  bool started_ = false;
};

}  // namespace vericone::guidance
