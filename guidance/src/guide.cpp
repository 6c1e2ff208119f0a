// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/guidance/guide.h>
#include <vericone/internal/guidance/collision_course.h>
#include <vericone/internal/guidance/laws.h>
#include <vericone/internal/guidance/outer_loop.h>
#include <vericone/internal/guidance/plane_view.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "check_numbers.h"

namespace vericone::guidance {
namespace {

using Eigen::Vector3d;

RateMethod rate_method(GuideRates rates) {
  switch (rates) {
    case GuideRates::analytic:
      return RateMethod::analytic;
    case GuideRates::differenced:
      return RateMethod::differenced;
    case GuideRates::backward:
      break;
  }
  return RateMethod::none;
}

/// How far the line of sight has turned in the plane since the step before.
double turned_since(const PlaneView& view, const GuideMemory& memory) {
  if (!memory.past) return 0;
  const Vector3d &u = view.line_of_sight, &before = memory.past->line_of_sight;
  return std::atan2(before.cross(u).dot(view.normal()), before.dot(u));
}

/// The source's rates: what changed since the step before, the turning of the line of sight in the plane
/// included.
void difference_backward(PlaneView& view, const GuideMemory& memory, double time, double turned) {
  if (!memory.past || !(time > memory.past->time)) return;
  const GuideMemory::Past& past = *memory.past;
  const double dt = time - past.time;
  view.cone.psi_rate = (view.cone.psi - past.psi) / dt;
  view.cone.theta_b_rate = (view.cone.theta_b - past.theta_b + turned) / dt;
}

/// Along A's heading as projected on the plane.
Vector3d ahead(const PlaneView& view) {
  return std::cos(view.state.alpha) * view.line_of_sight + std::sin(view.state.alpha) * view.across;
}

/// The standard deviation of the miss distance: of the position when they pass, along any direction.
double miss_deviation(const BodyState& a, const BodyState& b, const Sight& sight) {
  const Vector3d c = b.position - a.position, v = b.velocity - a.velocity;
  const double time = v.isZero(0) ? 0 : std::max(-c.dot(v) / v.squaredNorm(), 0.0);
  return std::hypot(sight.position_deviation, time * sight.velocity_deviation);
}

GuideStep by_clearance(const BodyState& a, const BodyState& b, const GuideOptions& options,
                       const Sight& sight) {
  ClearanceOptions clearance = options.clearance;
  if (options.margin > 0) clearance.required += options.margin * miss_deviation(a, b, sight);
  if (options.errors > 0) {
    clearance.position_error = ErrorSet::ball(options.errors * sight.position_deviation);
    clearance.velocity_error = ErrorSet::ball(options.errors * sight.velocity_deviation);
  }
  const ClearanceCommand command = clearance_law(a, b, clearance);
  GuideStep step;
  step.a = command.acceleration;
  step.demanded = command.demanded;
  step.status = command.status;
  step.m = command.m;
  return step;
}

bool avoids(Law law) { return law == Law::avoidance || law == Law::cooperative_avoidance; }

/// What is said of bodies that will not meet.
GuideStep nothing_to_do(const BodyState& a, const BodyState& b) {
  const Vector3d v = b.velocity - a.velocity;
  GuideStep step;
  step.status = v.isZero(0)                           ? LawStatus::no_relative_velocity
                : v.dot(b.position - a.position) >= 0 ? LawStatus::receding
                                                      : LawStatus::clear;
  step.y = step.psi = step.theta_b = std::numeric_limits<double>::quiet_NaN();
  return step;
}

/// They will meet; how to turn, these bodies do not say.
GuideStep without_sector() {
  GuideStep step;
  step.status = LawStatus::no_sector;
  step.y = step.psi = step.theta_b = std::numeric_limits<double>::quiet_NaN();
  return step;
}

/// The errors that a sensor of the engagement makes at this state.
void add_errors(PlaneView& view, const EngagementParts& parts) {
  Measured errors;
  errors.v_r = parts.v_r * view.state.v_r;
  errors.v_theta = parts.v_theta * view.state.v_theta;
  errors.theta = parts.theta;
  errors.theta_b = parts.theta_b;
  errors.psi = parts.psi;
  const MeasuredState read = measured(view.state, view.cone, errors);
  view.state = read.state;
  view.state.r *= 1 + parts.r;
  view.cone = read.cone;
}

/// The inner loop of the y that is used, which may be a filtered one, and the outer loop.
LawCommand avoid(const PlaneView& view, const GuideOptions& options, const Measured& deviations, double y,
                 GuideReading& reading) {
  LawOptions inversion = options.inversion;
  // The law reads y from the state: K (w - y) stays what it is to be when w moves along, and so does the
  // test.
  const double by_state = cone_rates(view.state, view.cone).y;
  inversion.reference += by_state - y;
  inversion.cease += by_state - y;
  double wanted = options.inversion.reference;
  if (options.margin > 0) {
    const double keep = options.margin * deviation(noise_gradients(view.state, view.cone, 1).y, deviations);
    inversion.reference += keep;
    inversion.cease += keep;
    wanted += keep;
  }
  LawCommand command = avoidance(view.state, view.cone, inversion);
  reading = {view.state, view.cone, deviations, y, command.a, {}, false};
  command.rates.y = y;
  if (!options.robust || commands_nothing(command.status)) return command;
  reading.outer =
      outer_loop(*options.robust, y - wanted, command.a, options.inversion.most, options.inversion.gain,
                 command.rates.by_lateral_a, view.state, view.cone, deviations);
  reading.corrected = true;
  command.a += reading.outer.delta;
  return command;
}

std::optional<GuideStep> on_plane(const BodyState& a, const BodyState& b, const Vector3d& across,
                                  const GuideOptions& options, GuideMemory& memory, double time,
                                  const Sight& sight) {
  std::optional<PlaneView> view =
      plane_view(a, b, across, options.sector, rate_method(options.rates), 0, &memory.edges);
  if (!view) return std::nullopt;
  const bool turning = options.rates == GuideRates::backward || options.filter.rates;
  const double turned = turning ? turned_since(*view, memory) : 0;
  const bool uncertain = sight.measured || options.filter.any() || options.robust || options.margin > 0;
  if (sight.measured) add_errors(*view, sight.errors);
  if (options.rates == GuideRates::backward) difference_backward(*view, memory, time, turned);
  Measured deviations;
  double y = 0;
  if (uncertain) {
    y = cone_rates(view->state, view->cone).y;
    deviations = deviations_on_plane(sight, view->state, view->cone);
    if (options.rates == GuideRates::backward && memory.past && time > memory.past->time) {
      // Of the difference of two measurements.
      const double by_time = std::sqrt(2.0) / (time - memory.past->time);
      deviations.psi_rate = by_time * deviations.psi;
      deviations.theta_b_rate = by_time * deviations.theta_b;
    }
    if (options.filter.any()) {
      if (!memory.filters) memory.filters.emplace(options.filter);
      y = memory.filters->step(view->state, view->cone, turned, deviations, time);
    }
  }
  memory.across = view->across;
  memory.past = {time, view->cone.psi, view->cone.theta_b, view->line_of_sight};

  GuideStep step;
  step.across = view->across;
  step.psi = view->cone.psi;
  step.theta_b = view->cone.theta_b - view->state.theta;
  const auto read = [&step](const auto& command) {
    step.status = command.status;
    step.y = command.rates.y;
    step.v_r_hat = command.rates.v_r_hat;
  };
  switch (options.law) {
    case Law::avoidance: {
      const LawCommand command = uncertain ? avoid(*view, options, deviations, y, step.reading.emplace())
                                           : avoidance(view->state, view->cone, options.inversion);
      read(command);
      step.a = command.a * view->lateral_a();
      step.demanded = std::abs(command.demanded);
      break;
    }
    case Law::cooperative_avoidance:
    case Law::cooperative_rendezvous: {
      const CooperativeCommand command =
          options.law == Law::cooperative_avoidance
              ? cooperative_avoidance(view->state, view->cone, options.inversion, options.mu)
              : cooperative_rendezvous(view->state, view->cone, options.inversion);
      read(command);
      step.a = command.a * view->lateral_a();
      step.b = command.b * view->lateral_b();
      step.demanded = std::abs(command.demanded_a);
      break;
    }
    case Law::matching_rendezvous: {
      const MatchingCommand command =
          matching_rendezvous(view->state, view->cone, options.inversion, options.gain_speed);
      read(command);
      step.a = command.lateral * view->lateral_a() + command.longitudinal * ahead(*view);
      step.demanded = std::hypot(command.demanded_lateral, command.demanded_longitudinal);
      break;
    }
    case Law::clearance:
      break;
  }
  return step;
}

}  // namespace

void check(const GuideOptions& options) {
  check(options.inversion);
  if (!std::isfinite(options.mu)) throw InputError("mu", to_text(options.mu), "a finite number");
  require_positive(options.gain_speed, "gain_speed", " (1/s)");
  try {
    check(options.clearance);
  } catch (const InputError& e) {
    throw e.within("clearance");
  }
  if (options.plane.planes < 1 || options.plane.planes > 10000)
    throw InputError("plane.planes", std::to_string(options.plane.planes), "from 1 to 10000");
  require_finite(options.plane.wind, "plane.wind", " (m/s)");
}

const char* to_string(Law law) {
  switch (law) {
    case Law::avoidance:
      return "avoidance";
    case Law::cooperative_avoidance:
      return "cooperative-avoidance";
    case Law::cooperative_rendezvous:
      return "cooperative-rendezvous";
    case Law::matching_rendezvous:
      return "matching-rendezvous";
    case Law::clearance:
      return "clearance";
  }
  return "?";
}

std::optional<GuideStep> guide(const BodyState& a, const BodyState& b, const GuideOptions& options,
                               GuideMemory& memory, double time, const Sight& sight) {
  if (options.law == Law::clearance) return by_clearance(a, b, options, sight);
  const bool in_space = avoids(options.law) && !a.planar() && !options.filter.y && !(options.margin > 0);
  if (in_space) {
    const auto course = on_collision_course(a, b, options.sector, options.inversion.cease);
    if (!course) return std::nullopt;
    if (!*course) {
      memory.past.reset();
      return nothing_to_do(a, b);
    }
    if (!has_sectors(a, b, options.sector)) return without_sector();
  }
  const std::optional<Vector3d> across = choose_plane(
      a, b, options.sector, options.plane, memory.across ? &*memory.across : nullptr, &memory.edges);
  if (!across) return std::nullopt;
  std::optional<GuideStep> step = on_plane(a, b, *across, options, memory, time, sight);
  if (!step || !in_space || !commands_nothing(step->status) ||
      step->status == LawStatus::no_relative_velocity)
    return step;
  PlaneOptions of_motion;
  of_motion.choice = PlaneChoice::of_motion;
  memory.past.reset();  // of another plane
  if (const auto plane = choose_plane(a, b, options.sector, of_motion, nullptr, &memory.edges))
    step = on_plane(a, b, *plane, options, memory, time, sight);
  return step;
}

}  // namespace vericone::guidance
