// SPDX-License-Identifier: BSD-3-Clause
#include "pilots/observer.h"

#include <vericone/internal/simulation/shape_in_time.h>
#include <vericone/internal/simulation/sight.h>
#include <algorithm>
#include <cmath>
#include <utility>

#include "pilots/line_of_sight.h"

namespace vericone::simulation {
namespace {

using Eigen::Vector3d;

/// Variances as a filter can use them: errors in proportion to a component vanish with it, and a matrix of
/// covariances must not. The least counts as a twentieth of the largest deviation.
Vector3d variances(const Vector3d& deviations) {
  const double least = std::max(0.05 * deviations.maxCoeff(), 1e-9);
  return deviations.cwiseMax(least).cwiseAbs2();
}

/// Buildings, maps and the like that do not move are known not to.
bool stands(const guidance::BodyState& body) {
  return (body.shape.placed() || body.shape.hull()) && body.velocity.isZero(0) && body.omega.isZero(0);
}

/// Sums of steps fall short of periods and delays by roundings.
constexpr double kRounding = 1e-9;  // s

}  // namespace

void Observer::take(const Sent& sent) {
  const Measurement& m = sent.measurement;
  arrived_ = sent;
  position_ = m.position;
  velocity_ = m.velocity;
  if (estimator_ == Estimator::state) {
    guidance::ConstantVelocityFilter::State measured;
    measured << m.position, m.velocity;
    guidance::ConstantVelocityFilter::Covariance noise = guidance::ConstantVelocityFilter::Covariance::Zero();
    noise.diagonal() << variances(m.position_deviation), variances(m.velocity_deviation);
    state_.step(measured, noise, sent.t);
    position_ = state_.position();
    velocity_ = state_.velocity();
  } else if (estimator_ == Estimator::set_membership) {
    // Of noise that has no bound, three deviations: mostly, not always.
    const bool bounded = sensor_.noise == Noise::bounded;
    const Vector3d of_p = bounded ? Vector3d::Constant(sensor_.position) : Vector3d(3 * m.position_deviation),
                   of_v = bounded ? Vector3d::Constant(sensor_.velocity) : Vector3d(3 * m.velocity_deviation),
                   bias = Vector3d::Constant(sensor_.bias);
    possible_.step(m.position, m.velocity, of_p + bias, of_v, sent.t);
    position_ = possible_.position();
    velocity_ = possible_.velocity();
  }
}

/// What was made of it, moved on to now at its velocity.
void Observer::believe(const Instant& now, std::size_t body) {
  const guidance::BodyState& b = now.bodies[body];
  const Track& track = now.tracks[body];
  const double since = now.t - arrived_->t;
  Vector3d position = position_, velocity = velocity_;
  if (stands(b)) velocity.setZero();
  if (since > 0) position += since * velocity;
  if (b.planar()) position.z() = velocity.z() = 0;
  guidance::BodyState believed = b;
  if (position != b.position)
    believed.shape = shape_at(track.shape(), now.t, position, track.motion(now.t).rotation);
  believed.position = position;
  believed.velocity = velocity;
  guidance::Sight sight = arrived_->sight;
  if (estimator_ == Estimator::state) {  // it knows better than one measurement how wrong it may be
    const auto& covariance = state_.belief().covariance;
    const double of_p = covariance.diagonal().head<3>().sum() / 3,
                 of_v = covariance.diagonal().tail<3>().sum() / 3,
                 both = covariance.topRightCorner<3, 3>().trace() / 3;
    sight.position_deviation = std::sqrt(of_p + since * (2 * both + since * (of_v + since * intensity_ / 3)));
    sight.velocity_deviation = std::sqrt(of_v + since * intensity_);
  } else if (since > 0) {
    sight.position_deviation = std::hypot(sight.position_deviation, since * sight.velocity_deviation);
  }
  observed_ = Observed{arrived_->measurement, std::move(believed), sight};
}

void Observer::look(const Instant& now, std::size_t agent, std::size_t body) {
  if (!measured_at_ || now.t - *measured_at_ >= sensor_.period - kRounding) {
    measured_at_ = now.t;
    sees_ = !sees_in_part(sensor_) || in_sight(sensor_, now, agent, body);
    draw_.step = now.command;
    if (sees_ && arrives(sensor_, draw_)) {
      const Measurement m = measure(sensor_, now.bodies[agent], now.bodies[body], draw_);
      sent_.push_back({now.t, m, sight_of(sensor_, m, draw_)});
    }
  }
  for (; !sent_.empty() && now.t - sent_.front().t >= sensor_.delay - kRounding; sent_.pop_front())
    take(sent_.front());
  if (arrived_) believe(now, body);
}

}  // namespace vericone::simulation
