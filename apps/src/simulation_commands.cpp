// SPDX-License-Identifier: BSD-3-Clause
#include "simulation_commands.h"

#include <vericone/geometry/error.h>
#include <iostream>

#include "montecarlo/campaign_command.h"
#include "paper/claims_command.h"
#include "paper/figures_command.h"
#include "simulate/simulate_command.h"

namespace vericone {
namespace {

// Options are static: CLI11 writes to them while it parses.

void add_simulate(CLI::App& app, const std::string& command_line, int& status) {
  static SimulateOptions simulate;
  auto* simulate_command =
      app.add_subcommand("simulate", "A scenario of moving bodies, with a proof of what was avoided");
  simulate_command->add_option("scenario", simulate.scenario, "Scenario file, YAML (docs/scenarios.md)")
      ->required();
  simulate_command->add_option("--out", simulate.out, "Folder for tables, proof and picture")
      ->capture_default_str();
  static bool no_simulate_figure = false;
  simulate_command->add_flag("--no-figures", no_simulate_figure, "Tables and proof only");
  simulate_command->add_flag("--quiet", simulate.quiet, "No progress");
  simulate_command->add_flag("--json", simulate.json, "Print JSON");
  simulate_command->callback([&status, command_line] {
    simulate.figures = !no_simulate_figure;
    simulate.command_line = command_line;
#ifdef VERICONE_HAVE_SIMULATION
    status = run_simulate(simulate, std::cout);
#else
    throw InputError("simulate", "a command without simulation", "a build with VERICONE_SIMULATION");
#endif
  });
}

void add_claims(CLI::App& app, const std::string& command_line, int& status) {
  static ClaimsOptions claims;
  auto* claims_command =
      app.add_subcommand("claims", "What the source prints in chapters 5 and 6 beside what is measured");
  claims_command->add_option("--out", claims.out, "Also write claims.json to this folder")->default_str("");
  claims_command->add_flag("--json", claims.json, "Print JSON");
  claims_command->add_flag("--given", claims.given, "Also list the printed values that go into the runs");
  claims_command->add_flag("--quiet", claims.quiet, "No progress");
  claims_command->callback([&status, command_line] {
    claims.command_line = command_line;
#ifdef VERICONE_HAVE_SIMULATION
    status = run_claims(claims, std::cout);
#else
    throw InputError("claims", "a command without simulation", "a build with VERICONE_SIMULATION");
#endif
  });
}

void add_figures(CLI::App& app, const std::string& command_line, int& status) {
  static FiguresOptions figures;
  auto* figures_command =
      app.add_subcommand("figures", "The figures of the source's chapters 5 and 6, with a report");
  figures_command->add_option("figures", figures.ids, "Their numbers (docs/papers.md); all if not given");
  figures_command->add_option("--out", figures.out, "Folder for pictures, tables and report")
      ->capture_default_str();
  figures_command->add_flag("--list", figures.list, "Print numbers and captions, make nothing");
  figures_command->add_flag("--quiet", figures.quiet, "No progress");
  figures_command->callback([&status, command_line] {
    figures.command_line = command_line;
#ifdef VERICONE_HAVE_SIMULATION
    status = run_figures(figures, std::cout);
#else
    throw InputError("figures", "a command without simulation", "a build with VERICONE_SIMULATION");
#endif
  });
}

void add_campaign(CLI::App& app, const std::string& command_line, int& status) {
  static montecarlo::CampaignOptions campaign;
  auto* campaign_command = app.add_subcommand(
      "campaign", "Guidance laws on random engagements, every outcome proved; 1: a word broken");
  campaign_command->add_option("--out", campaign.out, "Folder for tables and picture")->capture_default_str();
  campaign_command->add_option("-N,--engagements", campaign.engagements, "Random engagements")
      ->capture_default_str();
  campaign_command->add_option("--seed", campaign.seed, "Seed of all random numbers")->capture_default_str();
  campaign_command->add_option("--threads", campaign.threads, "Threads, 0: one per processor")
      ->capture_default_str();
  campaign_command
      ->add_option("--laws", campaign.laws,
                   "slice, exact (largest opening), motion (true sector on the plane of motion), clearance")
      ->delimiter(',')
      ->capture_default_str();
  campaign_command->add_option("--most", campaign.most, "Saturation, m/s^2; every law also flies without")
      ->capture_default_str();
  campaign_command->add_option("--gain", campaign.gain, "K of all laws, 1/s")->capture_default_str();
  campaign_command->add_option("--reference", campaign.reference, "w, to which y is driven")
      ->capture_default_str();
  campaign_command->add_option("--required", campaign.required, "Of the clearance law, metres")
      ->capture_default_str();
  campaign_command->add_option("--step", campaign.step, "Between two commands, s")->capture_default_str();
  static bool no_campaign_figure = false;
  campaign_command->add_flag("--no-figures", no_campaign_figure, "Tables only");
  campaign_command->add_flag("--quiet", campaign.quiet, "No progress");
  campaign_command->add_flag("--json", campaign.json, "Print JSON");
  campaign_command->callback([&status, command_line] {
    campaign.figures = !no_campaign_figure;
    campaign.command_line = command_line;
#ifdef VERICONE_HAVE_SIMULATION
    status = montecarlo::run_campaign(campaign, std::cout);
#else
    throw InputError("campaign", "a command without simulation", "a build with VERICONE_SIMULATION");
#endif
  });
}

}  // namespace

void add_simulation_commands(CLI::App& app, const std::string& command_line, int& status) {
  add_simulate(app, command_line, status);
  add_campaign(app, command_line, status);
  add_claims(app, command_line, status);
  add_figures(app, command_line, status);
}

}  // namespace vericone
