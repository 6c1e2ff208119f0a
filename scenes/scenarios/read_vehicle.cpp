// SPDX-License-Identifier: BSD-3-Clause
#include "scenarios/parts.h"

#include <vericone/vehicles/fish.h>
#include <vericone/vehicles/quadrotor.h>
#include <numbers>

#include "input/field_table.h"

namespace vericone::scenario {
namespace {

using input::absent, input::choice, input::Fields, input::join, input::not_negative, input::number,
    input::positive, input::quoted, input::require_field, input::require_object, input::required,
    input::vector;
using vehicles::FishControl, vehicles::FishOptions, vehicles::FishParameters, vehicles::FishTrial,
    vehicles::QuadrotorOptions;

constexpr double kDegree = std::numbers::pi / 180;

const Fields<FishOptions>& limit_fields() {
  static const Fields<FishOptions> fields =
      Fields<FishOptions>("limits")
          .row("speed", &FishOptions::most_speed, positive("m/s"), "Through the water, at every instant.",
               absent("a loose bound, proved"))
          .row("turn_rate_deg", &FishOptions::most_turn_rate, positive("degrees/s", kDegree),
               "Of the heading, mean over a cycle of the tail.", absent("none"))
          .row("climb", &FishOptions::most_climb, positive("m/s"),
               "Up or down through the water, at every instant.", absent("what its buoyancy allows"));
  return fields;
}

const Fields<FishTrial>& trial_fields() {
  static const Fields<FishTrial> fields =
      Fields<FishTrial>("trial")
          .row("amplitude_deg", &FishTrial::amplitude, number("degrees", kDegree), "A_m.")
          .row("bias_deg", &FishTrial::bias, number("degrees", kDegree), "Positive turns clockwise.")
          .row("gas_rate", &FishTrial::gas_rate, number("m³/s"), "Between -`valve_rate` and `gas_rate`.");
  return fields;
}

struct FishFields : FishOptions {
  bool sphere = false;
};

void read_trial(const Json& value, const std::string& path, FishFields& fish) {
  if (fish.control != FishControl::none)
    throw InputError(path, quoted(value), "left out, or with control: none");
  fish.trial = trial_fields().read(value, path);
}

/// What only all fields together show.
void check_angles(const Json& value, const std::string& path, const FishFields& fish) {
  const double most = fish.parameters.most_amplitude, bias = fish.parameters.most_bias;
  if (!((most + bias) / kDegree <= 90)) {
    const char* field = value.contains("most_bias_deg") ? "most_bias_deg" : "most_amplitude_deg";
    throw InputError(
        join(path, field), quoted(value[field]),
        "at most 90 degrees with most_amplitude_deg and most_bias_deg together: no tail folds over");
  }
  const auto angle = [&](const char* field, double limit, double given) {
    if (!(std::abs(given) <= limit * (1 + 1e-12)))
      throw InputError(
          join(join(path, "trial"), field), quoted(value["trial"][field]),
          "between -" + to_text(limit / kDegree) + " and " + to_text(limit / kDegree) + " degrees");
  };
  angle("amplitude_deg", most, fish.trial.amplitude);
  angle("bias_deg", bias, fish.trial.bias);
}

Fields<FishFields> make_fish_fields() {
  using F = FishFields;
  using P = FishParameters;
  const auto of = [](double P::*member) { return input::within_part(&FishOptions::parameters, member); };
  const auto declared = [](const Json& v, const std::string& p, F& fish) { limit_fields().read(v, p, fish); };
  return Fields<F>("vehicle")
      .kind("kind", "fish", "The robotic fish of the source's chapter 2 ([model](../explanation/fish.md)).")
      .row("body", &F::sphere, choice<bool>({{"ellipsoid", false}, {"sphere", true}}),
           "The shape of a body without one: about its centre of mass, and contains the trunk and the tail "
           "wherever it beats.")
      .row("depth", &F::depth, positive("m"), "Of the start: the surface of the water is so far above it.")
      .row("gas", &F::gas, not_negative("m³"), "In the chamber at the start.", absent("`neutral_gas`"))
      .row("control", &F::control,
           choice<FishControl>(
               {{"ours", FishControl::ours}, {"source", FishControl::source}, {"none", FishControl::none}}),
           "`ours`: loops of heading, speed and depth, to the aim of its law, else along the velocity that "
           "its "
           "accelerations add up to. `source`: (2.5)-(2.10). `none`: as `trial` says.")
      .row("gain_y", &F::gain_y, positive("rad/m"), "K_y of `source`: bias for an error in y.")
      .row("gain_alpha", &F::gain_alpha, positive(),
           "K_alpha1 of `source`, at most 1: the part of the bias that goes in every second cycle.")
      .row("gain_heading", &F::gain_heading, positive("1/s"),
           "Of `ours`: rate of turn for an error of the heading.")
      .row("gain_speed", &F::gain_speed, not_negative(), "Of `ours`: speed added for a speed missing.")
      .row("depth_pole", &F::depth_pole, positive("1/s"), "Of `ours`: three poles of the depth loop.")
      .special("limits", {{"$ref", "#/$defs/vehicle_limits"}}, declared,
               "Declared, kept by its control and watched all the time, below.",
               absent("what the equations allow"))
      .special("trial", {{"$ref", "#/$defs/fish_trial"}}, read_trial,
               "With `control: none`: what the tail and the gas do all the time, below.", absent("it drifts"))
      .row("solver_step", &F::step, positive("s"), "The longest of the solver.")
      .row("mass", of(&P::mass), positive("kg"), "As printed.")
      .row("length", of(&P::length), positive("m"), "Body and tail, as printed.")
      .row("chamber", of(&P::chamber), positive("m³"), "Of the gas, as printed.")
      .row("gas_rate", of(&P::gas_rate), positive("m³/s"),
           "Most gas made, at the pressure of the surface; as printed.")
      .row("valve_rate", of(&P::valve_rate), positive("m³/s"), "Most gas let out.")
      .row("neutral_gas", of(&P::neutral_gas), positive("m³"),
           "In the chamber, with which it neither sinks nor rises; less than `chamber`.")
      .row("drag_z", of(&P::drag_z), positive("kg/m"), "C_Dz of (2.5).")
      .row("frequency", of(&P::frequency), positive("Hz"), "Of the tail.")
      .row("most_amplitude_deg", of(&P::most_amplitude), positive("degrees", kDegree), "Of A_m.")
      .row("most_bias_deg", of(&P::most_bias), not_negative("degrees", kDegree),
           "Of the bias; with `most_amplitude_deg` at most 90.")
      .row("blend", of(&P::blend), positive("s"),
           "In which amplitude and bias go to new values; at most a cycle.")
      .row("tail_chord", of(&P::tail_chord), positive("m"), "C.")
      .row("tail_span", of(&P::tail_span), positive("m"), "L.")
      .row("hinge", of(&P::hinge), positive("m"), "Of the tail, behind the centre of mass.")
      .row("drag_x", of(&P::drag_x), positive(), "C_Dx.")
      .row("area_x", of(&P::area_x), positive("m²"), "A_x.")
      .row("drag_y", of(&P::drag_y), positive(), "C_Dy.")
      .row("area_y", of(&P::area_y), positive("m²"), "A_y.")
      .row("added_x", of(&P::added_x), not_negative("kg"), "Added mass ahead.")
      .row("added_y", of(&P::added_y), not_negative("kg"), "Added mass sideways.")
      .row("inertia", of(&P::inertia), positive("kg m²"), "J_z.")
      .row("added_inertia", of(&P::added_inertia), not_negative("kg m²"), "J_a.")
      .row("drag_turn", of(&P::drag_turn), positive("N m s²"), "K_r.")
      .row("drag_plate", of(&P::drag_plate), not_negative(), "C_n, of the tail across its plane.")
      .row("density", of(&P::density), positive("kg/m³"), "Of the water.")
      .row("gravity", of(&P::gravity), positive("m/s²"), "Weight of a kilogram.")
      .row("pressure", of(&P::pressure), positive("Pa"), "At the surface.");
}

const Fields<FishFields>& fish_fields() {
  static const Fields<FishFields> fields = make_fish_fields();
  return fields;
}

void read_tilt(const Json& value, const std::string& path, QuadrotorOptions& options) {
  options.most_tilt = positive("degrees", kDegree).read(value, path);
  if (!(options.most_tilt <= 80 * kDegree)) throw InputError(path, quoted(value), "at most 80 degrees");
}

Fields<QuadrotorOptions> make_quadrotor_fields() {
  using Q = QuadrotorOptions;
  return Fields<Q>("quadrotor")
      .kind("kind", "quadrotor",
            "The source's (4.25)-(4.29) with all twelve states ([model](../explanation/quadrotor.md)). Its "
            "body "
            "is the `shape`.")
      .row("mass", &Q::mass, positive("kg"), "Of all of it.")
      .row("inertia", &Q::inertia, vector<3>("kg m²"),
           "I_x, I_y, I_z: positive, none more than the two others together.")
      .row("gravity", &Q::gravity, positive("m/s²"), "Weight of a kilogram.")
      .row("gain_attitude", &Q::gain_attitude, positive("N m/rad"), "K_p of (4.29), of all three angles.")
      .row("gain_rate", &Q::gain_rate, positive("N m s/rad"), "K_d of (4.29).")
      .row("most_thrust", &Q::most_thrust, positive("N"),
           "More than the weight. What holding the height leaves of it goes aside.",
           absent("twice the weight"))
      .row("most_torque", &Q::most_torque, positive("N m"), "About each axis.")
      .special("most_tilt_deg", positive("degrees").schema, read_tilt,
               "Of the attitude asked for; at most 80.", absent("1.2 rad"))
      .row("drag", &Q::drag, vector<3>("N s/m"),
           "Along each of its own axes, 0 or more: force of the air for each m/s that it goes past. Without "
           "any "
           "no `current` moves it, and one that moves is refused.")
      .row("period", &Q::period, positive("s"),
           "For which thrust and torques are held. Below 2 I / K_d and 2 K_d / K_p, or the attitude would "
           "swing "
           "up.")
      .row("solver_step", &Q::step, positive("s"), "The longest of the solver.");
}

const Fields<QuadrotorOptions>& quadrotor_fields() {
  static const Fields<QuadrotorOptions> fields = make_quadrotor_fields();
  return fields;
}

VehicleRead read_fish_and_body(const Json& value, const std::string& path, bool shape_given) {
  const FishFields options = fish_fields().read(value, path);
  check_angles(value, path, options);
  VehicleRead read;
  read.model = input::within(path, [&] { return vehicles::fish(options); });
  if (shape_given) {
    if (value.contains("body"))
      throw InputError(join(path, "body"), quoted(value["body"]), "left out beside a shape");
    return read;
  }
  const Eigen::Vector3d axes = options.sphere
                                   ? Eigen::Vector3d::Constant(vehicles::sphere_of(options.parameters))
                                   : vehicles::ellipsoid_of(options.parameters);
  read.shape = simulation::RigidShape{CombinedEllipsoid(Ellipsoid::from_axes(Eigen::Vector3d::Zero(), axes))};
  return read;
}

}  // namespace

VehicleRead read_vehicle(const Json& value, const std::string& path, bool shape_given) {
  require_object(value, path);
  const Json& kind = require_field(value, path, "kind", "fish or quadrotor");
  if (kind == "fish") return read_fish_and_body(value, path, shape_given);
  if (kind != "quadrotor") throw InputError(join(path, "kind"), quoted(kind), "fish or quadrotor");
  QuadrotorOptions options = quadrotor_fields().read(value, path);
  if (!value.contains("most_thrust")) options.most_thrust = 2 * options.mass * options.gravity;
  return {input::within(path, [&] { return vehicles::quadrotor(options); }), {}};
}

namespace {

const Fields<simulation::Shear>& shear_fields() {
  using S = simulation::Shear;
  static const Fields<S> fields =
      Fields<S>("shear")
          .row("rate", &S::rate, vector<2>("1/s"), "[x, y] of the velocity, for each metre of height.",
               required("[x, y] (1/s)"))
          .row("level", &S::level, number("m"), "The z where it adds nothing.");
  return fields;
}

const Fields<simulation::Gusts>& gust_fields() {
  using G = simulation::Gusts;
  static const Fields<G> fields =
      Fields<G>("gusts")
          .row("most", &G::most, not_negative("m/s"), "Their speed never exceeds it.",
               required("how fast at most (m/s)"))
          .row("shortest", &G::shortest, positive("s"), "Shortest period.")
          .row("longest", &G::longest, positive("s"), "Longest period, not below `shortest`.")
          .row("horizontal", &G::horizontal, input::flag(), "Without a vertical part.");
  return fields;
}

struct CurrentFields {
  Eigen::Vector3d uniform = Eigen::Vector3d::Zero();
  simulation::Shear shear;
  simulation::Gusts gusts;
};

const Fields<CurrentFields>& current_fields() {
  using C = CurrentFields;
  static const Fields<C> fields =
      Fields<C>("current")
          .row("uniform", &C::uniform, vector<3>("m/s"), "The same everywhere.")
          .row("shear", &C::shear, input::mapping("shear", shear_fields()),
               "Horizontal, in proportion to the height, below.", absent("none"))
          .row("gusts", &C::gusts, input::mapping("gusts", gust_fields()),
               "Smooth in time, the same everywhere, drawn by `seed`, below.", absent("none"));
  return fields;
}

}  // namespace

simulation::Current read_current(const Json& value, const std::string& path, std::uint64_t seed) {
  CurrentFields current = current_fields().read(value, path);
  current.gusts.seed = seed;
  return input::within(path,
                       [&] { return simulation::Current(current.uniform, current.shear, current.gusts); });
}

Json vehicle_schemas() {
  return {{"vehicle", fish_fields().schema()},     {"vehicle_limits", limit_fields().schema()},
          {"fish_trial", trial_fields().schema()}, {"quadrotor", quadrotor_fields().schema()},
          {"current", current_fields().schema()},  {"shear", shear_fields().schema()},
          {"gusts", gust_fields().schema()}};
}

}  // namespace vericone::scenario
