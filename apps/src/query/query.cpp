// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <filesystem>
#include <iostream>
#include <ostream>
#include <string>

#include "command/cases.h"
#include "commands.h"
#include "cone/answer.h"
#include "input/body.h"
#include "input/errors.h"
#include "json/json_value.h"
#include "work/threads.h"

namespace vericone {
namespace {

Json error_json(const RelativeError& error) {
  return {{"position", vector_json(error.position)}, {"velocity", vector_json(error.velocity)}};
}

/// What all errors, one or none lead to.
void add_robust(Json& result, const scenes::Scene& scene, const RelativeErrors& errors) {
  const RobustAnswer found =
      robust_verdict(scene.pair(), scene.agent.velocity, scene.obstacle.velocity, errors);
  result["robust"] = to_string(found.verdict);
  result["witness"] = nullptr;
  if (found.verdict == RobustVerdict::out && !found.normal.isZero(0))
    result["witness"] = {{"normal", vector_json(found.normal)}};
  if (found.verdict == RobustVerdict::depends)
    result["witness"] = {{"collides", error_json(found.collides)}, {"passes", error_json(found.passes)}};
}

Json answer_case(const Json& value, bool with_rung, const std::filesystem::path& folder) {
  const Horizon horizon = input::read_horizon(value);
  const auto errors = input::read_errors(value, horizon);
  const scenes::Scene scene = input::read_engagement(
      value, input::Velocities::required, {"id", "position_error", "velocity_error", "horizon"}, folder);
  if (errors && scene.planar)
    throw InputError("position_error, velocity_error", "given for bodies in the plane",
                     "left out, or the bodies in space");
  Json result = answer(scene, with_rung, horizon);
  if (errors) add_robust(result, scene, *errors);
  return result;
}

/// `vericone query`: one engagement a line in, one answer a line out, in the same order
/// (docs/reference/formats.md). Returns the exit status: 0, or 2 if any line was bad.
int run_query(const std::string& path, bool with_rung, int threads, std::ostream& out) {
  const std::filesystem::path folder = path == "-" ? "" : std::filesystem::path(path).parent_path();
  return answer_cases(
      path, [&](const Json& value) { return answer_case(value, with_rung, folder); }, out, threads);
}

}  // namespace

int query_command(CommandLine& line) {
  std::string cases;
  bool with_rung = false;
  line.option("cases", cases, "File of cases, or - for standard input").required();
  int threads = 0;
  line.flag("--rung", with_rung, "Add the rung of the ladder that decided: triage, interval or exact");
  line.option("--threads", threads, "Threads, 0: one per processor; the answers are the same");
  bool json = true;
  line.flag("--json", json, "Print JSON; this command prints nothing else");
  line.quiet();
  line.read();
  return run_query(cases, with_rung, threads_for(threads), std::cout);
}

}  // namespace vericone
