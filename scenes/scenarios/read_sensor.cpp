// SPDX-License-Identifier: BSD-3-Clause
#include "scenarios/parts.h"

#include <algorithm>
#include <numbers>

#include "json/json_value.h"
#include "scenarios/robust_fields.h"
#include "scenarios/scenario_fields.h"

namespace vericone::scenario {
namespace {

using input::quoted, input::require_field, input::require_known, input::require_object;

constexpr double kDegree = std::numbers::pi / 180;

void if_positive_or_zero(const Json& value, const std::string& path, const char* field, const char* unit,
                         double& to, double scale = 1) {
  if_given(value, path, field,
           [&](const Json& v, const std::string& p) { to = scale * read_not_negative(v, p, unit); });
}

}  // namespace

simulation::Sensor read_sensor(const Json& value, const std::string& path) {
  using enum simulation::Noise;
  require_object(value, path);
  simulation::Sensor sensor;
  sensor.noise = read_choice<simulation::Noise>(
      require_field(value, path, "noise", "engagement, per-axis, isotropic or bounded"), join(path, "noise"),
      {{"engagement", engagement}, {"per-axis", per_axis}, {"isotropic", isotropic}, {"bounded", bounded}});
  if (sensor.noise == engagement) {
    require_known(
        value, path,
        {"noise", "r", "V_r", "V_theta", "theta_deg", "theta_b_deg", "psi_deg", "deviation", "shared"});
    guidance::EngagementParts& parts = sensor.engagement;
    if_positive_or_zero(value, path, "r", " (a part)", parts.r);
    if_positive_or_zero(value, path, "V_r", " (a part)", parts.v_r);
    if_positive_or_zero(value, path, "V_theta", " (a part)", parts.v_theta);
    if_positive_or_zero(value, path, "theta_deg", " (degrees)", parts.theta, kDegree);
    if_positive_or_zero(value, path, "theta_b_deg", " (degrees)", parts.theta_b, kDegree);
    if_positive_or_zero(value, path, "psi_deg", " (degrees)", parts.psi, kDegree);
  } else {
    const bool bound = sensor.noise == bounded, parts = sensor.noise == per_axis;
    if (bound)
      require_known(value, path, {"noise", "position", "velocity"});
    else
      require_known(value, path, {"noise", "position", "velocity", "deviation", "shared"});
    sensor.position = read_not_negative(require_field(value, path, "position", "how large its errors are"),
                                        join(path, "position"), parts ? " (a part)" : " (metres)");
    sensor.velocity = read_not_negative(require_field(value, path, "velocity", "how large its errors are"),
                                        join(path, "velocity"), parts ? " (a part)" : " (m/s)");
  }
  if_positive_or_zero(value, path, "deviation", "", sensor.deviation);
  take(value, path, "shared", sensor.shared, read_flag);
  return sensor;
}

void read_estimator(const Json& value, const std::string& path, simulation::Pilot& pilot) {
  using enum simulation::Estimator;
  require_object(value, path);
  pilot.estimator = read_choice<simulation::Estimator>(
      require_field(value, path, "kind", "state or set-membership"), join(path, "kind"),
      {{"state", state}, {"set-membership", set_membership}});
  if (pilot.estimator == state) {
    require_known(value, path, {"kind", "intensity"});
    if_positive_or_zero(value, path, "intensity", " (m^2/s^3)", pilot.estimator_intensity);
  } else {
    require_known(value, path, {"kind", "most"});
    if_positive_or_zero(value, path, "most", " (m/s^2)", pilot.obstacle_most);
  }
}

guidance::PlaneFilterOptions read_filter(const Json& value, const std::string& path) {
  require_object(value, path);
  require_known(value, path, {"of", "intensity_y", "intensity_angle", "gate"});
  guidance::PlaneFilterOptions filter;
  const Json& of = require_field(value, path, "of", "a list: y, rates, or both");
  const bool known = of.is_array() && !of.empty() && std::all_of(of.begin(), of.end(), [](const Json& name) {
                       return name == "y" || name == "rates";
                     });
  if (!known) throw InputError(join(path, "of"), quoted(of), "a list: y, rates, or both");
  for (const Json& name : of) (name == "y" ? filter.y : filter.rates) = true;
  if_positive_or_zero(value, path, "intensity_y", " (1/s^3)", filter.intensity_y);
  if_positive_or_zero(value, path, "intensity_angle", " (rad^2/s^3)", filter.intensity_angle);
  take(value, path, "gate", filter.gate, read_positive, "");
  return filter;
}

guidance::OuterLoopOptions read_outer_loop(const Json& value, const std::string& path) {
  require_object(value, path);
  require_known(value, path, {"bounds", "nu", "a", "lambda", "b_min", "mu", "Q", "R", "polytope", "bound"});
  guidance::OuterLoopOptions outer;
  outer.from_noise = input::read_either(value, path, "bounds", false, "given", false, "noise", true);
  if (outer.from_noise) {
    for (const char* field : {"nu", "a", "lambda", "b_min"})
      if (value.contains(field))
        throw InputError(join(path, field), quoted(value[field]), "left out with bounds: noise");
  } else {
    input::read_a(value, path, outer.model);
    input::read_b(value, path, outer.model);
  }
  const bool as_printed = value.contains("nu") && !value.contains("b_min");
  outer.options = input::read_robust_options(
      value, path, as_printed ? guidance::Polytope::printed : guidance::Polytope::containing);
  return outer;
}

}  // namespace vericone::scenario
