// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/internal/vehicles/fish_water.h>
#include <vericone/vehicles/fish.h>

#include <vericone/geometry/error.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "cycle_means.h"
#include "depth_keeper.h"
#include "speed_bound.h"
#include "swim.h"
#include "tail_control.h"
#include "tail_drive.h"

namespace vericone::vehicles {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using simulation::Current;
using simulation::Curve;
using simulation::LimitBroken;
using simulation::Motion;
using simulation::VehicleCommand;
using simulation::VehicleLimits;

/// How fast it can rise or sink, where drag is as large as the most that the chamber lifts or lacks.
double terminal_speed(const FishParameters& fish) {
  return std::sqrt(fish.density * fish.gravity * std::max(fish.chamber - fish.neutral_gas, fish.neutral_gas) /
                   fish.drag_z);
}

/// |w''|, if |w| is at most `climb`: what valve or electrolyser do to the volume, what the depth does to it,
/// and drag. Compression is at most 1, and changes by at most rho g |w| / P of itself.
double most_jerk(const FishParameters& fish, double climb) {
  const double weight = fish.density * fish.gravity;
  const double lift = weight * std::max(fish.chamber - fish.neutral_gas, fish.neutral_gas);
  const double volume =
      std::max(fish.gas_rate, fish.valve_rate) + fish.chamber * weight * climb / fish.pressure;
  return (weight * volume + 2 * fish.drag_z * climb * (lift + fish.drag_z * climb * climb) / fish.mass) /
         fish.mass;
}

class Fish : public simulation::Vehicle {
 public:
  Fish(const FishOptions& options, const CycleMeans& means, const VehicleLimits& limits, const Motion& start,
       double t, const Current& water)
      : options_(options),
        means_(means),
        limits_(limits),
        around_{start.position.z() + options.depth, water},
        tail_(options.control == FishControl::none
                  ? TailDrive(options.parameters.frequency, options.parameters.blend, t,
                              options.trial.amplitude, options.trial.bias)
                  : TailDrive(options.parameters.frequency, options.parameters.blend, t)),
        keeper_(options.parameters, options.depth_pole, limits.climb),
        t_(t) {
    const Vector3d ahead = start.rotation.col(0);
    if (!(ahead.head<2>().norm() > 1e-6))
      throw InputError("rotation", "upright", "a heading: the fish stays level");
    state_.position = start.position;
    state_.heading = std::atan2(ahead.y(), ahead.x());
    const Vector3d v = start.velocity - water.velocity(start.position.z(), t);
    const double c = std::cos(state_.heading), s = std::sin(state_.heading);
    state_.u = c * v.x() + s * v.y();
    state_.v = -s * v.x() + c * v.y();
    state_.w = v.z();
    state_.gas =
        options.gas.value_or(options.parameters.neutral_gas) / compression(options.parameters, options.depth);
    started_with_ = state_.gas;
    kept_ = start.velocity;
    height_ = {start.position.z(), start.velocity.z(), 0};
    past_ = {state_.heading, 0, state_.u};
    heading_before_ = state_.heading;
    watch();
  }

  Motion motion() const override {
    return {state_.position, over_ground(state_, around_.water, t_),
            Eigen::AngleAxisd(state_.heading, Vector3d::UnitZ()).toRotationMatrix()};
  }

  void advance(const VehicleCommand& command, double from, double to, std::vector<Curve>& way) override {
    // Times that differ by rounding only are one.
    constexpr double kOne = 1e-9;
    follow(command, from, to);
    while (t_ < to) {
      checkpoint();
      while (tail_.cycle(cycle_) <= t_ + kOne) begin_cycle(command);
      double next = std::min({to, tail_.cycle(cycle_), t_ + options_.step});
      if (to - next < kOne) next = to;
      gas_rate_ = gas_rate(command);
      const double begin = t_;
      swim(options_.parameters, state_, tail_, gas_rate_, around_, begin, next, options_.step,
           [&](const FishState& now, const Curve& curve) {
             const double h = curve.to() - t_;
             t_ = curve.to();
             sum_heading_ += h * now.heading;
             sum_speed_ += h * now.u;
             way.push_back(curve);
             watch();
           });
    }
  }

  void log(std::vector<double>& values) const override {
    const FishParameters& fish = options_.parameters;
    const double depth = depth_of(state_, around_.surface);
    values = {state_.u,           state_.v,
              state_.r,           state_.w,
              state_.heading,     depth,
              tail_.amplitude(),  tail_.bias(),
              tail_.at(t_).angle, state_.gas - started_with_,
              gas_rate_,          gas_volume(fish, state_.gas, depth)};
  }

  std::optional<LimitBroken> broken() const override { return broken_; }

 private:
  /// Where ours is to swim: to the aim, or along the velocity that accelerations add up to.
  void follow(const VehicleCommand& command, double from, double to) {
    if (options_.control != FishControl::ours) return;
    constexpr double kReplan = 0.1;  // s
    if (command.aim) {
      kept_ = over_ground(state_, around_.water, t_);
      height_ = {state_.position.z(), kept_.z(), 0};
      if (t_ < planned_ + kReplan - 1e-9) return;
      planned_ = t_;
      keeper_.plan(state_, around_.surface, t_, water_climb(),
                   {command.aim->point.z(), command.aim->velocity.z(), 0}, command.aim->seconds);
      return;
    }
    const double dt = to - from;
    kept_ += dt * command.acceleration;
    const double flat = kept_.head<2>().norm();
    if (flat > means_.most_speed()) kept_.head<2>() *= means_.most_speed() / flat;
    kept_.z() = std::clamp(kept_.z(), -limits_.climb, limits_.climb);
    height_.w = kept_.z();
    if (t_ >= planned_ + kReplan - 1e-9) {
      planned_ = t_;
      keeper_.plan(state_, around_.surface, t_, water_climb(), height_, 0);
    }
    height_.z += dt * height_.w;
  }

  double water_climb() const { return around_.water.velocity(state_.position.z(), t_).z(); }

  double gas_rate(const VehicleCommand& command) const {
    const FishParameters& fish = options_.parameters;
    switch (options_.control) {
      case FishControl::none:
        return options_.trial.gas_rate;
      case FishControl::ours:
        return keeper_.rate(state_, around_.surface, t_, water_climb());
      case FishControl::source:
        break;
    }
    const double depth = depth_of(state_, around_.surface);
    const double wanted = gas_for(fish, depth, state_.w, command.acceleration.z());
    return std::clamp((wanted - state_.gas) / options_.step, -fish.gas_rate, fish.gas_rate);
  }

  /// Horizontal, through the water.
  Vector2d wanted_velocity(const VehicleCommand& command) const {
    const Vector3d water = around_.water.velocity(state_.position.z(), t_);
    if (!command.aim) return (kept_ - water).head<2>();
    constexpr double kSoonest = 1;  // s
    const double seconds = std::max(command.aim->seconds, kSoonest);
    const Vector3d there = command.aim->point + seconds * command.aim->velocity;
    return (there - state_.position).head<2>() / seconds - water.head<2>();
  }

  void begin_cycle(const VehicleCommand& command) {
    const double length = 1 / options_.parameters.frequency;
    if (cycle_ > 0) {
      const double rate = (state_.heading - heading_before_) / length;
      past_ = {sum_heading_ / length, rate, sum_speed_ / length};
      if (options_.most_turn_rate) exceed("turn_rate", std::abs(rate), *options_.most_turn_rate);
    }
    heading_before_ = state_.heading;
    sum_heading_ = sum_speed_ = 0;
    const double t = tail_.cycle(cycle_);
    TailSetting set{tail_.amplitude(), tail_.bias()};
    switch (options_.control) {
      case FishControl::source:
        set = source_tail(options_, means_, state_, tail_, command, t, cycle_);
        break;
      case FishControl::ours:
        set = our_tail(options_, means_, past_, wanted_velocity(command));
        break;
      case FishControl::none:
        break;
    }
    if (options_.control != FishControl::none) {
      set = within_limits(t, set);
      tail_.set(t, set.amplitude, set.bias);
    }
    ++cycle_;
  }

  /// Less bias, if the next cycle would turn too fast, and less amplitude, if it would be too fast. What it
  /// will do is integrated.
  TailSetting within_limits(double t, TailSetting set) const {
    constexpr double kMargin = 0.99, kLess = 0.85, kNext = 1.2;
    constexpr int kTrials = 30;
    const double cycle = 1 / options_.parameters.frequency;
    const auto foreseen = [&](double seconds) {
      TailDrive next = tail_;
      next.set(t, set.amplitude, set.bias);
      FishState state = state_;
      double speed = 0;
      foresee(options_.parameters, state, next, t, t + seconds, cycle / 50, [&](const FishState& at, double) {
        speed = std::max(speed, Vector3d(at.u, at.v, state_.w).norm());
      });
      return std::pair{speed, std::abs(state.heading - state_.heading) / seconds};
    };
    if (options_.most_turn_rate) {
      const auto too_fast = [&] { return foreseen(cycle).second > kMargin * *options_.most_turn_rate; };
      for (int i = 0; i < kTrials && too_fast(); ++i) set.bias *= kLess;
    }
    if (options_.most_speed) {
      const auto too_fast = [&] { return foreseen(kNext * cycle).first > kMargin * *options_.most_speed; };
      for (int i = 0; i < kTrials && too_fast(); ++i) set.amplitude *= kLess;
    }
    return set;
  }

  void watch() {
    const Vector3d through(state_.u, state_.v, state_.w);
    if (options_.most_speed) exceed("speed", through.norm(), *options_.most_speed);
    if (options_.most_climb) exceed("climb", std::abs(state_.w), *options_.most_climb);
    exceed("top", state_.position.z(), limits_.top);
  }

  void exceed(const char* limit, double value, double allowed) {
    if (value > allowed && !broken_) broken_ = LimitBroken{t_, limit, value, allowed};
  }

  const FishOptions& options_;
  const CycleMeans& means_;
  VehicleLimits limits_;
  Surroundings around_;
  FishState state_;
  TailDrive tail_;
  DepthKeeper keeper_;
  double t_, gas_rate_ = 0, started_with_ = 0;
  long cycle_ = 0;  // that begins next
  double heading_before_ = 0, sum_heading_ = 0, sum_speed_ = 0;
  CyclePast past_;
  Vector3d kept_ = Vector3d::Zero();  // m/s over ground, of the commands
  Height height_;
  double planned_ = -std::numeric_limits<double>::infinity();
  std::optional<LimitBroken> broken_;
};

class FishModel : public simulation::VehicleModel {
 public:
  explicit FishModel(const FishOptions& options) : options_(options), means_(options.parameters) {
    const FishParameters& fish = options.parameters;
    constexpr double kNone = std::numeric_limits<double>::infinity();
    limits_.turn_rate = options.most_turn_rate.value_or(kNone);
    limits_.climb = std::min(options.most_climb.value_or(kNone), terminal_speed(fish));
    limits_.bottom = -kNone;
  }

  std::unique_ptr<simulation::Vehicle> launch(const Motion& start, double t,
                                              const Current& water) const override {
    return std::make_unique<Fish>(options_, means_, limits(start), start, t, water);
  }

  std::vector<std::string> channels() const override {
    return {"u [m/s]",   "v [m/s]",    "r [rad/s]",     "w [m/s]",   "heading [rad]", "depth [m]",
            "A_m [rad]", "bias [rad]", "alpha_1 [rad]", "V_3 [m^3]", "dV_3 [m^3/s]",  "gas [m^3]"};
  }

  VehicleLimits limits(const Motion& start) const override {
    VehicleLimits limits = limits_;
    limits.climb = std::max(limits.climb, options_.most_climb ? 0 : std::abs(start.velocity.z()));
    limits.speed =
        options_.most_speed
            ? *options_.most_speed
            : std::hypot(most_swimming_speed(options_.parameters, start.velocity.norm()), limits.climb);
    limits.climb_jerk = most_jerk(options_.parameters, limits.climb);
    limits.top = start.position.z() + options_.depth;
    return limits;
  }

 private:
  FishOptions options_;
  CycleMeans means_;
  VehicleLimits limits_;
};

void check(const FishOptions& options) {
  const FishParameters& fish = options.parameters;
  vehicles::check(fish);
  const auto positive = [](double value, const char* field, const char* unit) {
    if (!(value > 0) || !std::isfinite(value))
      throw InputError(field, to_text(value), std::string("a positive finite number") + unit);
  };
  if (!(options.depth > 0) || !std::isfinite(options.depth))
    throw InputError("depth", to_text(options.depth), "positive (m): the fish swims below the surface");
  if (options.gas) {
    if (!(*options.gas >= 0)) throw InputError("gas", to_text(*options.gas), "0 or more (m^3)");
    if (!(*options.gas <= fish.chamber))
      throw InputError("gas", to_text(*options.gas),
                       "no more than the chamber holds, " + to_text(fish.chamber) + " m^3");
  }
  positive(options.gain_y, "gain_y", " (rad/m)");
  if (!(options.gain_alpha > 0 && options.gain_alpha <= 1))
    throw InputError("gain_alpha", to_text(options.gain_alpha), "above 0, at most 1");
  positive(options.gain_heading, "gain_heading", " (1/s)");
  if (!(options.gain_speed >= 0) || !std::isfinite(options.gain_speed))
    throw InputError("gain_speed", to_text(options.gain_speed), "a finite number, 0 or more");
  positive(options.depth_pole, "depth_pole", " (1/s)");
  positive(options.step, "step", " (s)");
  if (options.most_speed) positive(*options.most_speed, "limits.speed", " (m/s)");
  if (options.most_turn_rate) positive(*options.most_turn_rate, "limits.turn_rate", " (rad/s)");
  if (options.most_climb) positive(*options.most_climb, "limits.climb", " (m/s)");
  if (!(std::abs(options.trial.amplitude) <= fish.most_amplitude))
    throw InputError("trial.amplitude", to_text(options.trial.amplitude),
                     "at most most_amplitude, " + to_text(fish.most_amplitude) + " rad");
  if (!(std::abs(options.trial.bias) <= fish.most_bias))
    throw InputError("trial.bias", to_text(options.trial.bias),
                     "at most most_bias, " + to_text(fish.most_bias) + " rad");
  if (!(options.trial.gas_rate >= -fish.valve_rate && options.trial.gas_rate <= fish.gas_rate))
    throw InputError("trial.gas_rate", to_text(options.trial.gas_rate), "between -valve_rate and gas_rate");
}

}  // namespace

std::shared_ptr<const simulation::VehicleModel> fish(const FishOptions& options) {
  check(options);
  return std::make_shared<FishModel>(options);
}

}  // namespace vericone::vehicles
