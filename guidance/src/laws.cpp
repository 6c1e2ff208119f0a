// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/guidance/laws.h>

#include <algorithm>
#include <cmath>

namespace vericone::guidance {
namespace {

/// Below the least normal number the direction of V is not known.
bool at_rest(const PlanarState& s) {
  return !(std::hypot(s.v_r, s.v_theta) >= std::numeric_limits<double>::min());
}

double relative_speed(const PlanarState& s) { return std::hypot(s.v_r, s.v_theta); }

/// How much an acceleration of V by (radial, across) turns V, rad/s.
double turning(const PlanarState& s, double radial, double across) {
  const double speed = relative_speed(s);
  return (s.v_r / speed * across - s.v_theta / speed * radial) / speed;
}

double turning_by_lateral_a(const PlanarState& s) {
  return turning(s, std::sin(s.alpha - s.theta), -std::cos(s.alpha - s.theta));
}
double turning_by_lateral_b(const PlanarState& s) {
  return turning(s, -std::sin(s.beta - s.theta), std::cos(s.beta - s.theta));
}
double turning_by_longitudinal_a(const PlanarState& s) {
  return turning(s, -std::cos(s.alpha - s.theta), -std::sin(s.alpha - s.theta));
}
double turning_by_longitudinal_b(const PlanarState& s) {
  return turning(s, std::cos(s.beta - s.theta), std::sin(s.beta - s.theta));
}

/// y' = -K (y - w) as an equation for the inputs: by_inputs = needed.
double needed(const ConeRates& f, const LawOptions& options) {
  return -options.gain * (f.y - options.reference) - f.drift;
}

/// What one lateral acceleration can have as effect on y': turning V by 1 / |V|, turning A's body by these.
double largest_effect(const PlanarState& s, double psi_rate_by, double theta_b_rate_by, double sin_psi) {
  const double by_turning = at_rest(s) ? 0 : 1 / relative_speed(s);
  return by_turning + std::abs(theta_b_rate_by) + 0.5 * std::abs(sin_psi * psi_rate_by);
}
double largest_effect_a(const PlanarState& s, const PlaneCone& c) {
  return largest_effect(s, c.psi_rate_by_a, c.theta_b_rate_by_a, std::sin(c.psi));
}
double largest_effect_b(const PlanarState& s, const PlaneCone& c) {
  return largest_effect(s, c.psi_rate_by_b, c.theta_b_rate_by_b, std::sin(c.psi));
}

/// Why inputs are without effect.
LawStatus without_effect(const PlanarState& s, const ConeRates& f, const LawOptions& options) {
  const bool on_bisector = std::abs(f.v_theta_hat) <= options.effect * relative_speed(s);
  return on_bisector ? LawStatus::on_bisector : LawStatus::ineffective;
}

/// The most where it is finite, towards the chosen side.
double the_most(const LawOptions& options) {
  const double most = std::isfinite(options.most) ? options.most : 0;
  return options.side < 0 ? -most : most;
}

/// The factor that brings `size` down to the most.
double limiting_factor(double size, const LawOptions& options) {
  return size > options.most ? options.most / size : 1;
}

/// Avoidance with A's lateral acceleration a and B's ratio a: the common part of (6.17) and (6.19).
struct RatioCommand {
  double a = 0, demanded = 0;
  LawStatus status = LawStatus::clear;
};

RatioCommand avoid(const PlanarState& s, const ConeRates& f, const LawOptions& options, double ratio,
                   double effect, double largest) {
  RatioCommand command;
  const double greater = std::max(1.0, std::abs(ratio));  // of both accelerations in parts of a
  if (at_rest(s)) {
    command.status = LawStatus::no_relative_velocity;
  } else if (f.y >= options.cease) {
    command.status = LawStatus::clear;
  } else if (f.v_r_hat >= 0) {
    command.status = LawStatus::receding;
  } else if (std::abs(effect) <= options.effect * largest) {
    command.status = without_effect(s, f, options);
    command.a = command.demanded = the_most(options) / greater;
  } else {
    command.demanded = needed(f, options) / effect;
    const bool limited = std::abs(command.demanded) * greater > options.most;
    command.a = limited ? std::copysign(options.most / greater, command.demanded) : command.demanded;
    command.status = limited ? LawStatus::saturated : LawStatus::steering;
  }
  return command;
}

/// Parts of the most with which a pair leaves the bisector: there y has no gradient but V can still be
/// turned, with the shares that the pair of least magnitude has beside it. A alone where neither turns V.
struct Shares {
  double a = 1, b = 0;
};

Shares shares_on_bisector(const PlanarState& s, LawStatus status, const LawOptions& options) {
  const double a = turning_by_lateral_a(s), b = turning_by_lateral_b(s);
  const double greater = std::max(std::abs(a), std::abs(b));
  if (status != LawStatus::on_bisector || greater * relative_speed(s) <= options.effect) return {};
  const double divisor = a < 0 ? -greater : greater;
  return {a / divisor, b / divisor};
}

}  // namespace

const char* to_string(LawStatus status) {
  switch (status) {
    case LawStatus::steering:
      return "steering";
    case LawStatus::saturated:
      return "saturated";
    case LawStatus::clear:
      return "clear";
    case LawStatus::receding:
      return "receding";
    case LawStatus::on_bisector:
      return "on-bisector";
    case LawStatus::ineffective:
      return "ineffective";
    case LawStatus::no_relative_velocity:
      return "no-relative-velocity";
  }
  return "?";
}

ConeRates cone_rates(const PlanarState& s, const PlaneCone& cone) {
  ConeRates f;
  const double half = std::sin(cone.psi / 2);
  f.y = -half * half;
  if (at_rest(s)) return f;
  const double cosine = std::cos(s.theta - cone.theta_b), sine = std::sin(s.theta - cone.theta_b);
  f.v_r_hat = s.v_r * cosine - s.v_theta * sine;  // (5.9) as corrected: the printed matrix is transposed
  f.v_theta_hat = s.v_r * sine + s.v_theta * cosine;
  const double speed = relative_speed(s);
  // (5.10) is y = sin^2(lambda) - sin^2(psi / 2), lambda the angle from the bisector to V. Its only partial
  // derivatives are those by the direction of V less that of the bisector, and by psi.
  const double sine_lambda = f.v_theta_hat / speed, cosine_lambda = f.v_r_hat / speed;
  f.y = sine_lambda * sine_lambda - half * half;
  const double by_turning = 2 * sine_lambda * cosine_lambda, by_opening = -0.5 * std::sin(cone.psi);

  // (5.11). Along (5.8) without inputs V keeps its direction; on a moving plane it does not.
  const double moving_plane = turning(s, s.v_normal * s.v_normal / s.r, s.plane_spin * s.v_normal);
  f.drift = by_turning * (moving_plane - cone.theta_b_rate) + by_opening * cone.psi_rate;
  f.by_lateral_a =
      by_turning * (turning_by_lateral_a(s) - cone.theta_b_rate_by_a) + by_opening * cone.psi_rate_by_a;
  f.by_lateral_b =
      by_turning * (turning_by_lateral_b(s) - cone.theta_b_rate_by_b) + by_opening * cone.psi_rate_by_b;
  f.by_longitudinal_a = by_turning * turning_by_longitudinal_a(s);
  f.by_longitudinal_b = by_turning * turning_by_longitudinal_b(s);
  return f;
}

LawCommand avoidance(const PlanarState& state, const PlaneCone& cone, const LawOptions& options) {
  LawCommand command;
  command.rates = cone_rates(state, cone);
  const RatioCommand of_a =
      avoid(state, command.rates, options, 0, command.rates.by_lateral_a, largest_effect_a(state, cone));
  command.a = of_a.a;
  command.demanded = of_a.demanded;
  command.status = of_a.status;
  return command;
}

CooperativeCommand cooperative_avoidance(const PlanarState& state, const PlaneCone& cone,
                                         const LawOptions& options, double mu) {
  CooperativeCommand command;
  command.rates = cone_rates(state, cone);
  const double largest = largest_effect_a(state, cone) + std::abs(mu) * largest_effect_b(state, cone);
  const RatioCommand of_a = avoid(state, command.rates, options, mu,
                                  command.rates.by_lateral_a + mu * command.rates.by_lateral_b, largest);
  command.a = of_a.a;
  command.b = mu * of_a.a;
  command.demanded_a = of_a.demanded;
  command.demanded_b = mu * of_a.demanded;
  command.status = of_a.status;
  return command;
}

CooperativeCommand cooperative_rendezvous(const PlanarState& state, const PlaneCone& cone,
                                          const LawOptions& options) {
  CooperativeCommand command;
  command.rates = cone_rates(state, cone);
  const ConeRates& f = command.rates;
  if (at_rest(state) || f.v_r_hat >= 0) {
    command.status = at_rest(state) ? LawStatus::no_relative_velocity : LawStatus::receding;
    return command;
  }
  const double effect = std::hypot(f.by_lateral_a, f.by_lateral_b);
  const double largest = std::hypot(largest_effect_a(state, cone), largest_effect_b(state, cone));
  if (effect <= options.effect * largest) {
    command.status = without_effect(state, f, options);
    const Shares shares = shares_on_bisector(state, command.status, options);
    command.a = command.demanded_a = the_most(options) * shares.a;
    command.b = command.demanded_b = the_most(options) * shares.b;
    return command;
  }
  const double size = needed(f, options) / effect;
  command.demanded_a = size * (f.by_lateral_a / effect);
  command.demanded_b = size * (f.by_lateral_b / effect);
  const double factor =
      limiting_factor(std::max(std::abs(command.demanded_a), std::abs(command.demanded_b)), options);
  command.a = factor * command.demanded_a;
  command.b = factor * command.demanded_b;
  command.status = factor < 1 ? LawStatus::saturated : LawStatus::steering;
  return command;
}

MatchingCommand matching_rendezvous(const PlanarState& state, const PlaneCone& cone,
                                    const LawOptions& options, double gain_speed) {
  MatchingCommand command;
  command.rates = cone_rates(state, cone);
  const ConeRates& f = command.rates;
  if (at_rest(state)) {
    command.status = LawStatus::no_relative_velocity;
    return command;
  }
  const double speed = relative_speed(state), x = state.v_r / speed, z = state.v_theta / speed;
  command.speed_squared = speed * speed;
  // (5.17) divided by 2 |V|: the rate of |V|, x V_r' + z V_theta', is to be -K_2 |V| / 2.
  const double sine = std::sin(state.alpha - state.theta), cosine = std::cos(state.alpha - state.theta);
  const double by_lateral = x * sine - z * cosine, by_longitudinal = -(x * cosine + z * sine);
  const double of_plane = state.v_normal * (x * state.v_normal / state.r + z * state.plane_spin);
  const double needed_speed = -0.5 * gain_speed * speed - of_plane;
  const double determinant = f.by_lateral_a * by_longitudinal - f.by_longitudinal_a * by_lateral;
  bool both = false;
  if (f.v_r_hat >= 0) {
    command.status = LawStatus::receding;
  } else if (std::abs(determinant) <= options.effect * largest_effect_a(state, cone)) {
    command.status = without_effect(state, f, options);
  } else {
    command.status = LawStatus::steering;
    both = true;
  }
  if (both) {
    const double needed_y = needed(f, options);
    command.demanded_lateral =
        (needed_y * by_longitudinal - f.by_longitudinal_a * needed_speed) / determinant;
    command.demanded_longitudinal = (f.by_lateral_a * needed_speed - needed_y * by_lateral) / determinant;
  } else {  // by_lateral^2 + by_longitudinal^2 = 1: an acceleration against V
    command.demanded_lateral = by_lateral * needed_speed;
    command.demanded_longitudinal = by_longitudinal * needed_speed;
  }
  const double factor =
      limiting_factor(std::hypot(command.demanded_lateral, command.demanded_longitudinal), options);
  command.lateral = factor * command.demanded_lateral;
  command.longitudinal = factor * command.demanded_longitudinal;
  if (both && factor < 1) command.status = LawStatus::saturated;
  return command;
}

}  // namespace vericone::guidance
