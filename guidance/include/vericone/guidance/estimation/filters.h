// SPDX-License-Identifier: BSD-3-Clause
//
// The Kalman filter of linear models with Gaussian errors: prediction, and correction in Joseph's form with a
// gate. Models of motion stand beside it (below, and constant_rate.h); another one, such as
// Singer's, is a transition, its noise and what is measured.
#pragma once

#include <vericone/internal/geometry/requires.h>
#include <vericone/internal/guidance/estimation/gate.h>
#include <vericone/internal/guidance/estimation/possible_motion.h>
#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>

namespace vericone::guidance {

/// A state of N numbers as it is believed to be: mean and covariance.
template <int N>
struct Belief {
  Eigen::Matrix<double, N, 1> mean = Eigen::Matrix<double, N, 1>::Zero();
  Eigen::Matrix<double, N, N> covariance = Eigen::Matrix<double, N, N>::Zero();
};

/// What a measurement of M numbers, each in its unit, said.
template <int M>
struct Innovation {
  Eigen::Matrix<double, M, 1> residual = Eigen::Matrix<double, M, 1>::Zero();  // measured less expected
  /// Normalised innovation squared: chi-squared with M degrees of freedom where the model is right. NaN where
  /// the innovation has no covariance.
  double nis = 0;
  bool accepted = false;  // within the gate; otherwise the belief is as it was
};

// A body that keeps nearly its velocity: the filter of an obstacle's state.

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

// Singer's model of a manoeuvring target, (3.9): each coordinate's acceleration is a first-order Markov
// process.

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

// What bounded errors leave possible: along each axis a polygon of position and velocity that contains the
// true pair, proved. Nothing is assumed of the errors but their bounds.

/// Three axes. A polygon has at most 24 corners before it is replaced by one around it. Cost: some 4 us a
/// step.
class SetMembershipFilter {
 public:
  /// `most`: bound of the body's acceleration along each axis, m/s^2.
  explicit SetMembershipFilter(double most = 0) : most_(most) {}

  /// Errors of at most `position_error` (m) and `velocity_error` (m/s) along each axis. Times, s, do not go
  /// back. False where an error broke its bound: the belief then starts again from this measurement.
  bool step(const Eigen::Vector3d& position, const Eigen::Vector3d& velocity,
            const Eigen::Vector3d& position_error, const Eigen::Vector3d& velocity_error, double time);

  [[nodiscard]] bool started() const { return axes_.has_value(); }
  [[nodiscard]] const PossibleMotion& axis(int i) const {
    VERICONE_REQUIRES(started() && i >= 0 && i < 3, "i", "no such axis, or no measurement",
                      "0, 1 or 2, of a filter that has met a measurement");
    return (*axes_)[std::size_t(i)];
  }
  /// The middle of the bounds, and half their width rounded up.
  [[nodiscard]] Eigen::Vector3d position() const;
  [[nodiscard]] Eigen::Vector3d velocity() const;
  [[nodiscard]] Eigen::Vector3d position_radius() const;
  [[nodiscard]] Eigen::Vector3d velocity_radius() const;

 private:
  double most_;
  double time_ = 0;
  std::optional<std::array<PossibleMotion, 3>> axes_;
};

}  // namespace vericone::guidance
