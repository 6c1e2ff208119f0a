// SPDX-License-Identifier: BSD-3-Clause
#include "commands.h"

#include <iostream>

#include "campaign/campaign_command.h"
#include "check/check_command.h"
#include "paper/claims_command.h"
#include "paper/figures_command.h"
#include "paper/new_paper.h"
#include "reach/reach_command.h"
#include "simulate/simulate_command.h"
#include "trials/trials_command.h"

namespace vericone {
namespace {

int simulate_command(CommandLine& line) {
  SimulateOptions simulate;
  line.option("scenario", simulate.scenario, "Scenario file, YAML (docs/reference/scenarios.md)").required();
  line.option("--out", simulate.out, "Folder for tables, proof and picture");
  line.negative_flag("--no-figures", simulate.figures, "Tables and proof only");
  line.flag("--animate", simulate.animate, "Also the run over time, simulation.html: a page for any browser");
  line.flag("--quiet", simulate.quiet, "No progress");
  line.flag("--json", simulate.json, "Print JSON");
  line.read();
  simulate.command_line = line.text();
  return run_simulate(simulate, std::cout);
}

int check_command(CommandLine& line) {
  std::string file;
  line.option("file", file,
              "Scene, scenario, body, figures or claims, YAML (docs/reference/formats.md, "
              "docs/reference/scenarios.md, docs/reference/papers.md)")
      .required();
  bool json = false;
  line.flag("--json", json, "Print JSON: labels with their texts");
  line.quiet();
  line.read();
  return run_check(file, json, std::cout);
}

int reach_command(CommandLine& line) {
  ReachOptions reach;
  line.option("scenario", reach.scenario, "Scenario file, YAML: an agent or more with `through`").required();
  line.flag(
      "--current", reach.current,
      "Also the largest current with which every passage is still proved: of the run as recorded, and of "
      "vehicles flown again in currents (sampled)");
  line.option("--directions", reach.directions, "Horizontal directions of currents to fly again in")
      .within(1, 360);
  line.option("--runs", reach.runs, "Runs in each").within(1, 100);
  line.flag("--quiet", reach.quiet, "No progress");
  line.flag("--json", reach.json, "Print JSON");
  line.read();
  return run_reach(reach, std::cout);
}

int trials_command(CommandLine& line) {
  trials::TrialsOptions trials;
  line.option("scenario", trials.scenario, "Scenario file, YAML").required();
  line.option("-N,--trials", trials.trials, "Trials of every law at every level");
  line.option(
          "--levels", trials.levels,
          "Noise: percent of position and of velocity, 7.5:15, or the scenario's sensors times a number, x4")
      .commas()
      .shown_default("5:10,7.5:15,10:20 of one pilot that avoids, otherwise x1");
  line.option(
          "--laws", trials.laws,
          "di, di-filter, rdi, rdi-filter, di-rates, di-analytic, di-state, di-margin, clearance, robust, "
          "own (as the scenario has them)")
      .commas()
      .shown_default("di,di-filter,rdi,rdi-filter of one pilot that avoids, otherwise own");
  line.option("--seed", trials.seed, "Seed of all noise").shown_default("that of the scenario");
  line.option("--trial", trials.trial, "This trial alone, printed");
  line.flag("--random", trials.random,
            "Another random engagement each trial, in place of the scenario's bodies");
  line.option("--out", trials.out, "Folder for tables and picture");
  line.option("--threads", trials.threads, "Threads, 0: one per processor");
  line.negative_flag("--no-figures", trials.figures, "Tables only");
  line.flag("--quiet", trials.quiet, "No progress");
  line.flag("--json", trials.json, "Print JSON");
  line.read();
  trials.command_line = line.text();
  return vericone::trials::run_trials(trials, std::cout);
}

int campaign_command(CommandLine& line) {
  montecarlo::CampaignOptions campaign;
  line.option("--out", campaign.out, "Folder for tables and picture");
  line.option("-N,--engagements", campaign.engagements, "Random engagements");
  line.option("--seed", campaign.seed, "Seed of all random numbers");
  line.option("--threads", campaign.threads, "Threads, 0: one per processor");
  line.option("--laws", campaign.laws,
              "slice, exact (largest opening), motion (true sector on the plane of motion), clearance")
      .commas();
  line.option("--most", campaign.most, "Saturation, m/s^2; every law also flies without");
  line.option("--gain", campaign.gain, "K of all laws, 1/s");
  line.option("--reference", campaign.reference, "w, to which y is driven");
  line.option("--required", campaign.required, "Of the clearance law, metres");
  line.option("--step", campaign.step, "Between two commands, s");
  line.negative_flag("--no-figures", campaign.figures, "Tables only");
  line.flag("--quiet", campaign.quiet, "No progress");
  line.flag("--json", campaign.json, "Print JSON");
  line.read();
  campaign.command_line = line.text();
  return montecarlo::run_campaign(campaign, std::cout);
}

int claims_command(CommandLine& line) {
  paper::ClaimsOptions claims;
  line.option("claims", claims.ids, "Of these claims or sections, such as 5.4.1 or 7; all if not given");
  line.option("--paper", claims.paper,
              "Its folder, or the name of one of ours; papers/dhal2022 if not given");
  line.option("--out", claims.out, "Also write claims.json to this folder");
  line.flag("--json", claims.json, "Print JSON");
  line.flag("--given", claims.given, "Also list the printed values that go into the runs");
  line.option("--shuffle", claims.shuffle,
              "Draw the chosen numbers so often from their ranges: what holds throughout, what at one place")
      .within(0, 100000);
  line.option("--only", claims.only, "Shuffle the numbers of this fit alone").one_each();
  line.option("--seed", claims.seed, "Of the draws");
  line.flag("--quiet", claims.quiet, "No progress");
  line.read();
  claims.command_line = line.text();
  return paper::run_claims(claims, std::cout);
}

int figures_command(CommandLine& line) {
  paper::FiguresOptions figures;
  line.option("figures", figures.ids, "Their numbers (docs/reference/papers.md); all if not given");
  line.option("--paper", figures.paper,
              "Its folder, or the name of one of ours; papers/dhal2022 if not given");
  line.option("--out", figures.out,
              "Folder for pictures, tables and report; out/ and the paper's name if not given");
  line.option("--scenario", figures.scenario, "Scenario file in place of the one that these figures show");
  line.option("--set", figures.set, "PATH=VALUE changes a field of their scenarios: bodies.F1.pilot.gain=8")
      .one_each();
  line.flag("--list", figures.list, "Print numbers and captions, make nothing");
  line.flag("--quiet", figures.quiet, "No progress");
  line.flag("--json", figures.json, "Print JSON: figures and the files of the report");
  line.read();
  figures.command_line = line.text();
  return paper::run_figures(figures, std::cout);
}

int paper_command(CommandLine& line) {
  std::string what, folder;
  line.option("what", what, "new: a small paper that works, to begin with (docs/reference/papers.md)")
      .required();
  line.option("folder", folder, "Where it is to be: a folder that is empty or not there").required();
  line.quiet();
  line.read();
  if (what != "new")
    throw UsageError("paper: " + what + " is not known, new DIR is; see vericone paper --help");
  return paper::new_paper(folder, std::cout);
}

}  // namespace

std::map<std::string, Command> simulation_commands() {
  return {{"check", check_command},       {"reach", reach_command},   {"simulate", simulate_command},
          {"campaign", campaign_command}, {"trials", trials_command}, {"claims", claims_command},
          {"figures", figures_command},   {"paper", paper_command}};
}

}  // namespace vericone
