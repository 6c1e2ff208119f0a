// SPDX-License-Identifier: BSD-3-Clause
#include "scenarios/read_vehicle.h"

#include <vericone/vehicles/fish.h>
#include <vericone/vehicles/quadrotor.h>
#include <array>
#include <numbers>
#include <utility>
#include <vector>

#include "json/json_value.h"
#include "scenarios/scenario_fields.h"

namespace vericone::scenario {
namespace {

using input::quoted, input::read_number, input::require_field, input::require_known, input::require_object;
using vehicles::FishControl, vehicles::FishOptions, vehicles::FishParameters, vehicles::QuadrotorOptions;

constexpr double kDegree = std::numbers::pi / 180;

constexpr std::array<std::pair<const char*, double FishParameters::*>, 25> kParameters{{
    {"density", &FishParameters::density},         {"gravity", &FishParameters::gravity},
    {"pressure", &FishParameters::pressure},       {"mass", &FishParameters::mass},
    {"length", &FishParameters::length},           {"tail_chord", &FishParameters::tail_chord},
    {"tail_span", &FishParameters::tail_span},     {"hinge", &FishParameters::hinge},
    {"frequency", &FishParameters::frequency},     {"blend", &FishParameters::blend},
    {"drag_x", &FishParameters::drag_x},           {"area_x", &FishParameters::area_x},
    {"drag_y", &FishParameters::drag_y},           {"area_y", &FishParameters::area_y},
    {"added_x", &FishParameters::added_x},         {"added_y", &FishParameters::added_y},
    {"inertia", &FishParameters::inertia},         {"added_inertia", &FishParameters::added_inertia},
    {"drag_turn", &FishParameters::drag_turn},     {"drag_plate", &FishParameters::drag_plate},
    {"drag_z", &FishParameters::drag_z},           {"chamber", &FishParameters::chamber},
    {"neutral_gas", &FishParameters::neutral_gas}, {"gas_rate", &FishParameters::gas_rate},
    {"valve_rate", &FishParameters::valve_rate},
}};

void number(const Json& value, const std::string& path, const char* field, double& to, double unit = 1) {
  if_given(value, path, field,
           [&](const Json& v, const std::string& p) { to = unit * read_number(v, p, ""); });
}

void read_limits(const Json& value, const std::string& path, FishOptions& options) {
  require_object(value, path);
  require_known(value, path, {"speed", "turn_rate_deg", "climb"});
  const auto positive = [&](const char* field, const char* unit, double scale, std::optional<double>& to) {
    if_given(value, path, field,
             [&](const Json& v, const std::string& p) { to = scale * read_positive(v, p, unit); });
  };
  positive("speed", " (m/s)", 1, options.most_speed);
  positive("turn_rate_deg", " (degrees/s)", kDegree, options.most_turn_rate);
  positive("climb", " (m/s)", 1, options.most_climb);
}

void read_trial(const Json& value, const std::string& path, FishOptions& options) {
  require_object(value, path);
  require_known(value, path, {"amplitude_deg", "bias_deg", "gas_rate"});
  const auto angle = [&](const char* field, double most, double& to) {
    number(value, path, field, to, kDegree);
    if (!(std::abs(to) <= most * (1 + 1e-12)))
      throw InputError(
          join(path, field), quoted(value[field]),
          "between -" + to_text(most / kDegree) + " and " + to_text(most / kDegree) + " degrees");
  };
  angle("amplitude_deg", options.parameters.most_amplitude, options.trial.amplitude);
  angle("bias_deg", options.parameters.most_bias, options.trial.bias);
  number(value, path, "gas_rate", options.trial.gas_rate);
}

FishOptions read_fish(const Json& value, const std::string& path) {
  std::vector<std::string> known{"kind",
                                 "body",
                                 "depth",
                                 "gas",
                                 "control",
                                 "gain_y",
                                 "gain_alpha",
                                 "gain_heading",
                                 "gain_speed",
                                 "depth_pole",
                                 "most_amplitude_deg",
                                 "most_bias_deg",
                                 "limits",
                                 "trial",
                                 "solver_step"};
  for (const auto& [field, member] : kParameters) known.emplace_back(field);
  require_known(value, path, known);
  FishOptions options;
  FishParameters& fish = options.parameters;
  for (const auto& [field, member] : kParameters) number(value, path, field, fish.*member);
  if_given(value, path, "most_amplitude_deg", [&](const Json& v, const std::string& p) {
    fish.most_amplitude = kDegree * read_positive(v, p, " (degrees)");
  });
  if_given(value, path, "most_bias_deg", [&](const Json& v, const std::string& p) {
    fish.most_bias = kDegree * read_not_negative(v, p, " (degrees)");
  });
  const double sum = (fish.most_amplitude + fish.most_bias) / kDegree;
  if (!(sum <= 90)) {
    const char* field = value.contains("most_bias_deg") ? "most_bias_deg" : "most_amplitude_deg";
    throw InputError(
        join(path, field), quoted(value[field]),
        "at most 90 degrees with most_amplitude_deg and most_bias_deg together: no tail folds over");
  }
  number(value, path, "depth", options.depth);
  if_given(value, path, "gas",
           [&](const Json& v, const std::string& p) { options.gas = read_number(v, p, " (m^3)"); });
  if_given(value, path, "control", [&](const Json& v, const std::string& p) {
    options.control = read_choice<FishControl>(
        v, p, {{"ours", FishControl::ours}, {"source", FishControl::source}, {"none", FishControl::none}});
  });
  number(value, path, "gain_y", options.gain_y);
  number(value, path, "gain_alpha", options.gain_alpha);
  number(value, path, "gain_heading", options.gain_heading);
  number(value, path, "gain_speed", options.gain_speed);
  number(value, path, "depth_pole", options.depth_pole);
  number(value, path, "solver_step", options.step);
  if_given(value, path, "limits", [&](const Json& v, const std::string& p) { read_limits(v, p, options); });
  if_given(value, path, "trial", [&](const Json& v, const std::string& p) {
    if (options.control != FishControl::none)
      throw InputError(p, quoted(v), "left out, or with control: none");
    read_trial(v, p, options);
  });
  return options;
}

QuadrotorOptions read_quadrotor(const Json& value, const std::string& path) {
  require_known(value, path,
                {"kind", "mass", "inertia", "gravity", "gain_attitude", "gain_rate", "most_thrust",
                 "most_torque", "most_tilt_deg", "drag", "period", "solver_step"});
  QuadrotorOptions options;
  const auto positive = [&](const char* field, const char* unit, double& to, double scale = 1) {
    if_given(value, path, field,
             [&](const Json& v, const std::string& p) { to = scale * read_positive(v, p, unit); });
  };
  positive("mass", " (kg)", options.mass);
  if_given(value, path, "inertia", [&](const Json& v, const std::string& p) {
    options.inertia = input::read_vector<3>(v, p, " (kg m^2)");
  });
  positive("gravity", " (m/s^2)", options.gravity);
  positive("gain_attitude", " (N m/rad)", options.gain_attitude);
  positive("gain_rate", " (N m s/rad)", options.gain_rate);
  options.most_thrust = 2 * options.mass * options.gravity;
  positive("most_thrust", " (N)", options.most_thrust);
  positive("most_torque", " (N m)", options.most_torque);
  if_given(value, path, "most_tilt_deg", [&](const Json& v, const std::string& p) {
    constexpr double kMost = 80;
    const double tilt = read_positive(v, p, " (degrees)");
    if (!(tilt <= kMost)) throw InputError(p, quoted(v), "at most 80 degrees");
    options.most_tilt = kDegree * tilt;
  });
  if_given(value, path, "drag", [&](const Json& v, const std::string& p) {
    options.drag = input::read_vector<3>(v, p, " (N s/m)");
  });
  positive("period", " (s)", options.period);
  positive("solver_step", " (s)", options.step);
  return options;
}

VehicleRead read_fish_and_body(const Json& value, const std::string& path, bool shape_given) {
  const FishOptions options = read_fish(value, path);
  VehicleRead read;
  read.model = input::within(path, [&] { return vehicles::fish(options); });
  if (shape_given) {
    if (value.contains("body"))
      throw InputError(join(path, "body"), quoted(value["body"]), "left out beside a shape");
    return read;
  }
  bool sphere = false;
  if_given(value, path, "body", [&](const Json& v, const std::string& p) {
    sphere = read_choice<bool>(v, p, {{"ellipsoid", false}, {"sphere", true}});
  });
  const Eigen::Vector3d axes = sphere ? Eigen::Vector3d::Constant(vehicles::sphere_of(options.parameters))
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
  const QuadrotorOptions options = read_quadrotor(value, path);
  return {input::within(path, [&] { return vehicles::quadrotor(options); }), {}};
}

simulation::Current read_current(const Json& value, const std::string& path, std::uint64_t seed) {
  require_object(value, path);
  require_known(value, path, {"uniform", "shear", "gusts"});
  Eigen::Vector3d uniform = Eigen::Vector3d::Zero();
  simulation::Shear shear;
  simulation::Gusts gusts;
  gusts.seed = seed;
  if_given(value, path, "uniform",
           [&](const Json& v, const std::string& p) { uniform = input::read_vector<3>(v, p, " (m/s)"); });
  if_given(value, path, "shear", [&](const Json& v, const std::string& p) {
    require_object(v, p);
    require_known(v, p, {"rate", "level"});
    shear.rate =
        input::read_vector<2>(require_field(v, p, "rate", "[x, y] (1/s)"), join(p, "rate"), " (1/s)");
    number(v, p, "level", shear.level);
  });
  if_given(value, path, "gusts", [&](const Json& v, const std::string& p) {
    require_object(v, p);
    require_known(v, p, {"most", "shortest", "longest", "horizontal"});
    gusts.most =
        read_not_negative(require_field(v, p, "most", "how fast at most (m/s)"), join(p, "most"), " (m/s)");
    number(v, p, "shortest", gusts.shortest);
    number(v, p, "longest", gusts.longest);
    if_given(v, p, "horizontal",
             [&](const Json& h, const std::string& q) { gusts.horizontal = read_flag(h, q); });
  });
  return input::within(path, [&] { return simulation::Current(uniform, shear, gusts); });
}

}  // namespace vericone::scenario
