// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/files/files.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/files/extensions.h>
#include <vericone/internal/scenes/words.h>
#include <vericone/scenarios/scenario_files.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <optional>
#include <ostream>
#include <string>

#include "commands.h"
#include "glb/scene_glb.h"
#include "input/fields.h"
#include "input/file_body.h"
#include "input/planar_body.h"
#include "input/scene.h"
#include "json/json_value.h"
#include "output/output_file.h"
#include "paper/paper.h"
#include "scenarios/read_scenario.h"
#include "simulate/run_text.h"
#include "solids/flat_body.h"
#include "units/geographic.h"

namespace vericone {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using scenes::body_words, scenes::motion_words, scenes::brief;

std::string guarantee_words(const Pair& pair) {
  const Guarantee guarantee = pair.guarantee();
  if (guarantee.exact) return "exact: every verdict is right";
  return "certified: a verdict is right or undecided, to " + brief(guarantee.tolerance) + " of a size";
}

std::string now_words(const Pair& pair) {
  const auto relation = pair.relation();
  if (!relation) return "touching, or too near to tell";
  if (*relation != Relation::disjoint) return to_string(*relation);
  const Miss miss = pair.miss(Vector3d::Zero(), Vector3d::Zero());
  if (miss.most - miss.least > 1e-4 * miss.most)
    return "between " + brief(miss.least) + " and " + brief(miss.most) + " m apart";
  return brief(miss.distance) + " m apart";
}

void add_notes(const std::optional<scenes::Reading>& reading, scenario::Facts& facts) {
  if (!reading) return;
  for (const std::string& note : scenes::reading_words(*reading)) facts.add("note", note);
}

void add_origin(const Json& fields, scenario::Facts& facts) {
  if (fields.contains("origin")) facts.add("origin", input::origin_words(fields["origin"]));
}

void check_scene(const Json& fields, const std::string& file, scenario::Facts& facts) {
  const scenes::Scene scene = input::scene_of(fields, file);
  const Pair pair = scene.pair();
  const Vector3d &v_a = scene.agent.velocity, &v_b = scene.obstacle.velocity;
  const bool planar = scene.planar.has_value(), flat = scene.in_plane && !planar;
  facts.add("scene", file);
  add_origin(fields, facts);
  const auto words = [&](const scenes::SceneBody& body, const CombinedEllipse* conic) {
    const std::string is = conic ? body_words(*conic) : flat ? body.name : body_words(body.placed);
    return is + "; " + motion_words(body.velocity, scene.in_plane);
  };
  facts.add("agent", words(scene.agent, planar ? &scene.planar->agent : nullptr));
  facts.add("obstacle", words(scene.obstacle, planar ? &scene.planar->obstacle : nullptr));
  add_notes(scene.agent.reading, facts);
  add_notes(scene.obstacle.reading, facts);
  facts.add("now", now_words(pair));
  facts.add("answers", guarantee_words(pair));
  if (fields.contains("lidars")) facts.add("lidars", std::to_string(fields["lidars"].size()));
  if (v_a == v_b) facts.add("note", "the velocities are equal: they never meet");
}

std::string goal_words(const simulation::Goal& goal) {
  const auto vector_words = [](const Eigen::Vector3d& x) {
    return "(" + brief(x.x()) + ", " + brief(x.y()) + ", " + brief(x.z()) + ")";
  };
  std::string text = "goal " + vector_words(goal.point) + " m";
  if (!goal.follows.empty()) text += " from " + goal.follows;
  if (goal.velocity.any()) text += "; moves at " + vector_words(goal.velocity) + " m/s";
  if (goal.stay > 0) text += "; stays " + brief(goal.stay) + " s";
  return text;
}

void check_scenario(const Json& fields, const std::string& file, scenario::Facts& facts) {
  scenario::Readings readings;
  const simulation::Scenario scenario = scenario::read_scenario(fields, fs::path(file).stem().string(),
                                                                fs::path(file).parent_path(), &readings);
  facts.add("scenario", file);
  add_origin(fields, facts);
  facts.add("time", brief(scenario.duration) + " s at most, commands every " + brief(scenario.step) + " s");
  for (std::size_t i = 0; i < scenario.bodies.size(); ++i) {
    const simulation::Body& body = scenario.bodies[i];
    std::string text = scenario::shape_words(body) + "; " +
                       motion_words(body.start.velocity, simulation::planar(body.shape));
    if (body.road) text += "; along a road";
    if (body.appears > 0) text += "; appears at " + brief(body.appears) + " s";
    facts.add(body.name, text);
    if (body.pilot) facts.add("", scenario::agent_text(scenario, body));
    if (body.pilot)
      for (const simulation::Goal& goal : body.pilot->goals) facts.add("", goal_words(goal));
    add_notes(readings[i], facts);
  }
  if (scenario.water.moves()) facts.add("current", scenario::current_text(scenario.water));
  const auto pilots =
      std::count_if(scenario.bodies.begin(), scenario.bodies.end(),
                    [](const simulation::Body& body) { return body.pilot || body.vehicle || body.road; });
  const std::size_t count = scenario.bodies.size();
  for (const simulation::MovingOrifice& orifice : scenario.orifices)
    facts.add(orifice.name, scenario::orifice_words(orifice));
  facts.add("pairs", std::to_string(count * (count - 1) / 2) + ", each proved apart or met");
  if (pilots == 0) facts.add("note", "no body has a pilot: all go straight on");
}

/// Whether the bodies are those of `vericone certify`: one has a track.
bool are_tracks(const Json& fields) {
  const Json& bodies = fields["bodies"];
  return bodies.is_array() && std::any_of(bodies.begin(), bodies.end(), [](const Json& body) {
           return body.is_object() && body.contains("track");
         });
}

std::string track_words(const simulation::TrackedBody& body) {
  std::string text;
  if (body.trajectory) {
    const simulation::Piecewise& way = body.trajectory->position;
    text = "track from " + brief(way.from()) + " to " + brief(way.to()) + " s, " +
           std::to_string(way.points.size()) + (way.points.size() == 1 ? " piece" : " pieces") +
           (body.trajectory->turned || body.trajectory->rotation.size() > 1 ? "; turns" : "");
  } else {
    text = motion_words(body.start.velocity, simulation::planar(body.shape));
    if (body.spin.any()) text += "; spins at " + brief(body.spin.norm()) + " rad/s";
  }
  if (body.radius > 0) text += "; within " + brief(body.radius) + " m of it";
  if (std::isfinite(body.most_speed)) text += "; speed at most " + brief(body.most_speed) + " m/s";
  if (std::isfinite(body.most_acceleration))
    text += "; acceleration at most " + brief(body.most_acceleration) + " m/s^2";
  return text;
}

void check_tracks(const std::string& text, const Json& fields, const std::string& file,
                  scenario::Facts& facts) {
  const scenario::TracksFile tracks = scenario::tracks_of_text(text, file);
  facts.add("tracks", file);
  add_origin(fields, facts);
  std::size_t with_track = 0;
  for (const simulation::TrackedBody& body : tracks.bodies) {
    simulation::Body shown;
    shown.shape = body.shape;
    facts.add(body.name, scenario::shape_words(shown) + "; " + track_words(body));
    if (body.trajectory) ++with_track;
  }
  const std::size_t without = tracks.bodies.size() - with_track;
  facts.add("pairs", std::to_string(with_track * (with_track - 1) / 2 + with_track * without) +
                         ", each to be farther apart than " + brief(tracks.options.required) + " m");
  facts.add("prove it", "vericone certify " + file);
}

/// The body for viewers of glTF, and in the extras what `vericone fit` has proved of it.
void write_body_glb(const scenes::SceneBody& body, const Json& fields, const std::string& glb) {
  Json says{{"what", "body"}};
  for (const char* field : {"file", "mode", "shape", "coverage", "margin", "certified", "certificate"})
    if (fields.contains("certified") && fields.contains(field)) says["fit"][field] = fields[field];
  write_whole(glb, glb::bodies_glb({{"body", body.placed, 1, {{"is", body_words(body.placed)}}}}, says));
}

/// `glb`: a file for viewers; empty: none.
void check_body(const std::string& file, const Json& fields, const std::string& glb, scenario::Facts& facts) {
  const fs::path path(file);
  const Json named{{"file", path.filename().string()}};
  facts.add("body", file);
  // A planar one has two numbers where others have three.
  const Json body = input::body_fields(named, "", path.parent_path());
  const bool two = body.contains("center") && body["center"].is_array() && body["center"].size() == 2;
  const bool flat = input::is_flat_word(body) || (two && body.contains("margin")), planar = two || flat;
  if (planar && !glb.empty())
    throw InputError("--glb", glb, "asked for of a body in space; of a scene in the plane cone writes one");
  if (flat) {
    facts.add("is", input::read_flat_body(body, "").name);
  } else if (planar) {
    facts.add("is", body_words(input::read_planar_body(body, "")));
  } else {
    const scenes::SceneBody read = input::read_body(body, "", path.parent_path());
    facts.add("is", body_words(read.placed));
    if (!glb.empty()) write_body_glb(read, fields, glb);
    add_notes(read.reading, facts);
  }
  facts.add("use it", "obstacle: {file: " + path.filename().string() +
                          "} in a scene or a case, {name: B, file: " + path.filename().string() +
                          "} in a scenario");
}

/// `vericone check`: what a scene, a scenario, tracks, a pursuit, a file with a body, or figures or claims of
/// a paper mean, in plain words, or the first thing that is wrong with it. Nothing is computed but what the
/// bodies are and how far apart they stand. As text, or as JSON: a list of label and text.
int run_check(const std::string& file, bool json, const std::string& glb, std::ostream& out) {
  std::vector<std::string> scans = files::known_extensions();
  scans.insert(scans.end(), {".bt", ".ot"});
  if (std::ranges::find(scans, fs::path(file).extension().string()) != scans.end())
    throw InputError(file, "a scan or a map",
                     "a scene, a scenario or a body; vericone fit reads scans and maps");
  const std::string text = input::read_scene_text(file);
  const Json fields = input::scene_fields(text, file);
  if (!fields.is_object())
    throw InputError(file, input::quoted(fields),
                     "a scene, a scenario, a body, or figures or claims of a paper: a mapping of fields");
  scenario::Facts facts;
  const input::FileKind kind = input::kind_of_file(fields);
  if (!glb.empty() && kind != input::FileKind::body && kind != input::FileKind::unknown)
    throw InputError("--glb", glb,
                     std::string("left out with ") + input::name_of(kind) +
                         ": vericone cone writes one of a scene, simulate of a run");
  switch (kind) {
    case input::FileKind::paper:
      paper::describe(paper::Paper(fs::absolute(file).parent_path().string()), file, facts);
      break;
    case input::FileKind::scenario:
      if (are_tracks(fields))
        check_tracks(text, fields, file, facts);
      else
        check_scenario(fields, file, facts);
      break;
    case input::FileKind::scene:
      check_scene(fields, file, facts);
      break;
    case input::FileKind::pursuit:
      hand_over("pursue", "check", json ? std::vector<std::string>{file, "--json"} : std::vector{file}, file);
    default:
      check_body(file, fields, glb, facts);
  }
  facts.print(json, out);
  return 0;
}

}  // namespace

int check_command(CommandLine& line) {
  std::string file;
  line.option("file", file,
              "Scene, scenario, tracks, pursuit, body, figures or claims, YAML (docs/reference/formats.md, "
              "docs/reference/scenarios.md, docs/reference/papers.md)")
      .required();
  bool json = false;
  line.flag("--json", json, "Print JSON: labels with their texts");
  std::string glb;
  line.option(
      "--glb", glb,
      "File for a body, or a fit (fit.json), as binary glTF, for viewers (docs/reference/formats.md)");
  line.quiet();
  line.read();
  return run_check(file, json, glb, std::cout);
}

}  // namespace vericone
