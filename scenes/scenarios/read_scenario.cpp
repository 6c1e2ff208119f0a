// SPDX-License-Identifier: BSD-3-Clause
#include "scenarios/read_scenario.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <utility>

#include "input/assembly_body.h"
#include "input/field_table.h"
#include "input/file_body.h"
#include "input/scene.h"
#include "json/plain_text.h"
#include "scenarios/parts.h"
#include "units/geographic.h"

namespace vericone::scenario {
namespace {

using input::absent, input::at, input::Fields, input::if_given, input::not_negative, input::number,
    input::positive, input::quoted, input::require_field, input::require_object, input::required,
    input::vector;

constexpr std::array<const char*, 5> kKinds{"semi_axes", "quadric", "a_c", "dented", "file"};

/// Of a body beside its shape; read_body reads them, since one decides how another is read.
const Fields<simulation::Body>& body_fields() {
  using B = simulation::Body;
  const auto one_of = [](const char* title, const char* first, const char* second) {
    return Json{{"title", title}, {"anyOf", {{{"$ref", first}}, {{"$ref", second}}}}};
  };
  const Json point{{"$ref", "body.schema.json#/$defs/point"}, {"unit", "m"}};
  const auto heading = [](const char* unit) { return Json{{"$ref", "#/$defs/heading"}, {"unit", unit}}; };
  Json velocity = point;
  velocity["unit"] = "m/s";
  static const Fields<B> fields =
      Fields<B>("body")
          .special("name", {{"type", "string"}}, {}, "No other body has it.", required("a name, as text"))
          .special(
              "shape", {{"$ref", "#/$defs/shape"}}, {},
              "Exactly one of the kinds below, in the body's own frame: x ahead. In place of `shape` and "
              "`position` you may write the fields of a body as in a scene; `center` then says where it "
              "appears.",
              absent("required, or the `body` of a fish"))
          .special("position", point, {}, "Where it is when it appears.", required("a place"))
          .special("velocity", velocity, {},
                   "When it appears, in the world. Of a body with a pilot 0 only where that is "
                   "[guarded](../explanation/guarded.md).",
                   absent("at rest"))
          .special("speed", not_negative("m/s").schema, {},
                   "In place of `velocity`, with `heading` or `heading_deg`.")
          .special("heading", heading("rad"), {}, "In the plane an angle, in space `[azimuth, elevation]`.")
          .special("heading_deg", heading("degrees"), {}, "The same in degrees.")
          .special(
              "orientation", {{"enum", {"heading", "level", "fixed"}}, {"default", "heading"}}, {},
              "`heading`: the body turns with its velocity, without roll. `level`: x along the velocity, y "
              "level, as in the source's 6.5. `fixed`: it does not turn.")
          .special("rotation", {{"$ref", "body.schema.json#/$defs/rotation"}}, {},
                   "Attitude at the start, written as in a scene. Not with `level`.",
                   absent("x along the velocity, y level"))
          .row("appears", &B::appears, not_negative("s"), "When it appears.")
          .special("pilot", {{"$ref", "#/$defs/pilot"}}, {}, "Who steers it.", absent("it goes straight on"))
          .special("vehicle", one_of("vehicle", "#/$defs/vehicle", "#/$defs/quadrotor"), {},
                   "What moves it by its own equations of motion, below.",
                   absent("a point mass under its pilot's acceleration"))
          .special(
              "road", one_of("road", "#/$defs/lanes", "#/$defs/squircle"), {},
              "What a body without pilot and vehicle follows, to 1e-6 m, from its position and from when it "
              "appears, below. Of the motion's fields `position` alone is given beside it.",
              absent("it keeps its velocity"));
  return fields;
}

/// A body as scenes write it, its fields beside `name`: what a scenario calls shape and position.
Json with_shape(const Json& value, const std::string& path) {
  Json body = Json::object(), shape = Json::object();
  if (value.contains("position"))
    throw InputError(path + ".position", quoted(value["position"]),
                     "given with shape; beside a body's own fields its place is center");
  for (const auto& [key, field] : value.items()) {
    const bool own = key != "shape" && body_fields().has(key);
    if (key == "center")
      body["position"] = field;
    else
      (own ? body : shape)[key] = field;
  }
  // As in scenes: a body from a file stands where the file has it, unless it says otherwise.
  if (!body.contains("position") && !shape.contains("semi_axes") && !shape.contains("shape") &&
      !shape.contains("a_c") && !shape.contains("dented"))
    body["position"] = {0, 0, 0};
  body["shape"] = std::move(shape);
  return body;
}

/// `shape` is a matrix where a body is given by one, and a mapping where a scenario's body is.
bool by_shape(const Json& body) {
  if (body.contains("shape")) return !body["shape"].is_array();
  return !input::is_pieces_body(body) && !input::is_union(body) &&
         std::none_of(kKinds.begin(), kKinds.end(), [&](const char* kind) { return body.contains(kind); });
}

simulation::Body read_body(const Json& given, const std::string& path, const std::filesystem::path& folder,
                           std::optional<scenes::Reading>& reading) {
  require_object(given, path);
  const Json value = by_shape(given) ? given : with_shape(given, path);
  body_fields().require_known(value, path);
  simulation::Body body;
  body.name =
      input::text("a name").read(require_field(value, path, "name", "a name, as text"), path + ".name");
  bool own_shape = false;
  if_given(value, path, "vehicle", [&](const Json& v, const std::string& p) {
    const VehicleRead read = read_vehicle(v, p, value.contains("shape"));
    body.vehicle = read.model;
    own_shape = read.shape.has_value();
    if (own_shape) body.shape = *read.shape;
  });
  if (!own_shape)
    body.shape = read_shape(require_field(value, path, "shape", "a mapping, such as {semi_axes: [3, 2, 1]}"),
                            path + ".shape", folder, reading);
  const bool planar = simulation::planar(body.shape);
  if (value.contains("road"))
    read_road(value, path, planar, body);
  else
    read_motion(value, path, planar, body);
  if_given(value, path, "appears",
           [&](const Json& v, const std::string& p) { body.appears = not_negative("s").read(v, p); });
  if_given(value, path, "pilot",
           [&](const Json& v, const std::string& p) { body.pilot = read_pilot(v, p, planar); });
  // Who starts at rest and could not change its speed could do nothing.
  const auto pilot = value.find("pilot");
  if (body.pilot && !body.start.velocity.any() &&
      !(pilot->contains("clearance") && (*pilot)["clearance"].contains("longitudinal")))
    body.pilot->guide.clearance.longitudinal = true;
  return body;
}

const Fields<simulation::ProofOptions>& proof_fields() {
  using P = simulation::ProofOptions;
  static const Fields<P> fields =
      Fields<P>("object")
          .row("padding", &P::padding, not_negative("m"),
               "The proof holds for all motions that are this near to the computed one.")
          .row("resolution", &P::resolution, positive("s"),
               "Times shorter than this are not divided further.")
          .row("drift", &P::drift, not_negative("m/s"),
               "The proof holds for all constant currents of at most this speed that carry the bodies off "
               "their "
               "ways.");
  return fields;
}

/// The path of a field as the file has it: a pilot's only goal may be its `goal`.
std::string as_written(std::string path, const Json& fields) {
  const Json& bodies = fields["bodies"];
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const std::string goal = at("bodies", i) + ".pilot.goal", first = goal + "s[0]";
    if (path.starts_with(first) && bodies[i]["pilot"].contains("goal")) path.replace(0, first.size(), goal);
  }
  return path;
}

/// Every row of the tables is kept until the run is over.
void check_size(const simulation::Scenario& scenario) {
  constexpr double kMostRows = 3e6;
  double rows = double(scenario.bodies.size());  // a step
  for (const simulation::Body& body : scenario.bodies)
    if (body.pilot)
      rows += double(body.pilot->minds.empty() ? scenario.bodies.size() - 1 : body.pilot->minds.size());
  const double steps = std::ceil(scenario.duration / scenario.step);
  if (steps * rows <= kMostRows) return;
  throw InputError("step", to_text(scenario.step),
                   "at least " + to_text(scenario.duration * rows / kMostRows) + " s: " + to_text(steps) +
                       " steps of " + to_text(rows) +
                       " rows (bodies, and pairs with an agent) are more than 3000000 rows");
}

/// A scenario while it is read.
struct ScenarioFile : simulation::Scenario {
  std::filesystem::path folder;
  Readings* readings = nullptr;
};

void read_bodies(const Json& value, const std::string& path, ScenarioFile& scenario) {
  if (!value.is_array() || value.empty()) throw InputError(path, quoted(value), "a list of bodies");
  for (std::size_t i = 0; i < value.size(); ++i) {
    std::optional<scenes::Reading> reading;
    scenario.bodies.push_back(read_body(value[i], at(path, i), scenario.folder, reading));
    if (scenario.readings) scenario.readings->push_back(std::move(reading));
  }
}

void read_orifices(const Json& value, const std::string& path, ScenarioFile& scenario) {
  if (!value.is_array() || value.empty()) throw InputError(path, quoted(value), "a list of orifices");
  for (std::size_t i = 0; i < value.size(); ++i)
    scenario.orifices.push_back(read_orifice(value[i], at(path, i), scenario.folder));
}

const Fields<ScenarioFile>& scenario_fields() {
  using S = ScenarioFile;
  const auto list_of = [](const char* title, Json items) {
    return Json{{"type", "array"}, {"items", std::move(items)}, {"minItems", 1}, {"title", title}};
  };
  const auto water = [](const Json& v, const std::string& p, S& s) { s.water = read_current(v, p, s.seed); };
  static const Fields<S> fields =
      Fields<S>("vericone: a scenario")
          .row("name", &S::name, input::text("a name"), "What reports call the run.",
               absent("the file's name"))
          .row("duration", &S::duration, positive("s"), "The run ends after so long at most.")
          .row("step", &S::step, positive("s"), "Between two commands. A command is held in between.")
          .row("stop_when_passed", &S::stop_when_passed, input::flag(),
               "True: the run ends when every agent has passed all bodies that it minds, and no body is "
               "still to "
               "appear.")
          .row("planes_logged", &S::planes_logged, input::count(0, 10'000),
               "At every command y and psi are logged on so many planes.")
          .row("proof", &S::proof, input::mapping(proof_fields()), "How sharply the run is proved, below.")
          .special("bodies",
                   list_of("list of bodies",
                           {{"anyOf", {{{"$ref", "#/$defs/by_shape"}}, {{"$ref", "#/$defs/as_in_scenes"}}}}}),
                   read_bodies, "All in the plane, or all in space.", required("a list of bodies"))
          .row("seed", &S::seed, input::count(0, 2'000'000'000), "Of the noise that sensors make.")
          .special("orifices", list_of("list of orifices", {{"$ref", "#/$defs/orifice"}}), read_orifices,
                   "Openings that agents pass through, in space, below.", absent("none"))
          .special("current", {{"$ref", "#/$defs/current"}}, water,
                   "Water or air that moves vehicles, below.", absent("none"))
          .special(
              "origin", input::origin_schema(), {},
              "Of a scenario on the Earth: its places may be written by latitude, longitude and altitude, "
              "as in [scenes](formats.md#places-on-the-earth).",
              absent("nowhere"));
  return fields;
}

}  // namespace

simulation::Scenario read_scenario(const Json& given, const std::string& name,
                                   const std::filesystem::path& folder, Readings* readings) {
  if (!given.is_object()) throw InputError("scenario", quoted(given), "a mapping with bodies");
  Json kept;
  const Json& fields = input::localized(given, kept);
  ScenarioFile read{{}, folder, readings};
  read.name = name;
  scenario_fields().read(fields, "", read);
  simulation::Scenario scenario = std::move(read);
  for (simulation::Body& body : scenario.bodies)  // the outer loop's step is the scenario's
    if (body.pilot && body.pilot->guide.robust) body.pilot->guide.robust->model.dt = scenario.step;
  try {
    simulation::check(scenario);
  } catch (const InputError& e) {
    throw InputError(as_written(e.field(), fields), e.value(), e.requirement());
  }
  check_size(scenario);
  return scenario;
}

Json scenario_file_schema() {
  Json schema = scenario_fields().schema(), by_shape = body_fields().schema();
  // What with_shape() takes apart.
  Json in_scenes = by_shape;
  Json& fields = in_scenes["properties"];
  fields.erase("shape");
  fields.erase("position");
  const Json shape = shape_schemas()["shape"];
  for (const auto& [name, field] : shape["properties"].items())
    if (!fields.contains(name)) fields[name] = field;
  in_scenes["required"] = {"name"};
  schema["$defs"] = {{"by_shape", std::move(by_shape)},
                     {"as_in_scenes", std::move(in_scenes)},
                     {"heading",
                      {{"title", "angle, or [azimuth, elevation]"},
                       {"anyOf", {number("rad").schema, vector<2>("rad").schema}},
                       {"description", "An angle in the plane, [azimuth, elevation] in space."}}}};
  return schema;
}

simulation::Scenario scenario_of_text(const std::string& text, const std::string& file) {
  const Json fields = input::scene_fields(text, file);
  input::require_kind(fields, input::FileKind::scenario, file);
  return read_scenario(fields, plain_text(std::filesystem::path(file).stem().string()),
                       std::filesystem::path(file).parent_path());
}

simulation::Scenario read_scenario(const std::string& file) {
  return scenario_of_text(input::read_scene_text(file), file);
}

}  // namespace vericone::scenario
