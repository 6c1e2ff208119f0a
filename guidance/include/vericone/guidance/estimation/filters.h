// SPDX-License-Identifier: BSD-3-Clause
//
// The Kalman filter of linear models with Gaussian errors: prediction, and correction in Joseph's form with a
// gate. Models of motion stand beside it (below, and constant_rate.h); another one, such as
// Singer's, is a transition, its noise and what is measured.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
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

/// x <- F x, P <- F P F' + Q.
template <int N>
void predict(Belief<N>& belief, const Eigen::Matrix<double, N, N>& transition,
             const Eigen::Matrix<double, N, N>& noise) {
  const Eigen::Matrix<double, N, N> moved = transition * belief.covariance;
  belief.mean = (transition * belief.mean).eval();
  belief.covariance.noalias() = moved * transition.transpose();
  belief.covariance += noise;
}

/// z = H x + e, e with covariance R. Joseph's form, P <- (I - K H) P (I - K H)' + K R K', keeps P symmetric
/// and positive semidefinite to rounding, whatever K is. A measurement whose nis exceeds `gate` is not taken.
/// No allocation, no throw. Cost: 40 ns with two numbers, 0.5 us with six.
template <int N, int M>
Innovation<M> correct(Belief<N>& belief, const Eigen::Matrix<double, M, 1>& measured,
                      const Eigen::Matrix<double, M, N>& observation,
                      const Eigen::Matrix<double, M, M>& noise,
                      double gate = std::numeric_limits<double>::infinity()) {
  using Square = Eigen::Matrix<double, N, N>;
  Innovation<M> result;
  result.residual = measured - observation * belief.mean;
  const Eigen::Matrix<double, N, M> cross = belief.covariance * observation.transpose();
  const Eigen::Matrix<double, M, M> spread = observation * cross + noise;
  const Eigen::LLT<Eigen::Matrix<double, M, M>> factor(spread);
  if (factor.info() != Eigen::Success) {
    result.nis = std::numeric_limits<double>::quiet_NaN();
    return result;
  }
  const Eigen::Matrix<double, M, 1> white = factor.matrixL().solve(result.residual);
  result.nis = white.squaredNorm();
  if (!(result.nis <= gate)) return result;
  result.accepted = true;
  const Eigen::Matrix<double, N, M> gain = factor.solve(cross.transpose()).transpose();
  belief.mean += gain * result.residual;
  const Square left = Square::Identity() - gain * observation;
  const Square kept = left * belief.covariance * left.transpose();
  belief.covariance = kept + gain * noise * gain.transpose();
  belief.covariance = (0.5 * (belief.covariance + belief.covariance.transpose())).eval();
  return result;
}

/// (x - mean)' P^-1 (x - mean): normalised estimation error squared, chi-squared with N degrees of freedom of
/// a filter that is right about itself. NaN where P is not positive definite.
template <int N>
[[nodiscard]] double error_squared(const Belief<N>& belief, const Eigen::Matrix<double, N, 1>& truth) {
  const Eigen::LLT<Eigen::Matrix<double, N, N>> factor(belief.covariance);
  if (factor.info() != Eigen::Success) return std::numeric_limits<double>::quiet_NaN();
  return factor.matrixL().solve(truth - belief.mean).squaredNorm();
}

// Compiled in the library; of other sizes where they are used.
extern template void predict<2>(Belief<2>&, const Eigen::Matrix2d&, const Eigen::Matrix2d&);
extern template void predict<6>(Belief<6>&, const Eigen::Matrix<double, 6, 6>&,
                                const Eigen::Matrix<double, 6, 6>&);
extern template Innovation<1> correct<2, 1>(Belief<2>&, const Eigen::Matrix<double, 1, 1>&,
                                            const Eigen::Matrix<double, 1, 2>&,
                                            const Eigen::Matrix<double, 1, 1>&, double);
extern template Innovation<1> correct<6, 1>(Belief<6>&, const Eigen::Matrix<double, 1, 1>&,
                                            const Eigen::Matrix<double, 1, 6>&,
                                            const Eigen::Matrix<double, 1, 1>&, double);
extern template Innovation<2> correct<6, 2>(Belief<6>&, const Eigen::Vector2d&,
                                            const Eigen::Matrix<double, 2, 6>&, const Eigen::Matrix2d&,
                                            double);
extern template Innovation<6> correct<6, 6>(Belief<6>&, const Eigen::Matrix<double, 6, 1>&,
                                            const Eigen::Matrix<double, 6, 6>&,
                                            const Eigen::Matrix<double, 6, 6>&, double);
extern template double error_squared<2>(const Belief<2>&, const Eigen::Vector2d&);
extern template double error_squared<6>(const Belief<6>&, const Eigen::Matrix<double, 6, 1>&);

/// Counts what the gate refuses. A filter that refuses this many measurements one after another has lost what
/// it follows, and starts again from the last.
class Gate {
 public:
  explicit Gate(double most_nis, int patience = 5) : most_(most_nis), patience_(patience) {}
  [[nodiscard]] double most() const { return most_; }  // standard deviations, squared
  /// Whether to start again.
  bool lost(bool accepted) {
    refused_ = accepted ? 0 : refused_ + 1;
    if (refused_ < patience_) return false;
    refused_ = 0;
    return true;
  }

 private:
  double most_;
  int patience_, refused_ = 0;
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
