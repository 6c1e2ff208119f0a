// SPDX-License-Identifier: BSD-3-Clause
//
// A run as files: tables with units in their column names and JSON, described in docs/reference/scenarios.md.
// What does not apply is an empty field.
#pragma once

#include <vericone/simulation/run.h>
#include <filesystem>
#include <string>

#include "json/json_value.h"

namespace vericone::scenario {

/// One row a body and command time from its appearance.
std::string bodies_csv(const simulation::Scenario& scenario, const simulation::Run& run);
/// One row an agent, an obstacle and a command time.
std::string encounters_csv(const simulation::Scenario& scenario, const simulation::Run& run);
std::string planes_csv(const simulation::Scenario& scenario, const simulation::Run& run);
/// What agents with a sensor measured and made of it, beside the truth.
std::string sights_csv(const simulation::Scenario& scenario, const simulation::Run& run);
/// One row an agent and a command time, of the orifice that it heads for.
std::string orifices_csv(const simulation::Scenario& scenario, const simulation::Run& run);
/// What vehicles log at every command; a column for each of their channels.
std::string vehicles_csv(const simulation::Scenario& scenario, const simulation::Run& run);
std::string events_csv(const simulation::Scenario& scenario, const simulation::Run& run);

/// The verdict, what is proved of every pair and of every passage.
/// touched or undecided where anything is; else missed, where an ordered passage is, or passed, where all
/// are; of runs without orders avoided, or none where no pair could be checked.
std::string run_verdict(const simulation::Run& run);
Json proof_json(const simulation::Scenario& scenario, const simulation::Run& run);
/// What the bodies look like in their own frames.
Json shapes_json(const simulation::Scenario& scenario);
/// The outlines of the orifices, and how they move.
Json orifices_json(const simulation::Scenario& scenario);

/// What a body is at its start, in plain words, and that it changes where it does.
std::string shape_words(const simulation::Body& body);

/// What an event's value is: "m", "s" or "1"; empty where it has none.
std::string unit_of(const simulation::Scenario& scenario, const simulation::Event& event);
bool of_orifice(const simulation::Event& event);
/// The other body's name, or the orifice's; empty where only one body is concerned.
std::string obstacle_of(const simulation::Scenario& scenario, const simulation::Event& event);

/// Where a run came from and what it took.
struct RunOrigin {
  std::filesystem::path file;  // of the scenario
  std::string command_line;
  double seconds = 0;
  std::string text = {};  // of the file; empty: it is read
};

/// Counts, verdict, times, provenance.
Json run_json(const simulation::Scenario& scenario, const simulation::Run& run, const RunOrigin& origin);

/// All of these files and a copy of the scenario's into `folder`; planes.csv where planes are logged,
/// sights.csv where an agent has a sensor, vehicles.csv where there is a vehicle, orifices.csv and
/// orifices.json where there are any. Throws std::runtime_error naming the path.
void write_run(const simulation::Scenario& scenario, const simulation::Run& run, const RunOrigin& origin,
               const std::filesystem::path& folder);

}  // namespace vericone::scenario
