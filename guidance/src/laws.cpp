// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/guidance/laws.h>
#include <vericone/internal/guidance/laws.h>

#include <vericone/geometry/error.h>
#include <algorithm>
#include <cmath>

#include "check_numbers.h"

namespace vericone::guidance {
namespace {

/// The relative velocity's size and direction, and how accelerations turn it.
struct RelativeMotion {
  double speed, radial = 0, across = 0;  // V = speed (radial, across)
  double by_lateral_a = 0, by_longitudinal_a = 0, by_lateral_b = 0, by_longitudinal_b = 0;  // rad/s per m/s^2
  // Of A's accelerations on |V|.
  double faster_by_lateral_a = 0, faster_by_longitudinal_a = 0;

  explicit RelativeMotion(const PlanarState& s) : speed(std::hypot(s.v_r, s.v_theta)) {
    if (at_rest()) return;
    radial = s.v_r / speed;
    across = s.v_theta / speed;
    const double sine_a = std::sin(s.alpha - s.theta), cosine_a = std::cos(s.alpha - s.theta);
    const double sine_b = std::sin(s.beta - s.theta), cosine_b = std::cos(s.beta - s.theta);
    // V_r', V_theta' per acceleration: (5.8), (5.13), (5.15).
    by_lateral_a = turning(sine_a, -cosine_a);
    by_longitudinal_a = turning(-cosine_a, -sine_a);
    by_lateral_b = turning(-sine_b, cosine_b);
    by_longitudinal_b = turning(cosine_b, sine_b);
    faster_by_lateral_a = radial * sine_a - across * cosine_a;
    faster_by_longitudinal_a = -(radial * cosine_a + across * sine_a);
  }

  /// Below the least normal number the direction of V is not known.
  bool at_rest() const { return !(speed >= std::numeric_limits<double>::min()); }
  /// How much V turns where its components change at these rates, rad/s.
  double turning(double v_r_rate, double v_theta_rate) const {
    return (radial * v_theta_rate - across * v_r_rate) / speed;
  }
};

/// cone_rates() with the motion at hand.
ConeRates rates_of(const PlanarState& s, const RelativeMotion& v, const PlaneCone& cone) {
  ConeRates f;
  const double half = std::sin(cone.psi / 2);
  f.y = -half * half;
  if (v.at_rest()) return f;
  const double cosine = std::cos(s.theta - cone.theta_b), sine = std::sin(s.theta - cone.theta_b);
  // (5.9) as corrected: the printed matrix is transposed. (5.10) is y = sin^2(lambda) - sin^2(psi / 2),
  // lambda the angle from the bisector to V. Its only partial derivatives are those by the direction of V
  // less that of the bisector, and by psi.
  const double cosine_lambda = v.radial * cosine - v.across * sine,
               sine_lambda = v.radial * sine + v.across * cosine;
  f.v_r_hat = v.speed * cosine_lambda;
  f.v_theta_hat = v.speed * sine_lambda;
  f.y = sine_lambda * sine_lambda - half * half;
  const double by_turning = 2 * sine_lambda * cosine_lambda, by_opening = -0.5 * std::sin(cone.psi);

  // (5.11). Along (5.8) without inputs V keeps its direction; on a moving plane it does not.
  const double moving_plane = v.turning(s.v_normal * s.v_normal / s.r, s.plane_spin * s.v_normal);
  f.drift = by_turning * (moving_plane - cone.theta_b_rate) + by_opening * cone.psi_rate;
  f.by_lateral_a = by_turning * (v.by_lateral_a - cone.theta_b_rate_by_a) + by_opening * cone.psi_rate_by_a;
  f.by_lateral_b = by_turning * (v.by_lateral_b - cone.theta_b_rate_by_b) + by_opening * cone.psi_rate_by_b;
  f.by_longitudinal_a = by_turning * v.by_longitudinal_a;
  f.by_longitudinal_b = by_turning * v.by_longitudinal_b;
  return f;
}

/// y' = -K (y - w) as an equation for the inputs: by_inputs = needed.
double needed(const ConeRates& f, const LawOptions& options) {
  return -options.gain * (f.y - options.reference) - f.drift;
}

/// What one lateral acceleration can have as effect on y': turning V by 1 / |V|, turning its body by these.
double largest_effect(const RelativeMotion& v, double psi_rate_by, double theta_b_rate_by) {
  const double by_turning = v.at_rest() ? 0 : 1 / v.speed;
  return by_turning + std::abs(theta_b_rate_by) + 0.5 * std::abs(psi_rate_by);
}
double largest_effect_a(const RelativeMotion& v, const PlaneCone& c) {
  return largest_effect(v, c.psi_rate_by_a, c.theta_b_rate_by_a);
}
double largest_effect_b(const RelativeMotion& v, const PlaneCone& c) {
  return largest_effect(v, c.psi_rate_by_b, c.theta_b_rate_by_b);
}

/// Why inputs are without effect.
LawStatus without_effect(const RelativeMotion& v, const ConeRates& f, const LawOptions& options) {
  const bool on_bisector = std::abs(f.v_theta_hat) <= options.effect * v.speed;
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

RatioCommand avoid(const RelativeMotion& v, const ConeRates& f, const LawOptions& options, double ratio,
                   double effect, double largest) {
  RatioCommand command;
  const double greater = std::max(1.0, std::abs(ratio));  // of both accelerations in parts of a
  if (v.at_rest()) {
    command.status = LawStatus::no_relative_velocity;
  } else if (f.y >= options.cease) {
    command.status = LawStatus::clear;
  } else if (f.v_r_hat >= 0) {
    command.status = LawStatus::receding;
  } else if (std::abs(effect) <= options.effect * largest) {
    command.status = without_effect(v, f, options);
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

Shares shares_on_bisector(const RelativeMotion& v, LawStatus status, const LawOptions& options) {
  const double a = v.by_lateral_a, b = v.by_lateral_b;
  const double greater = std::max(std::abs(a), std::abs(b));
  if (status != LawStatus::on_bisector || greater * v.speed <= options.effect) return {};
  const double divisor = a < 0 ? -greater : greater;
  return {a / divisor, b / divisor};
}

}  // namespace

void check(const LawOptions& options) {
  require_positive(options.gain, "gain", " (1/s)");
  if (!(options.most > 0)) throw InputError("most", to_text(options.most), "positive (m/s^2)");
  if (!std::isfinite(options.reference))
    throw InputError("reference", to_text(options.reference), "a finite number");
  if (std::isnan(options.cease)) throw InputError("cease", "nan", "a number");
  if (options.side != 1 && options.side != -1) throw InputError("side", to_text(options.side), "1 or -1");
}

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
    case LawStatus::no_sector:
      return "no_sector";
  }
  return "?";
}

bool commands_nothing(LawStatus status) {
  return status == LawStatus::clear || status == LawStatus::receding ||
         status == LawStatus::no_relative_velocity;
}

ConeRates cone_rates(const PlanarState& state, const PlaneCone& cone) {
  return rates_of(state, RelativeMotion(state), cone);
}

LawCommand avoidance(const PlanarState& state, const PlaneCone& cone, const LawOptions& options) {
  LawCommand command;
  const RelativeMotion v(state);
  command.rates = rates_of(state, v, cone);
  const RatioCommand of_a =
      avoid(v, command.rates, options, 0, command.rates.by_lateral_a, largest_effect_a(v, cone));
  command.a = of_a.a;
  command.demanded = of_a.demanded;
  command.status = of_a.status;
  return command;
}

CooperativeCommand cooperative_avoidance(const PlanarState& state, const PlaneCone& cone,
                                         const LawOptions& options, double mu) {
  CooperativeCommand command;
  const RelativeMotion v(state);
  command.rates = rates_of(state, v, cone);
  const double largest = largest_effect_a(v, cone) + std::abs(mu) * largest_effect_b(v, cone);
  const RatioCommand of_a = avoid(v, command.rates, options, mu,
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
  const RelativeMotion v(state);
  command.rates = rates_of(state, v, cone);
  const ConeRates& f = command.rates;
  if (v.at_rest() || f.v_r_hat >= 0) {
    command.status = v.at_rest() ? LawStatus::no_relative_velocity : LawStatus::receding;
    return command;
  }
  const double effect = std::hypot(f.by_lateral_a, f.by_lateral_b);
  const double largest = std::hypot(largest_effect_a(v, cone), largest_effect_b(v, cone));
  if (effect <= options.effect * largest) {
    command.status = without_effect(v, f, options);
    const Shares shares = shares_on_bisector(v, command.status, options);
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
  const RelativeMotion v(state);
  command.rates = rates_of(state, v, cone);
  const ConeRates& f = command.rates;
  if (v.at_rest()) {
    command.status = LawStatus::no_relative_velocity;
    return command;
  }
  command.speed_squared = v.speed * v.speed;
  // (5.17) divided by 2 |V|: |V|' is to be -K_2 |V| / 2.
  const double by_lateral = v.faster_by_lateral_a, by_longitudinal = v.faster_by_longitudinal_a;
  const double of_plane =
      state.v_normal * (v.radial * state.v_normal / state.r + v.across * state.plane_spin);
  const double needed_speed = -0.5 * gain_speed * v.speed - of_plane;
  const double determinant = f.by_lateral_a * by_longitudinal - f.by_longitudinal_a * by_lateral;
  bool both = false;
  if (f.v_r_hat >= 0) {
    command.status = LawStatus::receding;
  } else if (std::abs(determinant) <= options.effect * largest_effect_a(v, cone)) {
    command.status = without_effect(v, f, options);
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
