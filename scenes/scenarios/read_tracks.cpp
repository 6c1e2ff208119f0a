// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/scenarios/scenario_files.h>
#include <Eigen/Geometry>
#include <filesystem>
#include <utility>

#include "input/field_table.h"
#include "input/scene.h"
#include "input/spatial_body.h"
#include "json/plain_text.h"
#include "output/schemas.h"
#include "scenarios/parts.h"
#include "scenarios/read_track.h"
#include "scenarios/tracks_json.h"
#include "units/geographic.h"

namespace vericone::scenario {
namespace {

using Eigen::Vector3d;
using input::absent, input::Fields, input::not_negative, input::number, input::positive, input::quoted;
using simulation::TrackedBody;

/// [x, y, z], or [x, y] in the plane.
Vector3d read_place(const Json& value, const std::string& path, const std::string& words) {
  if (value.is_array() && value.size() == 2) {
    const Eigen::Vector2d flat = input::read_vector<2>(value, path, words.c_str());
    return {flat.x(), flat.y(), 0};
  }
  return input::read_vector<3>(value, path, (words + ", or of 2 in the plane").c_str());
}

Json place_schema(const char* unit) { return {{"$ref", "body.schema.json#/$defs/point"}, {"unit", unit}}; }

/// A body while it is read.
struct BodyFields : TrackedBody {
  std::filesystem::path folder;
};

const Fields<TrackedBody>& track_limit_fields() {
  static const Fields<TrackedBody> fields =
      Fields<TrackedBody>("limits")
          .row("speed", &TrackedBody::most_speed, positive("m/s"), "Its track is never faster.",
               absent("none"))
          .row("acceleration", &TrackedBody::most_acceleration, positive("m/s²"),
               "Nor has it a larger acceleration, nor a velocity that jumps.", absent("none"));
  return fields;
}

const Fields<BodyFields>& tracked_body_fields() {
  using B = BodyFields;
  const auto place = [](Vector3d simulation::Motion::*member, const char* words) {
    return [=](const Json& v, const std::string& p, B& b) { b.start.*member = read_place(v, p, words); };
  };
  static const Fields<B> fields =
      Fields<B>("body")
          .row("name", &B::name, input::text("a name"), "No other body has it.",
               input::required("a name, as text"))
          .special(
              "shape", {{"$ref", "#/$defs/shape"}},
              [](const Json& v, const std::string& p, B& b) {
                std::optional<scenes::Reading> reading;
                b.shape = read_shape(v, p, b.folder, reading);
              },
              "As in a scenario, in the body's own frame; it may change.",
              input::required("a mapping, such as {semi_axes: [0.3, 0.3, 0.1]}"))
          .special(
              "track", {{"$ref", "#/$defs/track"}},
              [](const Json& v, const std::string& p, B& b) { b.trajectory = read_track(v, p, b.folder); },
              "How it moves and turns, below.", absent("by the four fields that follow, for all time"))
          .special("position", place_schema("m"), place(&simulation::Motion::position, " (metres)"),
                   "At t = 0, of a body without `track`.", absent("the origin"))
          .special("velocity", place_schema("m/s"), place(&simulation::Motion::velocity, " (m/s)"),
                   "The same at all times.", absent("at rest"))
          .special(
              "rotation", {{"$ref", "body.schema.json#/$defs/rotation"}},
              [](const Json& v, const std::string& p, B& b) {
                if (input::may_be_number(v))
                  b.start.rotation =
                      Eigen::AngleAxisd(input::read_number(v, p, " (radians)"), Vector3d::UnitZ())
                          .toRotationMatrix();
                else
                  b.start.rotation = input::read_rotation(Json{{"rotation", v}}, p.substr(0, p.rfind('.')));
              },
              "At t = 0.", absent("not turned"))
          .special(
              "spin",
              {{"title", "[x, y, z], or a number about z"},
               {"anyOf", {input::vector<3>("rad/s").schema, number("rad/s").schema}},
               {"unit", "rad/s"}},
              [](const Json& v, const std::string& p, B& b) {
                b.spin = input::may_be_number(v) ? Vector3d(0, 0, input::read_number(v, p, " (rad/s)"))
                                                 : input::read_vector<3>(v, p, " (rad/s), or one about z");
              },
              "About its reference point, in world axes.", absent("it does not turn"))
          .row("radius", &B::radius, not_negative("m"),
               "Tracking error: every point of the body stays this near to where its track puts it.")
          .special(
              "limits", {{"$ref", "#/$defs/limits"}},
              [](const Json& v, const std::string& p, B& b) { track_limit_fields().read(v, p, b); },
              "That its track is to keep.", absent("none"));
  return fields;
}

struct FileFields : TracksFile {
  std::filesystem::path folder;
};

TrackedBody read_one(const Json& value, const std::string& path, const std::filesystem::path& folder) {
  BodyFields body;
  body.folder = folder;
  tracked_body_fields().read(value, path, body);
  if (value.contains("track"))
    for (const char* other : {"position", "velocity", "rotation", "spin"})
      if (value.contains(other))
        throw InputError(input::join(path, other), quoted(value[other]),
                         "left out beside track, which says it");
  if (value.contains("limits") && !value.contains("track"))
    throw InputError(input::join(path, "limits"), quoted(value["limits"]), "given of a body with a track");
  return body;
}

void read_tracked_bodies(const Json& value, const std::string& path, FileFields& file) {
  if (!value.is_array() || value.empty()) throw InputError(path, quoted(value), "a list of bodies");
  for (std::size_t i = 0; i < value.size(); ++i) {
    file.bodies.push_back(read_one(value[i], input::at(path, i), file.folder));
    for (std::size_t j = 0; j < i; ++j)
      if (file.bodies[j].name == file.bodies[i].name)
        throw InputError(input::at(path, i) + ".name", quoted(value[i]["name"]),
                         "a name that no other body has");
  }
}

const Fields<FileFields>& tracks_file_fields() {
  using F = FileFields;
  const auto option = [](auto simulation::CertifyOptions::*member) {
    return [member](F & file) -> auto& { return file.options.*member; };
  };
  const auto time = [](std::optional<double> simulation::CertifyOptions::*member) {
    return [member](const Json& v, const std::string& p, F& f) {
      f.options.*member = input::read_number(v, p, " (s)");
    };
  };
  const Json seconds = number("s").schema;
  static const Fields<F> fields =
      Fields<F>("vericone: tracks of others")
          .row("name", &F::name, input::text("a name"), "What the answer is called.",
               absent("the file's name"))
          .row("required", option(&simulation::CertifyOptions::required), not_negative("m"),
               "Bodies are to be farther apart than this.")
          .special("from", seconds, time(&simulation::CertifyOptions::from), "From when.",
                   absent("the first track's beginning"))
          .special("to", seconds, time(&simulation::CertifyOptions::to), "Until when.",
                   absent("the last track's end"))
          .row("join", option(&simulation::CertifyOptions::join), not_negative(),
               "Pieces of a track may miss each other by this (m, rad), as rounded coefficients do, and a "
               "velocity "
               "may jump by as much (m/s) within a limit of acceleration.")
          .row("resolution", option(&simulation::CertifyOptions::resolution), positive("s"),
               "Pieces of time that are shorter are not divided.")
          .special("bodies",
                   {{"type", "array"},
                    {"items", {{"$ref", "#/$defs/body"}}},
                    {"minItems", 1},
                    {"title", "list of bodies"}},
                   read_tracked_bodies,
                   "Of which one or more have tracks; in the plane or in space, all of them.",
                   input::required("a list of bodies"))
          .special("origin", input::origin_schema(), {},
                   "As of a scene: places of bodies and of tracks may then be written by latitude and "
                   "longitude.",
                   absent("nowhere"));
  return fields;
}

/// The library's words for what the file calls otherwise.
std::string as_written(std::string field) {
  for (const std::string own : {".trajectory.position", ".trajectory.turned", ".trajectory"})
    if (const auto at = field.find(own); at != std::string::npos)
      return field.replace(at, own.size(), ".track");
  return field;
}

}  // namespace

TracksFile tracks_of_text(const std::string& text, const std::string& file) {
  const Json fields = input::scene_fields(text, file);
  if (!fields.is_object()) throw InputError(plain_text(file), quoted(fields), "a mapping with bodies");
  FileFields read;
  read.folder = std::filesystem::path(file).parent_path();
  read.name = plain_text(std::filesystem::path(file).stem().string());
  Json kept;
  tracks_file_fields().read(input::localized(fields, kept), "", read);
  return read;
}

TracksFile read_tracks(const std::string& file) { return tracks_of_text(input::read_scene_text(file), file); }

simulation::CertifiedTracks certified_of(const TracksFile& tracks) {
  try {
    return simulation::certify(tracks.bodies, tracks.options);
  } catch (const InputError& e) {
    throw InputError(as_written(e.field()), e.value(), e.requirement());
  }
}

Json tracks_schema() {
  Json schema = tracks_file_fields().schema();
  schema["$defs"] = shape_schemas();
  schema["$defs"].update(track_schemas());
  schema["$defs"]["body"] = tracked_body_fields().schema();
  schema["$defs"]["limits"] = track_limit_fields().schema();
  return input::schema_of(
      "tracks of others",
      "vericone certify TRACKS.yaml, docs/reference/formats.md. Metres, seconds, radians.",
      std::move(schema));
}

Json certified_json(const TracksFile& tracks, const simulation::CertifiedTracks& certified) {
  using namespace simulation;
  Json pairs = Json::array(), limits = Json::array();
  for (const PairOnTracks& pair : certified.pairs) {
    Json entry{{"a", tracks.bodies[pair.a].name},
               {"b", tracks.bodies[pair.b].name},
               {"verdict", to_string(pair.verdict)},
               {"from", pair.from},
               {"to", pair.to},
               {"place", vector_json(pair.place)},
               {"least_distance", nullptr},
               {"least_time", nullptr},
               {"pieces", pair.pieces}};
    if (pair.verdict == TrackVerdict::apart) {
      entry["least_distance"] = pair.least_distance;
      entry["least_time"] = pair.least_time;
    } else if (pair.stated && pair.stated->verdict == ProofVerdict::avoided) {
      entry["tracks_apart_by"] = pair.stated->least_distance;
    }
    entry["required"] = tracks.options.required;
    entry["radii"] = {tracks.bodies[pair.a].radius, tracks.bodies[pair.b].radius};
    pairs.push_back(std::move(entry));
  }
  for (const LimitOnTrack& one : certified.limits) {
    Json entry{{"body", tracks.bodies[one.body].name},
               {"of", one.derivative == 1 ? "speed" : "acceleration"},
               {"limit", one.limit},
               {"verdict", to_string(one.verdict)},
               {"at_least", one.greatest.least},
               {"at_most", one.greatest.most},
               {"time", one.greatest.time}};
    if (one.derivative == 2) entry["velocity_jump"] = one.greatest.jump;
    limits.push_back(std::move(entry));
  }
  return {{"name", tracks.name},
          {"verdict", certified.pairs.empty() ? "none" : to_string(certified.verdict())},
          {"pairs", std::move(pairs)},
          {"limits", std::move(limits)}};
}

}  // namespace vericone::scenario
