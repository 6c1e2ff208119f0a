// SPDX-License-Identifier: BSD-3-Clause
#include "scenarios/read_scenario.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <utility>

#include "input/assembly_body.h"
#include "input/file_body.h"
#include "input/scene.h"
#include "json/json_value.h"
#include "json/plain_text.h"
#include "scenarios/parts.h"
#include "scenarios/scenario_fields.h"

namespace vericone::scenario {
namespace {

using input::at, input::quoted, input::require_field, input::require_known, input::require_object;

constexpr std::array<const char*, 5> kKinds{"semi_axes", "quadric", "a_c", "dented", "file"};

/// A body as scenes write it, its fields beside `name`: what a scenario calls shape and position.
Json with_shape(const Json& value, const std::string& path) {
  Json body = Json::object(), shape = Json::object();
  if (value.contains("position"))
    throw InputError(path + ".position", quoted(value["position"]),
                     "given with shape; beside a body's own fields its place is center");
  constexpr const char* kOwn[] = {"name",     "velocity", "speed", "heading", "heading_deg", "orientation",
                                  "rotation", "appears",  "pilot", "vehicle", "road"};
  for (const auto& [key, field] : value.items()) {
    const bool own = std::find(std::begin(kOwn), std::end(kOwn), key) != std::end(kOwn);
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
  require_known(value, path,
                {"name", "shape", "position", "velocity", "speed", "heading", "heading_deg", "orientation",
                 "rotation", "appears", "pilot", "vehicle", "road"});
  simulation::Body body;
  body.name = read_text(require_field(value, path, "name", "a name, as text"), path + ".name", "a name");
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
  take(value, path, "appears", body.appears, read_not_negative, " (s)");
  take(value, path, "pilot", body.pilot, read_pilot, planar);
  // Who starts at rest and could not change its speed could do nothing.
  const auto pilot = value.find("pilot");
  if (body.pilot && !body.start.velocity.any() &&
      !(pilot->contains("clearance") && (*pilot)["clearance"].contains("longitudinal")))
    body.pilot->guide.clearance.longitudinal = true;
  return body;
}

void read_proof(const Json& value, const std::string& path, simulation::ProofOptions& proof) {
  require_object(value, path);
  require_known(value, path, {"padding", "resolution", "drift"});
  take(value, path, "padding", proof.padding, read_not_negative, " (metres)");
  take(value, path, "resolution", proof.resolution, read_positive, " (s)");
  take(value, path, "drift", proof.drift, read_not_negative, " (m/s)");
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

}  // namespace

simulation::Scenario read_scenario(const Json& fields, const std::string& name,
                                   const std::filesystem::path& folder, Readings* readings) {
  if (!fields.is_object()) throw InputError("scenario", quoted(fields), "a mapping with bodies");
  require_known(fields, "",
                {"name", "duration", "step", "stop_when_passed", "planes_logged", "proof", "bodies", "seed",
                 "orifices", "current"});
  simulation::Scenario scenario;
  scenario.name = name;
  take(fields, "", "name", scenario.name, read_text, "a name");
  take(fields, "", "duration", scenario.duration, read_positive, " (s)");
  take(fields, "", "step", scenario.step, read_positive, " (s)");
  take(fields, "", "stop_when_passed", scenario.stop_when_passed, read_flag);
  take(fields, "", "planes_logged", scenario.planes_logged, read_count, 0, 10'000);
  if_given(fields, "", "proof",
           [&](const Json& v, const std::string& p) { read_proof(v, p, scenario.proof); });
  if_given(fields, "", "seed", [&](const Json& v, const std::string& p) {
    scenario.seed = std::uint64_t(read_count(v, p, 0, 2'000'000'000));
  });
  if_given(fields, "", "current",
           [&](const Json& v, const std::string& p) { scenario.water = read_current(v, p, scenario.seed); });
  const Json& bodies = require_field(fields, "", "bodies", "a list of bodies");
  if (!bodies.is_array() || bodies.empty()) throw InputError("bodies", quoted(bodies), "a list of bodies");
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    std::optional<scenes::Reading> reading;
    scenario.bodies.push_back(read_body(bodies[i], at("bodies", i), folder, reading));
    if (readings) readings->push_back(std::move(reading));
  }
  if_given(fields, "", "orifices", [&](const Json& v, const std::string& p) {
    if (!v.is_array() || v.empty()) throw InputError(p, quoted(v), "a list of orifices");
    for (std::size_t i = 0; i < v.size(); ++i)
      scenario.orifices.push_back(read_orifice(v[i], at(p, i), folder));
  });
  for (simulation::Body& body : scenario.bodies)  // the outer loop's step is the scenario's
    if (body.pilot && body.pilot->guide.robust) body.pilot->guide.robust->model.dt = scenario.step;
  simulation::check(scenario);
  check_size(scenario);
  return scenario;
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
