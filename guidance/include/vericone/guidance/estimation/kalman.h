// SPDX-License-Identifier: BSD-3-Clause
//
// The Kalman filter of linear models with Gaussian errors: prediction, and correction in Joseph's form with a
// gate. Models of motion stand beside it (constant_rate.h, constant_velocity.h); another one, such as
// Singer's, is a transition, its noise and what is measured.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <limits>

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

}  // namespace vericone::guidance
