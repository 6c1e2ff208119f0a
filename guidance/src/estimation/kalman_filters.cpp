// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/guidance/estimation/filters.h>
#include <vericone/internal/guidance/estimation/constant_rate.h>
#include <vericone/internal/guidance/estimation/kalman.h>
#include <algorithm>

namespace vericone::guidance {

void ConstantRateFilter::start(double measured, double variance) {
  belief_.mean << measured, 0;
  belief_.covariance << variance, 0, 0, options_.first_rate * options_.first_rate;
  started_ = true;
}

Innovation<1> ConstantRateFilter::step(double measured, double variance, double time) {
  if (!started_) {
    start(measured, variance);
    time_ = time;
    Innovation<1> first;
    first.accepted = true;
    return first;
  }
  const double dt = std::max(time - time_, 0.0), q = options_.intensity;
  time_ = time;
  Eigen::Matrix2d transition, noise;
  transition << 1, dt, 0, 1;
  noise << q * dt * dt * dt / 3, q * dt * dt / 2, q * dt * dt / 2, q * dt;
  predict(belief_, transition, noise);
  const Eigen::Matrix<double, 1, 1> value(measured), spread(variance);
  const Innovation<1> said =
      correct<2, 1>(belief_, value, Eigen::Matrix<double, 1, 2>(1, 0), spread, gate_.most());
  if (gate_.lost(said.accepted)) start(measured, variance);
  return said;
}

Innovation<6> ConstantVelocityFilter::step(const State& measured, const Covariance& noise, double time) {
  if (!started_) {
    belief_ = {measured, noise};
    started_ = true;
    time_ = time;
    Innovation<6> first;
    first.accepted = true;
    return first;
  }
  const double dt = std::max(time - time_, 0.0), q = options_.intensity;
  time_ = time;
  const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
  Covariance transition = Covariance::Identity(), drift = Covariance::Zero();
  transition.topRightCorner<3, 3>() = dt * identity;
  drift.topLeftCorner<3, 3>() = q * dt * dt * dt / 3 * identity;
  drift.topRightCorner<3, 3>() = drift.bottomLeftCorner<3, 3>() = q * dt * dt / 2 * identity;
  drift.bottomRightCorner<3, 3>() = q * dt * identity;
  predict(belief_, transition, drift);
  const Innovation<6> said = correct<6, 6>(belief_, measured, Covariance::Identity(), noise, gate_.most());
  if (gate_.lost(said.accepted)) belief_ = {measured, noise};
  return said;
}

template void predict<2>(Belief<2>&, const Eigen::Matrix2d&, const Eigen::Matrix2d&);
template void predict<6>(Belief<6>&, const Eigen::Matrix<double, 6, 6>&, const Eigen::Matrix<double, 6, 6>&);
template Innovation<1> correct<2, 1>(Belief<2>&, const Eigen::Matrix<double, 1, 1>&,
                                     const Eigen::Matrix<double, 1, 2>&, const Eigen::Matrix<double, 1, 1>&,
                                     double);
template Innovation<1> correct<6, 1>(Belief<6>&, const Eigen::Matrix<double, 1, 1>&,
                                     const Eigen::Matrix<double, 1, 6>&, const Eigen::Matrix<double, 1, 1>&,
                                     double);
template Innovation<2> correct<6, 2>(Belief<6>&, const Eigen::Vector2d&, const Eigen::Matrix<double, 2, 6>&,
                                     const Eigen::Matrix2d&, double);
template Innovation<6> correct<6, 6>(Belief<6>&, const Eigen::Matrix<double, 6, 1>&,
                                     const Eigen::Matrix<double, 6, 6>&, const Eigen::Matrix<double, 6, 6>&,
                                     double);
template double error_squared<2>(const Belief<2>&, const Eigen::Vector2d&);
template double error_squared<6>(const Belief<6>&, const Eigen::Matrix<double, 6, 1>&);

}  // namespace vericone::guidance
