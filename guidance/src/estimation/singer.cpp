// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/guidance/estimation/filters.h>
#include <vericone/internal/guidance/estimation/kalman.h>
#include <algorithm>
#include <cmath>
#include <limits>

namespace vericone::guidance {
namespace {

/// Functions of x = alpha dt that stay near 1 as x goes to 0: (3.9) with its powers of dt divided out. The
/// printed brackets lose every digit for small x, so there they are sums of powers.
struct Brackets {
  double position_acceleration;  // (e^-x - 1 + x) / x^2
  double q11, q12, q13, q22;     // the brackets of errata 4.3, over x^5, x^4, x^3, x^3
};

Brackets series(double x) {
  Brackets b{};
  double power = 1;  // (-x)^k
  double factorial[6] = {1, 1, 2, 6, 24, 120};
  double two = 1;  // 2^k
  for (int k = 0; k < 26; ++k) {
    // The term of x^n, n = k + 5 and so on, has sign (-1)^n.
    const auto n = [&](int more) { return k + more; };
    const double two3 = 8 * two, two4 = 16 * two, two5 = 32 * two;
    b.position_acceleration += power / factorial[2];
    b.q13 -= power * (2 * n(3) - two3) / factorial[3];
    b.q22 -= power * (4 - two3) / factorial[3];
    b.q12 += power * (two4 - 2 - 2 * n(4)) / factorial[4];
    b.q11 -= power * (4 * n(5) - two5) / factorial[5];
    power *= -x;
    two *= 2;
    for (int i = 2; i < 6; ++i) factorial[i] *= n(i) + 1;
  }
  return b;
}

Brackets closed(double x) {
  const double e = std::exp(-x), x2 = x * x, x3 = x2 * x;
  Brackets b{};
  b.position_acceleration = (e - 1 + x) / x2;
  b.q11 = (1 - e * e + 2 * x + 2 * x3 / 3 - 2 * x2 - 4 * x * e) / (x3 * x2);
  b.q12 = (e * e + 1 - 2 * e + 2 * x * e - 2 * x + x2) / (x2 * x2);
  b.q13 = (1 - e * e - 2 * x * e) / x3;
  b.q22 = (4 * e - 3 - e * e + 2 * x) / x3;
  return b;
}

Brackets brackets(double x) { return x < 1 ? series(x) : closed(x); }

/// (1 - e^-x) / x.
double decay(double x) { return x > 0 ? -std::expm1(-x) / x : 1; }

}  // namespace

Eigen::Matrix3d singer_transition(double alpha, double dt) {
  const double x = alpha * dt;
  Eigen::Matrix3d t;
  t << 1, dt, dt * dt * brackets(x).position_acceleration, 0, 1, dt * decay(x), 0, 0, std::exp(-x);
  return t;
}

Eigen::Matrix3d singer_noise(double alpha, double variance, double dt) {
  const double x = alpha * dt, one = decay(x);
  const Brackets b = brackets(x);
  const double scale = variance * x, dt2 = dt * dt;
  Eigen::Matrix3d q;
  q(0, 0) = scale * b.q11 * dt2 * dt2;
  q(0, 1) = q(1, 0) = scale * b.q12 * dt2 * dt;
  q(0, 2) = q(2, 0) = scale * b.q13 * dt2;
  q(1, 1) = scale * b.q22 * dt2;
  q(1, 2) = q(2, 1) = scale * one * one * dt;
  q(2, 2) = scale * 2 * decay(2 * x);
  return q;
}

void SingerFilter::start(const State& state, const Covariance& covariance, double time) {
  belief_ = {state, covariance};
  time_ = time;
  started_ = true;
}

Belief<6> SingerFilter::predicted(double time) const {
  const double dt = std::max(time - time_, 0.0);
  const Eigen::Matrix3d t = singer_transition(options_.alpha, dt), q = singer_noise(options_.alpha, 1, dt);
  Covariance transition = Covariance::Zero(), noise = Covariance::Zero();
  transition.topLeftCorner<3, 3>() = transition.bottomRightCorner<3, 3>() = t;
  noise.topLeftCorner<3, 3>() = options_.variance.x() * q;
  noise.bottomRightCorner<3, 3>() = options_.variance.y() * q;
  Belief<6> later = belief_;
  predict(later, transition, noise);
  return later;
}

Innovation<2> SingerFilter::corrected(const Eigen::Vector2d& measured, const Eigen::Matrix2d& noise) {
  Eigen::Matrix<double, 2, 6> observation = Eigen::Matrix<double, 2, 6>::Zero();
  observation(0, 0) = observation(1, 3) = 1;
  return correct<6, 2>(belief_, measured, observation, noise, options_.gate);
}

Innovation<2> SingerFilter::step(const std::optional<Eigen::Vector2d>& measured, const Eigen::Matrix2d& noise,
                                 double time) {
  Innovation<2> said;
  if (!started_) {
    said.nis = std::numeric_limits<double>::quiet_NaN();
    if (!measured) return said;
    State state = State::Zero();
    state[0] = measured->x();
    state[3] = measured->y();
    Covariance covariance = Covariance::Zero();
    covariance(0, 0) = noise(0, 0);
    covariance(3, 3) = noise(1, 1);
    covariance(0, 3) = covariance(3, 0) = noise(0, 1);
    covariance(1, 1) = covariance(4, 4) = options_.first_speed * options_.first_speed;
    covariance(2, 2) = options_.variance.x();
    covariance(5, 5) = options_.variance.y();
    start(state, covariance, time);
    said.accepted = true;
    return said;
  }
  belief_ = predicted(time);
  time_ = std::max(time, time_);
  if (measured) return corrected(*measured, noise);
  said.nis = std::numeric_limits<double>::quiet_NaN();
  return said;
}

Innovation<2> SingerFilter::step_as_source(const Eigen::Matrix2d& noise, double time) {
  return step(started_ ? std::optional(position()) : std::nullopt, noise, time);
}

Eigen::Matrix2d SingerFilter::position_covariance() const {
  return motion_covariance().topLeftCorner<2, 2>();
}

Eigen::Matrix4d SingerFilter::motion_covariance() const {
  constexpr int kOrder[] = {0, 3, 1, 4};
  Eigen::Matrix4d c;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) c(i, j) = belief_.covariance(kOrder[i], kOrder[j]);
  return c;
}

}  // namespace vericone::guidance
