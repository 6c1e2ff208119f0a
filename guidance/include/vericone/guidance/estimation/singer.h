// SPDX-License-Identifier: BSD-3-Clause
//
// Singer's model of a manoeuvring target, (3.9): each coordinate's acceleration is a first-order Markov
// process.
#pragma once

#include <vericone/guidance/estimation/kalman.h>
#include <Eigen/Core>
#include <optional>

namespace vericone::guidance {

/// T of (3.9): position, velocity, acceleration after dt >= 0 seconds. alpha >= 0 in 1/s.
[[nodiscard]] Eigen::Matrix3d singer_transition(double alpha, double dt);
/// 2 alpha sigma^2 Q of (3.9) for a variance of the acceleration sigma^2, m^2/s^4. Relative error of every
/// entry below 1e-12 for every alpha dt.
[[nodiscard]] Eigen::Matrix3d singer_noise(double alpha, double variance, double dt);

struct SingerOptions {
  double alpha = 0.1;                                     // 1/s
  Eigen::Vector2d variance = Eigen::Vector2d(0.1, 0.05);  // sigma^2, m^2/s^4, along x and y
  double gate = 1e300;  // largest normalised innovation squared that is taken
};

/// Position, velocity and acceleration of a body in the plane, in fixed axes: (x, x', x'', y, y', y''). Its
/// position is measured. No allocation, no throw.
class SingerFilter {
 public:
  using State = Eigen::Matrix<double, 6, 1>;
  using Covariance = Eigen::Matrix<double, 6, 6>;

  explicit SingerFilter(const SingerOptions& options = {}) : options_(options) {}

  void start(const State& state, const Covariance& covariance, double time);
  /// Predicts to `time`, which does not go back, and takes what was measured (m), if anything, with its
  /// covariance (m^2).
  Innovation<2> step(const std::optional<Eigen::Vector2d>& measured, const Eigen::Matrix2d& noise,
                     double time);
  /// The belief at a later time, without taking it.
  [[nodiscard]] Belief<6> predicted(double time) const;

  [[nodiscard]] bool started() const { return started_; }
  [[nodiscard]] double time() const { return time_; }
  [[nodiscard]] const Belief<6>& belief() const { return belief_; }
  [[nodiscard]] Eigen::Vector2d position() const { return {belief_.mean[0], belief_.mean[3]}; }
  [[nodiscard]] Eigen::Vector2d velocity() const { return {belief_.mean[1], belief_.mean[4]}; }
  [[nodiscard]] Eigen::Vector2d acceleration() const { return {belief_.mean[2], belief_.mean[5]}; }
  [[nodiscard]] Eigen::Matrix2d position_covariance() const;

 private:
  SingerOptions options_;
  Belief<6> belief_;
  double time_ = 0;
  bool started_ = false;
};

}  // namespace vericone::guidance
