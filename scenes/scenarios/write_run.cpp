// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/internal/scenarios/words.h>
#include <vericone/internal/simulation/run_tables.h>
#include <vericone/simulation/run_tables.h>
#include <cmath>
#include <fstream>
#include <iterator>
#include <utility>

#include "json/json_value.h"
#include "json/plain_text.h"
#include "output/output_file.h"
#include "scenarios/run_json.h"

namespace vericone::scenario {
namespace {

namespace fs = std::filesystem;

std::string content_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::error_code ignored;
  if (!in || fs::is_directory(file, ignored))
    throw InputError("origin.file", plain_text(file.string()), "a file that can be read");
  return {std::istreambuf_iterator<char>(in), {}};
}

Json provenance_of(const RunOrigin& origin) {
  if (origin.provenance.empty()) return nullptr;
  Json json = Json::parse(origin.provenance, nullptr, false);
  if (json.is_discarded())
    throw InputError("origin.provenance", plain_text(origin.provenance), "JSON, or empty");
  return json;
}

}  // namespace

std::string proof_text(const simulation::Scenario& scenario, const simulation::Run& run) {
  simulation::require_run_of(scenario, run);
  return proof_json(scenario, run).dump(1) + "\n";
}

Json run_json(const simulation::Scenario& scenario, const simulation::Run& run, const RunOrigin& origin) {
  std::size_t arcs = 0, agents = 0;
  for (const simulation::Track& track : run.tracks) arcs += track.legs().size();
  Json goals = Json::array(), accelerations = Json::array();
  for (std::size_t i = 0; i < scenario.bodies.size(); ++i) {
    const simulation::Body& body = scenario.bodies[i];
    agents += body.pilot.has_value();
    if (!body.pilot) continue;
    const double most = simulation::most_commanded(*body.pilot);
    accelerations.push_back({{"agent", body.name},
                             {"most", std::isfinite(most) ? Json(most) : Json(nullptr)},
                             {"reached", run.tracks[i].most_acceleration()}});
    for (const simulation::Goal& goal : body.pilot->goals) {
      const auto number = std::size_t(&goal - body.pilot->goals.data());
      Json one{{"agent", body.name}, {"point", vector_json(goal.point)}, {"reached", goal.reached}};
      if (goal.velocity.any()) one["velocity"] = vector_json(goal.velocity);
      if (!goal.follows.empty()) one["follows"] = goal.follows;
      if (goal.stay > 0) one["stay"] = goal.stay;
      if (std::isfinite(goal.corridor)) one["corridor"] = goal.corridor;
      for (const simulation::CorridorOutcome& flown : run.corridors)
        if (flown.agent == i && flown.goal == number)
          one["stayed"] = {{"from", flown.from},
                           {"to", flown.to},
                           {"verdict", flown.room >= 0 ? "inside"
                                       : flown.left    ? "left"
                                                       : "undecided"},
                           {"room", flown.room}};
      goals.push_back(std::move(one));
    }
  }
  Json plans = Json::array();
  const auto swerves = [&](const simulation::PlansProved& own) {
    const auto& pilot = scenario.bodies[own.agent].pilot;
    if (!pilot || pilot->others_most_of.empty()) return Json(own.others_most);
    Json by_name = Json::object();
    for (const auto& [name, most] : pilot->others_most_of) by_name[name] = most;
    return by_name;
  };
  for (const simulation::PlansProved& own : run.plans)
    plans.push_back({{"agent", scenario.bodies[own.agent].name},
                     {"commands", own.commands},
                     {"proved", own.proved},
                     {"others_most", swerves(own)},
                     {"range", std::isfinite(own.range) ? Json(own.range) : Json(nullptr)}});
  Json beyond = Json::array();
  for (const simulation::VehicleBeyond& b : run.limits_broken)
    beyond.push_back({{"body", scenario.bodies[b.body].name},
                      {"t", b.broken.t},
                      {"limit", b.broken.limit},
                      {"value", b.broken.value},
                      {"allowed", b.broken.allowed}});
  Json json{{"scenario", scenario.name},
            {"file", plain_text(origin.file.filename().string())},
            {"verdict", scenario.orifices.empty() ? simulation::to_string(run.verdict()) : run_verdict(run)},
            {"bodies", scenario.bodies.size()},
            {"agents", agents},
            {"goals", goals},
            {"accelerations", accelerations},
            {"end", run.end},
            {"step", scenario.step},
            {"arcs", arcs},
            {"encounters", run.encounters.size()},
            {"events", run.events.size()},
            {"seconds", origin.seconds},
            {"times",
             {{"decisions", run.times.decisions},
              {"mean", run.times.mean},
              {"within", run.times.within},
              {"worst", run.times.worst},
              {"proofs", run.times.proofs}}},
            {"real_time_factor", run.end / origin.seconds},
            {"provenance", provenance_of(origin)}};
  if (!run.vehicles.empty()) json["limits_broken"] = beyond;
  if (!run.plans.empty()) json["plans"] = plans;
  return json;
}

void write_run(const simulation::Scenario& scenario, const simulation::Run& run, const RunOrigin& origin,
               const fs::path& folder) {
  // What can be refused, before anything is written.
  simulation::require_run_of(scenario, run);
  const bool has_scenario = !origin.text.empty() || !origin.file.empty();
  const std::string text = has_scenario && origin.text.empty() ? content_of(origin.file) : origin.text;
  const std::string own = run_json(scenario, run, origin).dump(1) + "\n";
  for (const simulation::Table& table : simulation::run_tables(scenario, run))
    write_whole(folder / (table.name + ".csv"), csv(table));
  if (!scenario.orifices.empty())
    write_whole(folder / "orifices.json", orifices_json(scenario).dump(1) + "\n");
  write_whole(folder / "proof.json", proof_text(scenario, run));
  write_whole(folder / "shapes.json", shapes_json(scenario).dump(1) + "\n");
  write_whole(folder / "run.json", own);
  if (has_scenario) write_whole(folder / "scenario.yaml", text);
}

}  // namespace vericone::scenario
