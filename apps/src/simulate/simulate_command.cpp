// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/simulation/certificate.h>
#include <vericone/work/staged_folder.h>
#include <filesystem>
#include <iostream>
#include <ostream>
#include <string>

#include "commands.h"
#include "input/scene.h"
#include "input/stopwatch.h"
#include "json/json_value.h"
#include "output/figures.h"
#include "output/output_file.h"
#include "output/output_options.h"
#include "output/page_file.h"
#include "output/progress.h"
#include "scenarios/pictures/run_glb.h"
#include "scenarios/read_scenario.h"
#include "scenarios/run_json.h"
#include "simulate/run_page.h"
#include "simulate/run_text.h"
#include "work/interrupt.h"
#include "work/provenance.h"

namespace vericone {
namespace {

namespace fs = std::filesystem;

struct SimulateOptions : OutputOptions {
  SimulateOptions() { out = "out/simulate"; }
  std::string scenario;
  bool animate = false;  // also a page that shows the run over time
  bool certificate = false;
  bool glb = false;  // also the run for viewers of glTF
};

const std::vector<std::string>& names_of_files() {
  static const std::vector<std::string> names{
      "bodies.csv",      "encounters.csv",   "planes.csv",    "events.csv",     "proof.json",
      "shapes.json",     "run.json",         "scenario.yaml", "simulation.png", "simulation.pdf",
      "simulation.html", "certificate.json", "simulation.glb"};
  return names;
}

/// One certificate a line.
std::string lines_of(const simulation::RunCertificates& certificates) {
  std::string text;
  for (const simulation::RunCertificate& one : certificates.made) text.append(one.text).append("\n");
  return text;
}

Json certificate_json(const simulation::RunCertificates& certificates) {
  Json json{{"pairs", 0}, {"none", Json::array()}};
  std::size_t pairs = 0;
  for (const simulation::RunCertificate& one : certificates.made) pairs += one.pairs.size();
  json["pairs"] = pairs;
  for (const simulation::WithoutCertificate& none : certificates.none)
    json["none"].push_back(Json{{"what", none.what}, {"reason", none.reason}});
  return json;
}

void print_certificates(const simulation::RunCertificates& certificates, std::ostream& out) {
  for (const simulation::RunCertificate& one : certificates.made)
    scenario::print_line(out, &one == &certificates.made.front() ? "certificate" : "",
                         scenario::certificate_text(one));
  for (const simulation::WithoutCertificate& none : certificates.none)
    scenario::print_line(
        out, certificates.made.empty() && &none == &certificates.none.front() ? "certificate" : "",
        "none of " + none.what + ": " + none.reason);
}

/// Carries out a scenario and writes what happened and what is proved of it. Returns the exit status: 0
/// whatever the verdict is, 130 interrupted. Throws InputError.
int run_simulate(const SimulateOptions& options, std::ostream& out) {
  work::StagedFolder folder(options.out, "--out");
  const std::string text = input::read_scene_text(options.scenario);
  const simulation::Scenario scenario = scenario::scenario_of_text(text, options.scenario);
  std::optional<simulation::Run> run;
  std::optional<simulation::RunCertificates> certificates;
  Json summary;
  double seconds = 0;
  {
    Progress progress(options.quiet);
    simulation::RunOptions run_options;
    const std::string what = "simulating " + scenario.name;
    run_options.progress = [&](double t) { return progress.show(what, t / scenario.duration); };
    run_options.proving = [&](double share) { return progress.show("proving " + scenario.name, share); };
    const auto start = Clock::now();
    run = simulation::simulate(scenario, run_options);
    seconds = seconds_since(start);
    if (run->interrupted) return kExitInterrupted;
    if (options.certificate) {
      bool stopped = false;
      certificates = simulation::certificates(scenario, *run, [&](double share) {
        stopped = !progress.show("certificates of " + scenario.name, share);
        return !stopped;
      });
      if (stopped) return kExitInterrupted;
    }
    progress.show("writing", 0);
    const scenario::RunOrigin origin{
        options.scenario, provenance(options.command_line, 1, {options.scenario}).dump(), seconds, text};
    summary = scenario::run_json(scenario, *run, origin);
    scenario::write_run(scenario, *run, origin, folder.path());
    if (certificates && !certificates->made.empty())
      write_whole(folder.path() / "certificate.json", lines_of(*certificates));
    if (options.glb) write_whole(folder.path() / "simulation.glb", scenario::run_glb(scenario, *run));
    if (options.figures) progress.show("drawing", 0);
    if (options.figures) draw_figures("simulation.py", folder.path());
    if (options.animate)
      write_whole(folder.path() / "simulation.html", page_with(run_page(folder.path(), scenario)));
  }
  const std::vector<fs::path> files = folder.publish(names_of_files());
  if (options.json) {
    Json answer{{"proof", scenario::proof_json(scenario, *run)}, {"run", summary}};
    if (certificates) answer["certificate"] = certificate_json(*certificates);
    out << answer.dump(1) << '\n';
    return 0;
  }
  scenario::print_run(scenario, *run, seconds, out);
  if (certificates) print_certificates(*certificates, out);
  std::string list;
  for (const fs::path& file : files) list.append(list.empty() ? "" : ", ").append(file.filename().string());
  out << "written             " << options.out << ": " << list << '\n';
  return 0;
}

}  // namespace

int simulate_command(CommandLine& line) {
  SimulateOptions simulate;
  line.option("scenario", simulate.scenario, "Scenario file, YAML (docs/reference/scenarios.md)").required();
  line.option("--out", simulate.out, "Folder for tables, proof and picture");
  line.negative_flag("--no-figures", simulate.figures, "Tables and proof only");
  line.flag("--animate", simulate.animate,
            "Also the run over time, simulation.html: a page for any browser (docs/howto/look.md)");
  line.flag("--certificate", simulate.certificate,
            "Also what proves that bodies stay apart, certificate.json, for programs that check it "
            "(docs/reference/certificates.md)");
  line.flag("--glb", simulate.glb,
            "Also the run as simulation.glb, animated binary glTF for viewers (docs/reference/scenarios.md)");
  line.flag("--quiet", simulate.quiet, "No progress");
  line.flag("--json", simulate.json, "Print JSON");
  line.read();
  simulate.command_line = line.text();
  return run_simulate(simulate, std::cout);
}

}  // namespace vericone
