// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/certificate.h>
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

/// What proves the verdict, or beside errors what all of them lead to; or why there is nothing that does.
void add_certificate(Json& result, const Json& value, const scenes::Scene& scene, const Horizon& horizon,
                     const std::optional<RelativeErrors>& errors) {
  const auto id = value.find("id");
  const bool named = id != value.end() && (id->is_string() || id->is_number());
  const std::string name = named ? id->dump() : std::string();
  const Pair pair = scene.pair();
  const Eigen::Vector3d &v_a = scene.agent.velocity, &v_b = scene.obstacle.velocity;
  const Certificate proved =
      errors ? certificate(pair, v_a, v_b, *errors, name) : certificate(pair, v_a, v_b, horizon, name);
  result["certificate"] = proved.text.empty() ? Json(nullptr) : Json::parse(proved.text);
  if (proved.text.empty()) result["no_certificate"] = proved.reason;
}

struct Wanted {
  bool rung = false, certificate = false;
};

Json answer_case(const Json& value, const Wanted& wanted, const std::filesystem::path& folder) {
  const Horizon horizon = input::read_horizon(value);
  const auto errors = input::read_errors(value, horizon);
  const scenes::Scene scene = input::read_engagement(
      value, input::Velocities::required, {"id", "position_error", "velocity_error", "horizon"}, folder);
  if (errors && scene.planar)
    throw InputError("position_error, velocity_error", "given for bodies in the plane",
                     "left out, or the bodies in space");
  Json result = answer(scene, wanted.rung, horizon);
  if (errors) add_robust(result, scene, *errors);
  if (wanted.certificate) add_certificate(result, value, scene, horizon, errors);
  return result;
}

/// `vericone query`: one engagement a line in, one answer a line out, in the same order
/// (docs/reference/formats.md). Returns the exit status: 0, or 2 if any line was bad.
int run_query(const std::string& path, const Wanted& wanted, int threads, std::ostream& out) {
  const std::filesystem::path folder = path == "-" ? "" : std::filesystem::path(path).parent_path();
  return answer_cases(
      path, [&](const Json& value) { return answer_case(value, wanted, folder); }, out, threads);
}

}  // namespace

int query_command(CommandLine& line) {
  std::string cases;
  Wanted wanted;
  line.option("cases", cases, "File of cases, or - for standard input").required();
  int threads = 0;
  line.flag("--rung", wanted.rung, "Add the rung of the ladder that decided: triage, interval or exact");
  line.flag("--certificate", wanted.certificate,
            "Add what proves the verdict, for programs that check it (docs/reference/certificates.md)");
  line.option("--threads", threads, "Threads, 0: one per processor; the answers are the same");
  bool json = true;
  line.flag("--json", json, "Print JSON; this command prints nothing else");
  line.quiet();
  line.read();
  return run_query(cases, wanted, threads_for(threads), std::cout);
}

}  // namespace vericone
