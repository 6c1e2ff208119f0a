// SPDX-License-Identifier: BSD-3-Clause
#include "pilots/observer.h"
#include <vericone/internal/simulation/shape_in_time.h>
#include <vericone/internal/simulation/sight.h>

#include <algorithm>
#include <cmath>

namespace vericone::simulation {
namespace {

using Eigen::Vector3d;

/// Variances as a filter can use them: errors in proportion to a component vanish with it, and a matrix of
/// covariances must not. The least counts as a twentieth of the largest deviation.
Vector3d variances(const Vector3d& deviations) {
  const double least = std::max(0.05 * deviations.maxCoeff(), 1e-9);
  return deviations.cwiseMax(least).cwiseAbs2();
}

}  // namespace

void Observer::estimate(const Measurement& m, double t, Vector3d& position, Vector3d& velocity) {
  if (estimator_ == Estimator::state) {
    guidance::ConstantVelocityFilter::State measured;
    measured << m.position, m.velocity;
    guidance::ConstantVelocityFilter::Covariance noise = guidance::ConstantVelocityFilter::Covariance::Zero();
    noise.diagonal() << variances(m.position_deviation), variances(m.velocity_deviation);
    state_.step(measured, noise, t);
    position = state_.position();
    velocity = state_.velocity();
  } else if (estimator_ == Estimator::set_membership) {
    // Of noise that has no bound, three deviations: mostly, not always.
    const bool bounded = sensor_.noise == Noise::bounded;
    const Vector3d of_p = bounded ? Vector3d::Constant(sensor_.position) : Vector3d(3 * m.position_deviation),
                   of_v = bounded ? Vector3d::Constant(sensor_.velocity) : Vector3d(3 * m.velocity_deviation);
    possible_.step(m.position, m.velocity, of_p, of_v, t);
    position = possible_.position();
    velocity = possible_.velocity();
  }
}

const Observed& Observer::look(const guidance::BodyState& a, const guidance::BodyState& b, const Track& of_b,
                               double t, std::uint64_t step) {
  draw_.step = step;
  const Measurement m = measure(sensor_, a, b, draw_);
  Vector3d position = m.position, velocity = m.velocity;
  estimate(m, t, position, velocity);
  if (b.planar()) position.z() = velocity.z() = 0;
  guidance::BodyState believed = b;
  if (position != b.position) believed.shape = shape_at(of_b.shape(), t, position, of_b.motion(t).rotation);
  believed.position = position;
  believed.velocity = velocity;
  guidance::Sight sight = sight_of(sensor_, m, draw_);
  if (estimator_ == Estimator::state) {  // it knows better than one measurement how wrong it may be
    const auto& covariance = state_.belief().covariance;
    sight.position_deviation = std::sqrt(covariance.diagonal().head<3>().sum() / 3);
    sight.velocity_deviation = std::sqrt(covariance.diagonal().tail<3>().sum() / 3);
  }
  observed_ = Observed{m, std::move(believed), sight};
  return *observed_;
}

}  // namespace vericone::simulation
