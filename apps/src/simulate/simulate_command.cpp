// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/simulate_command.h"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <sstream>

#include "figures.h"
#include "interrupt.h"
#include "progress.h"
#include "provenance.h"
#include "simulate/read_scenario.h"
#include "simulate/run_files.h"
#include "simulate/run_text.h"
#include "staged_folder.h"

namespace vericone {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

const std::vector<std::string>& names_of_files() {
  static const std::vector<std::string> names{
      "bodies.csv",  "encounters.csv", "planes.csv",    "events.csv",     "proof.json",
      "shapes.json", "run.json",       "scenario.yaml", "simulation.png", "simulation.pdf"};
  return names;
}

std::string content_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) throw std::runtime_error("could not read " + file.string());
  return text.str();
}

Json run_json(const SimulateOptions& options, const simulation::Scenario& scenario,
              const simulation::Run& run, double seconds) {
  std::size_t arcs = 0, agents = 0;
  for (const simulation::Track& track : run.tracks) arcs += track.arcs().size();
  for (const simulation::Body& body : scenario.bodies) agents += body.pilot.has_value();
  return {{"scenario", scenario.name},
          {"file", options.scenario},
          {"verdict", simulation::to_string(run.verdict())},
          {"bodies", scenario.bodies.size()},
          {"agents", agents},
          {"end", run.end},
          {"step", scenario.step},
          {"arcs", arcs},
          {"encounters", run.encounters.size()},
          {"events", run.events.size()},
          {"seconds", seconds},
          {"real_time_factor", run.end / seconds},
          {"provenance", provenance(options.command_line)}};
}

void write_files(const SimulateOptions& options, const simulation::Scenario& scenario,
                 const simulation::Run& run, const Json& summary, const fs::path& folder) {
  write_whole(folder / "bodies.csv", scenario::bodies_csv(scenario, run));
  write_whole(folder / "encounters.csv", scenario::encounters_csv(scenario, run));
  if (scenario.planes_logged > 0) write_whole(folder / "planes.csv", scenario::planes_csv(scenario, run));
  write_whole(folder / "events.csv", scenario::events_csv(scenario, run));
  write_whole(folder / "proof.json", scenario::proof_json(scenario, run).dump(1) + "\n");
  write_whole(folder / "shapes.json", scenario::shapes_json(scenario).dump(1) + "\n");
  write_whole(folder / "run.json", summary.dump(1) + "\n");
  write_whole(folder / "scenario.yaml", content_of(options.scenario));
}

int carry_out(const SimulateOptions& options, std::ostream& out) {
  StagedFolder folder(options.out, "--out");
  const simulation::Scenario scenario = scenario::read_scenario(options.scenario);
  std::optional<simulation::Run> run;
  Json summary;
  double seconds = 0;
  {
    Progress progress(options.quiet);
    simulation::RunOptions run_options;
    const std::string what = "simulating " + scenario.name;
    run_options.progress = [&](double t) { return progress.show(what, t / scenario.duration); };
    const auto start = Clock::now();
    run = simulation::simulate(scenario, run_options);
    seconds = std::chrono::duration<double>(Clock::now() - start).count();
    if (run->interrupted || interrupted()) return kExitInterrupted;
    progress.show("writing", 0);
    summary = run_json(options, scenario, *run, seconds);
    write_files(options, scenario, *run, summary, folder.path());
    if (options.figures) {
      progress.show("drawing", 0);
      draw_figures("simulation.py", folder.path());
    }
    if (interrupted()) return kExitInterrupted;
  }
  const std::vector<fs::path> files = folder.publish(names_of_files());
  if (options.json) {
    out << Json{{"proof", scenario::proof_json(scenario, *run)}, {"run", summary}}.dump(1) << '\n';
    return 0;
  }
  scenario::print_run(scenario, *run, seconds, out);
  std::string list;
  for (const fs::path& file : files) list.append(list.empty() ? "" : ", ").append(file.filename().string());
  out << "written             " << options.out << ": " << list << '\n';
  return 0;
}

}  // namespace

int run_simulate(const SimulateOptions& options, std::ostream& out) {
  catch_interrupts();
  try {
    return carry_out(options, out);
  } catch (const std::runtime_error&) {
    // A figure script gets the same signal and ends.
    if (interrupted()) return kExitInterrupted;
    throw;
  }
}

}  // namespace vericone
