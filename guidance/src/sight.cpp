// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/guidance/robust_law.h>
#include <vericone/internal/guidance/directions.h>
#include <vericone/internal/guidance/outer_loop.h>
#include <algorithm>
#include <cmath>

namespace vericone::guidance {

Measured deviations_on_plane(const Sight& sight, const PlanarState& state, const PlaneCone& cone) {
  const EngagementParts& d = sight.deviations;
  const double angle = sight.position_deviation / state.r;  // of a direction to a point at r
  Measured sigma;
  sigma.v_r = std::hypot(d.v_r * state.v_r, sight.velocity_deviation);
  sigma.v_theta = std::hypot(d.v_theta * state.v_theta, sight.velocity_deviation);
  sigma.theta = std::hypot(d.theta, angle);
  sigma.theta_b = std::hypot(d.theta_b, angle);
  // Of a ball sin(psi / 2) = R / r.
  const double half = std::min(0.5 * cone.psi, 1.5);
  sigma.psi = std::hypot(d.psi, 2 * std::tan(half) * angle);
  return sigma;
}

namespace {
ConstantRateOptions of_y(const PlaneFilterOptions& options) { return {options.intensity_y, 1, options.gate}; }
ConstantRateOptions of_angle(const PlaneFilterOptions& options) {
  return {options.intensity_angle, 1, options.gate};
}
/// A measurement without error still has rounding: a filter needs a variance above 0.
double variance(double deviation) { return std::max(deviation * deviation, 1e-18); }
}  // namespace

PlaneFilters::PlaneFilters(const PlaneFilterOptions& options)
    : options_(options), y_(of_y(options)), psi_(of_angle(options)), theta_b_(of_angle(options)) {}

double PlaneFilters::step(const PlanarState& state, PlaneCone& cone, double turned, Measured& deviations,
                          double time) {
  turned_ += turned;
  if (options_.rates) {
    const double theta_b = unwrapped(cone.theta_b + turned_, last_theta_b_);
    last_theta_b_ = theta_b;
    psi_.step(cone.psi, variance(deviations.psi), time);
    theta_b_.step(theta_b, variance(deviations.theta_b), time);
    deviations.psi_rate = std::sqrt(psi_.belief().covariance(1, 1));
    deviations.theta_b_rate = std::sqrt(theta_b_.belief().covariance(1, 1));
    cone.psi_rate = psi_.rate();
    cone.theta_b_rate = theta_b_.rate();
    cone.psi_rate_by_a = cone.theta_b_rate_by_a = cone.psi_rate_by_b = cone.theta_b_rate_by_b = 0;
  }
  const double y = cone_rates(state, cone).y;
  if (!options_.y) return y;
  // (7.7) at the measured state. Where y has no gradient, on the bisector, the errors' squares are all that
  // there is: as much again.
  const NoiseGradients gradients = noise_gradients(state, cone, 1);
  const double sigma = deviation(gradients.y, deviations),
               square = deviations.theta_b * deviations.theta_b + deviations.theta * deviations.theta;
  y_.step(y, variance(sigma + square), time);
  return y_.value();
}

RobustCorrection outer_loop(const OuterLoopOptions& outer, double z, double inner, double most, double gain,
                            double by_lateral_a, const PlanarState& state, const PlaneCone& cone,
                            const Measured& deviations) {
  RobustModel model = outer.model;
  model.gain = gain;
  model.sign_b = by_lateral_a < 0 ? -1 : 1;
  if (outer.from_noise) {
    const NoiseRange range = noise_range(state, cone, deviations);
    model.a_low = range.a_low;
    model.a_high = range.a_high;
    model.b_low = range.b_low;
    model.b_high = range.b_high;
  }
  return robust_correction(z, -most - inner, most - inner, model, outer.options);
}

}  // namespace vericone::guidance
