// SPDX-License-Identifier: BSD-3-Clause
#include "robust/robust_law_command.h"

#include <vericone/guidance/robust_law.h>

#include "command/cases.h"
#include "input/fields.h"
#include "json/json_value.h"

namespace vericone {
namespace {

using namespace guidance;
using input::quoted, input::read_number;

double number(const Json& value, const char* field, const char* requirement) {
  return read_number(input::require_field(value, "", field, requirement), field, "");
}

/// `nu` as printed, or the two ends of a.
void read_a(const Json& value, RobustModel& model) {
  if (value.contains("nu") == value.contains("a"))
    throw InputError("a", value.contains("a") ? "beside nu" : "nothing",
                     "given as nu (a between -nu and nu), or as a: [low, high]");
  if (value.contains("a")) {
    const Eigen::Vector2d ends = input::read_vector<2>(value["a"], "a", ", the lower one first");
    model.a_low = ends(0);
    model.a_high = ends(1);
    return;
  }
  const double nu = number(value, "nu", "");
  if (!(nu > 0)) throw InputError("nu", quoted(value["nu"]), "a positive number");
  model.a_low = -nu;
  model.a_high = nu;
}

template <typename Choice>
Choice choice(const Json& value, const char* field, Choice otherwise, const char* first, Choice one,
              const char* second, Choice two) {
  if (!value.contains(field)) return otherwise;
  if (value[field] == first) return one;
  if (value[field] == second) return two;
  throw InputError(field, quoted(value[field]), std::string("\"") + first + "\" or \"" + second + "\"");
}

Json correction_of(const Json& value) {
  input::require_object(value, "case");
  input::require_known(value, "",
                       {"id", "z", "K", "nu", "a", "lambda", "b_min", "dt", "mu", "Q", "R", "u_min", "u_max",
                        "sign_b", "polytope", "bound"});
  RobustModel model;
  RobustOptions options;
  const double z = number(value, "z", "y - w, a number");
  model.gain = number(value, "K", "the gain of the inner loop, 1/s");
  read_a(value, model);
  model.b_high = number(value, "lambda", "the most of |b|, 1/m");
  model.b_low = value.contains("b_min") ? number(value, "b_min", "") : 0;
  model.dt = number(value, "dt", "the time between two commands, s");
  model.sign_b = number(value, "sign_b", "the sign of b, 1 or -1");
  options.mu = number(value, "mu", "the bound of the influence of noise, s");
  options.state_weight = number(value, "Q", "the weight of z^2");
  options.input_weight = number(value, "R", "the weight of the correction squared");
  const bool as_printed = value.contains("nu") && !value.contains("b_min");
  options.polytope = choice(value, "polytope", as_printed ? Polytope::printed : Polytope::containing,
                            "printed", Polytope::printed, "containing", Polytope::containing);
  options.attenuation = choice(value, "bound", Attenuation::printed, "sqrt(mu)", Attenuation::printed, "mu",
                               Attenuation::stated);
  const double low = number(value, "u_min", "m/s^2"), high = number(value, "u_max", "m/s^2");
  if (!(low <= high)) throw InputError("u_max", quoted(value["u_max"]), "u_min or more (m/s^2)");
  check(model, options);
  const RobustCorrection found = robust_correction(z, low, high, model, options);
  const bool solved = found.status == RobustStatus::solved;
  const auto told = [&](double x) { return solved ? Json(x) : Json(nullptr); };
  return {{"status", solved ? "solved" : "infeasible"},
          {"limit", solved ? Json(nullptr) : Json(to_string(found.status))},
          {"gain", told(found.gain)},
          {"delta", told(found.delta)},
          {"gamma", told(found.gamma)},
          {"norm", told(found.norm)}};
}

}  // namespace

int run_robust_law(const std::string& path, std::ostream& out) {
  return answer_cases(path, correction_of, out);
}

}  // namespace vericone
