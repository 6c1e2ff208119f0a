// SPDX-License-Identifier: BSD-3-Clause
//
// Singer's model of a manoeuvring target, (3.9): each coordinate's acceleration is a first-order Markov
// process.
#pragma once

#include <vericone/guidance/estimation/kalman.h>
#include <Eigen/Core>
#include <limits>
#include <optional>

namespace vericone::guidance {

/// T of (3.9): position, velocity, acceleration after dt >= 0 seconds. alpha >= 0 in 1/s; 0 is constant
/// acceleration. Relative error of every entry below 1e-12 for every alpha dt. Cost: 30 ns.
[[nodiscard]] Eigen::Matrix3d singer_transition(double alpha, double dt);
/// 2 alpha sigma^2 Q of (3.9) for a variance of the acceleration sigma^2, m^2/s^4 (entries in m^2, m^2/s and
/// so on). Relative error of every entry below 1e-12 for every alpha dt: the closed form loses all digits
/// below 1e-3 (errata 3.3). Cost: 0.1 us.
[[nodiscard]] Eigen::Matrix3d singer_noise(double alpha, double variance, double dt);

struct SingerOptions {
  double alpha = 0.1;                                     // 1/s
  Eigen::Vector2d variance = Eigen::Vector2d(0.1, 0.05);  // sigma^2, m^2/s^4, along x and y
  double first_speed = 30;  // m/s: standard deviation of a velocity before anything is known of it
  double gate = std::numeric_limits<double>::infinity();  // most normalised innovation squared that is taken
};

/// Position, velocity and acceleration of a body in the plane, in fixed axes: (x, x', x'', y, y', y''). Its
/// position is measured. No allocation, no throw. Cost: 0.8 us a step.
class SingerFilter {
 public:
  using State = Eigen::Matrix<double, 6, 1>;
  using Covariance = Eigen::Matrix<double, 6, 6>;

  explicit SingerFilter(const SingerOptions& options = {}) : options_(options) {}

  void start(const State& state, const Covariance& covariance, double time);
  /// Predicts to `time`, which does not go back, and takes what was measured (m), if anything, with its
  /// covariance (m^2). A target that is hidden gives no measurement: nothing is taken, its nis is NaN. The
  /// first measurement starts the filter where start() has not.
  Innovation<2> step(const std::optional<Eigen::Vector2d>& measured, const Eigen::Matrix2d& noise,
                     double time);
  /// The source's way with a hidden target (3.4.1): its estimate of before counts as measured now, with a
  /// larger noise (10 m^2). The estimate falls behind a target that moves on, and the covariance does not
  /// know it.
  Innovation<2> step_as_source(const Eigen::Matrix2d& noise, double time);
  /// The belief at a later time, without taking it.
  [[nodiscard]] Belief<6> predicted(double time) const;

  [[nodiscard]] bool started() const { return started_; }
  [[nodiscard]] double time() const { return time_; }
  [[nodiscard]] const Belief<6>& belief() const { return belief_; }
  [[nodiscard]] Eigen::Vector2d position() const { return {belief_.mean[0], belief_.mean[3]}; }
  [[nodiscard]] Eigen::Vector2d velocity() const { return {belief_.mean[1], belief_.mean[4]}; }
  [[nodiscard]] Eigen::Vector2d acceleration() const { return {belief_.mean[2], belief_.mean[5]}; }
  [[nodiscard]] Eigen::Matrix2d position_covariance() const;
  /// Of (x, y, x', y'), as cone_confidence takes it: m and m/s.
  [[nodiscard]] Eigen::Matrix4d motion_covariance() const;

 private:
  Innovation<2> corrected(const Eigen::Vector2d& measured, const Eigen::Matrix2d& noise);

  SingerOptions options_;
  Belief<6> belief_;
  double time_ = 0;
  bool started_ = false;
};

}  // namespace vericone::guidance
