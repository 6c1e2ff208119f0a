// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/certificate.h>
#include <vericone/geometry/error.h>
#include <filesystem>
#include <iostream>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "command/cases.h"
#include "command/output_line.h"
#include "commands.h"
#include "cone/answer.h"
#include "input/body.h"
#include "input/errors.h"
#include "input/motions.h"
#include "input/scene.h"
#include "json/json_value.h"
#include "solids/slab_body.h"
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
      errors ? pair.certificate(v_a, v_b, *errors, name) : pair.certificate(v_a, v_b, horizon, name);
  result["certificate"] = proved.text.empty() ? Json(nullptr) : Json::parse(proved.text);
  if (proved.text.empty()) result["no_certificate"] = proved.reason;
}

struct Wanted {
  bool rung = false, certificate = false;
};

/// Where cases and the scene of --scene differ.
struct Source {
  std::filesystem::path folder;
  input::Velocities velocities = input::Velocities::required;
  std::vector<std::string_view> also = {};
};

Json answer_of_motions(const Json& value, const scenes::Scene& scene, const input::MotionsGiven& given,
                       const Horizon& horizon, const Wanted& wanted) {
  for (const char* field : {"position_error", "velocity_error"})
    if (value.contains(field))
      throw InputError(field, input::quoted(value[field]), "left out beside spin, acceleration or braking");
  const input::Motions motions = input::read_motions(given, scene);
  Json result = motion_answer(scene, motions.agent, motions.obstacle, horizon, wanted.rung);
  if (wanted.certificate) {
    result["certificate"] = nullptr;
    result["no_certificate"] = "bodies that spin, accelerate or brake: certificates are of straight motion";
  }
  return result;
}

/// A slab is asked of straight motion alone.
void require_plain(const Json& value, bool motions, bool certificate) {
  const char* why = "left out beside a half-space or a slab";
  for (const char* field : {"position_error", "velocity_error"})
    if (value.contains(field)) throw InputError(field, input::quoted(value[field]), why);
  if (motions) throw InputError("agent", "spin, acceleration or braking", why);
  if (certificate) throw InputError("--certificate", "given", why);
}

Json answer_case(const Json& given, const Wanted& wanted, const Source& source) {
  Json value = given;
  const auto motions = input::take_motions(value);
  const auto slab = input::take_slab(value);
  const Horizon horizon = input::read_horizon(value);
  const auto errors = input::read_errors(value, horizon);
  std::vector<std::string_view> also{"id", "position_error", "velocity_error", "horizon"};
  also.insert(also.end(), source.also.begin(), source.also.end());
  const scenes::Scene scene = input::read_engagement(value, source.velocities, also, source.folder);
  if (slab) {
    require_plain(value, motions.has_value(), wanted.certificate);
    return slab_answer(scene, *slab, horizon, wanted.rung);
  }
  if (motions) return answer_of_motions(value, scene, *motions, horizon, wanted);
  if (errors && scene.in_plane)
    throw InputError("position_error, velocity_error", "given for bodies in the plane",
                     "left out, or the bodies in space");
  Json result = answer(scene, wanted.rung, horizon);
  if (errors) add_robust(result, scene, *errors);
  if (wanted.certificate) add_certificate(result, value, scene, horizon, errors);
  return result;
}

/// `vericone query`: one engagement a line in, one answer a line out, in the same order
/// (docs/reference/formats.md). Returns the exit status: 0, or 2 if any line was bad.
int run_query(const std::string& path, const Wanted& wanted, int threads, const std::optional<Part>& part,
              std::ostream& out) {
  const Source source{path == "-" ? "" : std::filesystem::path(path).parent_path()};
  return answer_cases(
      path, [&](const Json& value) { return answer_case(value, wanted, source); }, out, threads, part);
}

/// The same of one scene, YAML.
int run_query_of_scene(const std::string& path, const Wanted& wanted, std::ostream& out) {
  const Json fields = input::read_scene_fields(path);
  input::require_kind(fields, input::FileKind::scene, path);
  const Source source{std::filesystem::path(path).parent_path(), input::Velocities::optional,
                      input::scene_file_fields().names()};
  out << answer_case(fields, wanted, source).dump() << '\n';
  return 0;
}

}  // namespace

int query_command(CommandLine& line) {
  std::string cases;
  Wanted wanted;
  line.option("cases", cases, "File of cases, or - for standard input").required();
  int threads = 0;
  std::string part;
  bool scene = false;
  line.flag("--scene", scene, "The file is one scene, YAML; a horizon may stand in it");
  line.flag("--rung", wanted.rung, "Add the rung of the ladder that decided: triage, interval or exact");
  line.flag("--certificate", wanted.certificate,
            "Add what proves the verdict, for programs that check it (docs/reference/certificates.md)");
  line.option("--threads", threads, "Threads, 0: one per processor; the answers are the same");
  part_option(line, part, "lines alone; all answers, in order, are those of the file");
  bool json = true;
  line.flag("--json", json, "Print JSON; this command prints nothing else");
  line.quiet();
  line.read();
  if (scene && !part.empty()) throw InputError("--part", part, "left out with --scene");
  if (scene) return run_query_of_scene(cases, wanted, std::cout);
  return run_query(cases, wanted, threads_for(threads), part_of(part), std::cout);
}

}  // namespace vericone
