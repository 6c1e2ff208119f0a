// SPDX-License-Identifier: BSD-3-Clause
#include "scenarios/parts.h"

#include <algorithm>
#include <numbers>
#include <string>
#include <vector>

#include "input/field_table.h"
#include "scenarios/robust_fields.h"

namespace vericone::scenario {
namespace {

using input::absent, input::choice, input::Fields, input::join, input::not_negative, input::number,
    input::positive, input::quoted, input::required, input::vector;

constexpr double kDegree = std::numbers::pi / 180;

const Fields<simulation::Sensor>& sensor_fields() {
  using S = simulation::Sensor;
  using P = guidance::EngagementParts;
  using enum simulation::Noise;
  const std::vector<std::string> of_state{"per-axis", "isotropic", "bounded"};
  const auto part = [](double P::*member) { return input::within_part(&S::engagement, member); };
  static const Fields<S> fields =
      Fields<S>("sensor", "noise")
          .row("noise", &S::noise,
               choice<simulation::Noise>({{"engagement", engagement},
                                          {"per-axis", per_axis},
                                          {"isotropic", isotropic},
                                          {"bounded", bounded}}),
               "`engagement`: (7.2), of the avoidance law alone. `per-axis`: (7.27), parts of each component "
               "of the "
               "true relative position and velocity, so it depends on the axes. `isotropic`: as large along "
               "every "
               "axis. `bounded`: uniform in balls.",
               required("engagement, per-axis, isotropic or bounded"))
          .row("position", &S::position, not_negative("a part, or m"),
               "Of all but `engagement`, required: a part (`per-axis`), metres along each axis "
               "(`isotropic`), or the "
               "radius of the ball (`bounded`).",
               input::alternative())
          .only_of(of_state, nullptr)
          .row("velocity", &S::velocity, not_negative("a part, or m/s"), "The same of the velocity.",
               input::alternative())
          .only_of(of_state, nullptr)
          .row("r", part(&P::r), not_negative(), "Of `engagement`, as the following: a part of r.")
          .only_of({"engagement"}, nullptr)
          .row("V_r", part(&P::v_r), not_negative(), "A part of V_r.")
          .only_of({"engagement"}, nullptr)
          .row("V_theta", part(&P::v_theta), not_negative(), "A part of V_theta.")
          .only_of({"engagement"}, nullptr)
          .row("theta_deg", part(&P::theta), not_negative("degrees", kDegree), "Of theta.")
          .only_of({"engagement"}, nullptr)
          .row("theta_b_deg", part(&P::theta_b), not_negative("degrees", kDegree), "Of theta_b.")
          .only_of({"engagement"}, nullptr)
          .row("psi_deg", part(&P::psi), not_negative("degrees", kDegree), "Of psi.")
          .only_of({"engagement"}, nullptr)
          .row("deviation", &S::deviation, not_negative(),
               "All of these are multiplied by a normal random number with this standard deviation; the "
               "source has "
               "1/3. Not of `bounded`.")
          .only_of({"engagement", "per-axis", "isotropic"}, nullptr)
          .row("shared", &S::shared, input::flag(),
               "True: one random number a measurement for all channels, the literal reading of m(t). False: "
               "each has "
               "its own. Not of `bounded`.")
          .only_of({"engagement", "per-axis", "isotropic"}, nullptr)
          .row("bias", &S::bias, not_negative("m"),
               "Of every position of one body, in a direction drawn once. This and the following not of "
               "`engagement`.")
          .only_of(of_state, nullptr)
          .row("period", &S::period, not_negative("s"),
               "From one measurement to the next, at commands; 0: at every command.")
          .only_of(of_state, nullptr)
          .row("delay", &S::delay, not_negative("s"), "So much later a measurement arrives.")
          .only_of(of_state, nullptr)
          .row("dropout", &S::dropout,
               input::checked(
                   not_negative(), "a number, 0 or more, below 1", +[](const double& x) { return x < 1; }),
               "The share of measurements that never arrive, below 1.")
          .only_of(of_state, nullptr)
          .row("range", &S::range, positive("m"),
               "From the agent's position to the nearest of a body that it sees. A guarded pilot that may "
               "change its speed comes to rest within it.",
               absent("no limit"))
          .only_of(of_state, nullptr)
          .row("view_deg", &S::view,
               input::checked(
                   positive("degrees", kDegree), "a positive number, at most 180 (degrees)",
                   +[](const double& angle) { return angle <= std::numbers::pi; }),
               "To each side of its velocity, at rest of its x axis; at most 180.", absent("all round"))
          .only_of(of_state, nullptr)
          .row("occluded", &S::occluded, input::flag(),
               "True: it does not see a body whose centre and sides are behind others.")
          .only_of(of_state, nullptr);
  return fields;
}

const Fields<simulation::Pilot>& estimator_fields() {
  using P = simulation::Pilot;
  using enum simulation::Estimator;
  static const Fields<P> fields =
      Fields<P>("estimator", "kind")
          .row(
              "kind", &P::estimator,
              choice<simulation::Estimator>({{"state", state}, {"set-membership", set_membership}}),
              "`state`: a Kalman filter for a constant velocity. `set-membership`: what bounded errors leave "
              "possible; the law is given the middle.",
              required("state or set-membership"))
          .row("intensity", &P::estimator_intensity, not_negative("m²/s³"),
               "Of `state`: the white acceleration of the bodies minded.")
          .only_of({"state"}, nullptr)
          .row("most", &P::obstacle_most, not_negative("m/s²"),
               "Of `set-membership`: the most that they accelerate along an axis.")
          .only_of({"set-membership"}, nullptr);
  return fields;
}

void read_of(const Json& value, const std::string& path, guidance::PlaneFilterOptions& filter) {
  const bool known = value.is_array() && !value.empty() &&
                     std::all_of(value.begin(), value.end(),
                                 [](const Json& name) { return name == "y" || name == "rates"; });
  if (!known) throw InputError(path, quoted(value), "a list: y, rates, or both");
  for (const Json& name : value) (name == "y" ? filter.y : filter.rates) = true;
}

const Fields<guidance::PlaneFilterOptions>& filter_fields() {
  using F = guidance::PlaneFilterOptions;
  const Json of{{"title", "list of `y`, `rates`"},
                {"type", "array"},
                {"items", {{"enum", {"y", "rates"}}}},
                {"minItems", 1}};
  static const Fields<F> fields =
      Fields<F>("filter")
          .special("of", of, read_of,
                   "`y`, the cone function; `rates`, psi' and theta_b'. Each is followed with a rate that is "
                   "nearly "
                   "constant.",
                   required("a list: y, rates, or both"))
          .row("intensity_y", &F::intensity_y, not_negative("1/s³"),
               "White noise that changes the rate of y.")
          .row("intensity_angle", &F::intensity_angle, not_negative("rad²/s³"),
               "White noise that changes the rates of psi and theta_b.")
          .row("gate", &F::gate, positive(),
               "A measurement whose normalised innovation squared is larger is not taken.");
  return fields;
}

/// Its numbers are read as those of the robust law's cases (robust_fields.h).
const Fields<guidance::OuterLoopOptions>& outer_loop_fields() {
  using O = guidance::OuterLoopOptions;
  const Json ends{{"title", "[low, high]"},
                  {"type", "array"},
                  {"items", {{"type", "number"}}},
                  {"minItems", 2},
                  {"maxItems", 2}};
  Json b_min = not_negative("1/m").schema;
  b_min["default"] = 0;
  static const Fields<O> fields =
      Fields<O>("outer loop")
          .row("bounds", &O::from_noise, choice<bool>({{"given", false}, {"noise", true}}),
               "`given`: by `nu` or `a`, `lambda`, `b_min`. `noise`: what three deviations of the moment's "
               "noise "
               "leave of a and b, (7.8).")
          .special("nu", positive().schema, {}, "a lies between -nu and nu.", absent("`a`"))
          .special("a", ends, {}, "a lies between these.", absent("`nu`"))
          .special("lambda", not_negative("1/m").schema, {}, "The most of the size of b.",
                   absent("required if given"))
          .special("b_min", b_min, {}, "Its least.")
          .special("mu", positive("s").schema, {}, "Bound of the influence of noise.",
                   required("the bound of the influence of noise, s"))
          .special("Q", positive().schema, {}, "Weight of z².", required("the weight of z^2"))
          .special("R", not_negative().schema, {}, "Weight of the correction squared.",
                   required("the weight of the correction squared"))
          .special("polytope", {{"enum", {"printed", "containing"}}}, {},
                   "At which corners the inequalities hold.",
                   absent("`printed` with `nu` and without `b_min`, else `containing`"))
          .special("bound", {{"enum", {"sqrt(mu)", "mu"}}, {"default", "sqrt(mu)"}}, {},
                   "What the norm of v to z is kept below: as (7.23) is printed, or as the text says.");
  return fields;
}

}  // namespace

simulation::Sensor read_sensor(const Json& value, const std::string& path) {
  const simulation::Sensor sensor = sensor_fields().read(value, path);
  if (sensor.noise != simulation::Noise::engagement)
    for (const char* field : {"position", "velocity"})
      input::require_field(value, path, field, "how large its errors are");
  return sensor;
}

void read_estimator(const Json& value, const std::string& path, simulation::Pilot& pilot) {
  estimator_fields().read(value, path, pilot);
}

guidance::PlaneFilterOptions read_filter(const Json& value, const std::string& path) {
  return filter_fields().read(value, path);
}

guidance::OuterLoopOptions read_outer_loop(const Json& value, const std::string& path) {
  guidance::OuterLoopOptions outer = outer_loop_fields().read(value, path);
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

Json sensor_schemas() {
  return {{"sensor", sensor_fields().schema()},
          {"estimator", estimator_fields().schema()},
          {"filter", filter_fields().schema()},
          {"robust", outer_loop_fields().schema()}};
}

}  // namespace vericone::scenario
