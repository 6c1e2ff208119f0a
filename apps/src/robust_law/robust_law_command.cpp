// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/guidance/robust_law.h>
#include <iostream>
#include <ostream>
#include <string>

#include "command/cases.h"
#include "commands.h"
#include "json/json_value.h"
#include "scenarios/robust_fields.h"

namespace vericone {
namespace {

using namespace guidance;
using input::quoted, input::required_number;

Json correction_of(const Json& value) {
  input::require_object(value, "case");
  input::require_known(value, "",
                       {"id", "z", "K", "nu", "a", "lambda", "b_min", "dt", "mu", "Q", "R", "u_min", "u_max",
                        "sign_b", "polytope", "bound"});
  RobustModel model;
  const double z = required_number(value, "", "z", "y - w, a number");
  model.gain = required_number(value, "", "K", "the gain of the inner loop, 1/s");
  input::read_a(value, "", model);
  input::read_b(value, "", model);
  model.dt = required_number(value, "", "dt", "the time between two commands, s");
  model.sign_b = required_number(value, "", "sign_b", "the sign of b, 1 or -1");
  const bool as_printed = value.contains("nu") && !value.contains("b_min");
  const RobustOptions options =
      input::read_robust_options(value, "", as_printed ? Polytope::printed : Polytope::containing);
  const double low = required_number(value, "", "u_min", "m/s^2"),
               high = required_number(value, "", "u_max", "m/s^2");
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

/// `vericone robust-law`: one instance of (7.20)-(7.24) a line in, its correction a line out
/// (docs/explanation/robust-law.md). Returns the exit status: 0, or 2 if any line was bad.
int run_robust_law(const std::string& path, std::ostream& out) {
  return answer_cases(path, correction_of, out);
}

}  // namespace

int robust_law_command(CommandLine& line) {
  std::string cases;
  line.option("cases", cases, "File of cases (docs/explanation/robust-law.md), or - for standard input")
      .required();
  bool json = true;
  line.flag("--json", json, "Print JSON; this command prints nothing else");
  line.quiet();
  line.read();
  return run_robust_law(cases, std::cout);
}

}  // namespace vericone
