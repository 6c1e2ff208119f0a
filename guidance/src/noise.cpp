// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/guidance/robust_law.h>
#include <algorithm>
#include <cmath>

namespace vericone::guidance {
namespace {

/// The relative velocity by size and direction: V^2 = V_r^2 + V_theta^2, lambda from the bisector.
struct Polar {
  double speed, direction, lambda;

  Polar(const PlanarState& s, const PlaneCone& cone)
      : speed(std::hypot(s.v_r, s.v_theta)),
        direction(s.theta + std::atan2(s.v_theta, s.v_r)),
        lambda(direction - cone.theta_b) {}

  double y(double psi) const {
    const double across = std::sin(lambda), half = std::sin(0.5 * psi);
    return across * across - half * half;
  }
  /// 1 / G = D_1 D_2 / V^4 = 2 sin(2 lambda) cos(alpha - direction) / V, so b = -1 / (2 G).
  double effect(double alpha) const { return 2 * std::sin(2 * lambda) * std::cos(alpha - direction) / speed; }
  /// What y changes by without a command, with its sign turned: T without its last term, (7.12).
  double drift(const PlaneCone& cone) const {
    return cone.theta_b_rate * std::sin(2 * lambda) + 0.5 * cone.psi_rate * std::sin(cone.psi);
  }
};

Measured of_direction(const PlanarState& s, double speed) {
  Measured d;
  d.theta = 1;
  d.v_r = -s.v_theta / (speed * speed);
  d.v_theta = s.v_r / (speed * speed);
  return d;
}

template <typename Combine>
Measured each(const Measured& x, const Measured& y, Combine combine) {
  return {combine(x.v_r, y.v_r),
          combine(x.v_theta, y.v_theta),
          combine(x.theta, y.theta),
          combine(x.theta_b, y.theta_b),
          combine(x.psi, y.psi),
          combine(x.psi_rate, y.psi_rate),
          combine(x.theta_b_rate, y.theta_b_rate)};
}

double sum(const Measured& x) {
  return x.v_r + x.v_theta + x.theta + x.theta_b + x.psi + x.psi_rate + x.theta_b_rate;
}

Measured scaled(const Measured& x, double by) {
  return each(x, x, [by](double value, double) { return by * value; });
}
Measured plus(const Measured& x, const Measured& y) {
  return each(x, y, [](double p, double q) { return p + q; });
}

}  // namespace

MeasuredState measured(const PlanarState& state, const PlaneCone& cone, const Measured& errors) {
  MeasuredState seen{state, cone};
  seen.state.v_r += errors.v_r;
  seen.state.v_theta += errors.v_theta;
  seen.state.theta += errors.theta;
  seen.cone.theta_b += errors.theta_b;
  seen.cone.psi += errors.psi;
  seen.cone.psi_rate += errors.psi_rate;
  seen.cone.theta_b_rate += errors.theta_b_rate;
  return seen;
}

NoiseTerms noise_terms(const PlanarState& state, const PlaneCone& cone, const Measured& errors, double gain) {
  const MeasuredState seen = measured(state, cone, errors);
  const Polar truth(state, cone), wrong(seen.state, seen.cone);
  NoiseTerms terms;
  terms.delta_y = wrong.y(seen.cone.psi) - truth.y(cone.psi);
  terms.a = truth.effect(state.alpha) / wrong.effect(state.alpha);
  terms.v = terms.a * (wrong.drift(seen.cone) - gain * terms.delta_y) - truth.drift(cone);
  return terms;
}

NoiseGradients noise_gradients(const PlanarState& s, const PlaneCone& cone, double gain) {
  const Polar p(s, cone);
  const Measured direction = of_direction(s, p.speed);
  Measured lambda = direction, speed, angle, rates;
  lambda.theta_b = -1;
  speed.v_r = s.v_r / p.speed;
  speed.v_theta = s.v_theta / p.speed;
  angle.psi = 1;
  const double sin2 = std::sin(2 * p.lambda), cos2 = std::cos(2 * p.lambda);
  NoiseGradients g;
  g.y = plus(scaled(lambda, sin2), scaled(angle, -0.5 * std::sin(cone.psi)));
  g.a = plus(plus(scaled(speed, 1 / p.speed), scaled(lambda, -2 * cos2 / sin2)),
             scaled(direction, -std::tan(s.alpha - p.direction)));
  rates.theta_b_rate = sin2;
  rates.psi_rate = 0.5 * std::sin(cone.psi);
  // (7.13) with -K dy within dT.
  g.v = plus(plus(scaled(lambda, 2 * cos2 * cone.theta_b_rate),
                  scaled(angle, 0.5 * cone.psi_rate * std::cos(cone.psi))),
             plus(rates, plus(scaled(g.y, -gain), scaled(g.a, p.drift(cone)))));
  return g;
}

double deviation(const Measured& gradient, const Measured& deviations) {
  const Measured parts = each(gradient, deviations, [](double g, double d) { return g * g * d * d; });
  return std::sqrt(sum(parts));
}

double common_deviation(const Measured& gradient, const Measured& deviations) {
  return std::abs(sum(each(gradient, deviations, [](double g, double d) { return g * d; })));
}

NoiseRange noise_range(const PlanarState& state, const PlaneCone& cone, const Measured& deviations) {
  const double spread = 3 * deviation(noise_gradients(state, cone, 0).a, deviations);
  NoiseRange range;
  range.a_low = 1 - spread;
  range.a_high = 1 + spread;
  range.b = -0.5 * Polar(state, cone).effect(state.alpha);
  // a is the true effect over the measured one, so the true |b| is the measured one times a.
  range.b_low = std::abs(range.b) * std::max(0.0, range.a_low);
  range.b_high = std::abs(range.b) * range.a_high;
  return range;
}

}  // namespace vericone::guidance
