// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/internal/simulation/montecarlo/flight.h>
#include <vericone/internal/simulation/trials.h>
#include <vericone/simulation/montecarlo/campaign.h>
#include <vericone/simulation/run_tables.h>
#include <vericone/simulation/trials.h>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "command/output_line.h"
#include "commands.h"
#include "job/job.h"
#include "json/json_value.h"
#include "output/number_text.h"
#include "output/output_file.h"
#include "scenarios/read_scenario.h"
#include "trials/encounter_trials.h"
#include "work/file_hash.h"

namespace vericone::trials {
namespace {

namespace fs = std::filesystem;
using namespace simulation;

struct TrialsOptions : OutputOptions {
  TrialsOptions() { out = "out/trials"; }
  std::string scenario;
  std::uint64_t trials = 1000;
  bool trials_given = false;
  std::vector<std::string> levels, laws;  // none: as complete() says
  std::optional<std::uint64_t> seed;      // otherwise the scenario's
  std::optional<std::uint64_t> trial;     // this one alone: nothing is written
  bool random = false;     // another random engagement each trial in place of the scenario's bodies
  std::string encounters;  // a file of them, flown in place of the scenario's
  std::vector<std::string> volumes{"500 ft:100 ft"};  // around agents, entered or not
};

/// A law at a level: one group of columns.
struct Cell {
  TrialLevel level;
  TrialLaw law;
  Scenario scenario;
  bool equipped = true;  // otherwise no pilot flies
  std::string name = {};
};

/// What is flown where no options say it: the source's laws and levels where they have one pilot to change,
/// otherwise the scenario as it is.
TrialsOptions complete(TrialsOptions options, const Scenario& scenario) {
  std::size_t pilots = 0, avoids = 0;
  for (const simulation::Body& body : scenario.bodies) {
    pilots += body.pilot.has_value();
    avoids += body.pilot && minds_bodies(*body.pilot) && body.pilot->guide.law == guidance::Law::avoidance;
  }
  const bool source = pilots == 1 && avoids == 1;
  if (options.laws.empty())
    options.laws = source ? std::vector<std::string>{"di", "di-filter", "rdi", "rdi-filter"}
                          : std::vector<std::string>{to_string(TrialLaw::own)};
  if (options.levels.empty())
    options.levels =
        source ? std::vector<std::string>{"5:10", "7.5:15", "10:20"} : std::vector<std::string>{"x1"};
  return options;
}

/// As tables and summaries have it.
const char* law_of(const Cell& cell) { return cell.equipped ? to_string(cell.law) : "none"; }

std::vector<Cell> cells_of(const TrialsOptions& o, Scenario scenario) {
  if (o.seed) scenario.seed = *o.seed;
  const auto once = [](const std::vector<std::string>& words, const char* option) {
    for (const std::string& word : words)
      if (std::count(words.begin(), words.end(), word) > 1) throw InputError(option, word, "given once");
  };
  once(o.levels, "--levels");
  once(o.laws, "--laws");
  std::vector<Cell> cells;
  for (const std::string& level : o.levels)
    for (const std::string& law : o.laws) {
      Cell& cell = cells.emplace_back(Cell{trial_level(level), trial_law(law), {}, true, {}});
      cell.scenario = trial_scenario(scenario, cell.law, cell.level);
      cell.name = cell.level.name + " " + to_string(cell.law);
    }
  if (o.random) {
    const bool two = scenario.bodies.size() == 2 && !planar(scenario.bodies[0].shape);
    if (!two)
      throw InputError("--random", o.scenario,
                       "a scenario of two bodies in space: an agent and its obstacle");
  }
  return cells;
}

/// The scenario with the bodies of a random engagement, until they have passed.
Scenario with_random_bodies(Scenario scenario, std::uint64_t trial) {
  const montecarlo::Encounter encounter = montecarlo::random_encounter(scenario.seed, trial);
  const std::size_t agent = scenario.bodies[0].pilot ? 0 : 1;
  for (const auto& [from, to] :
       {std::pair(&encounter.agent, agent), std::pair(&encounter.obstacle, 1 - agent)}) {
    simulation::Body& body = scenario.bodies[to];
    body.shape = from->shape;
    body.start = from->start;
    body.orientation = from->orientation;
    body.appears = 0;
  }
  scenario.duration = 2 * encounter.scale();
  return scenario;
}

bool noisy(const std::vector<Cell>& cells) {
  return std::any_of(cells.begin(), cells.end(), [](const Cell& cell) {
    return std::any_of(cell.scenario.bodies.begin(), cell.scenario.bodies.end(),
                       [](const simulation::Body& body) { return body.pilot && body.pilot->sensor; });
  });
}

/// Says how many trials there are, and adds the cell without any law before the others. Throws InputError
/// naming the option.
std::optional<Encounters> encounters_of(TrialsOptions& o, const Scenario& scenario,
                                        std::vector<Cell>& cells) {
  if (o.encounters.empty()) return std::nullopt;
  if (o.random) throw InputError("--random", "given", "left out beside --encounters");
  if (o.trial) throw InputError("--trial", std::to_string(*o.trial), "left out beside --encounters");
  Encounters with{encounters::read_encounters(o.encounters, cells[0].scenario), {}, o.encounters};
  for (const std::string& volume : o.volumes)
    with.volumes.push_back(encounters::volume_of(volume, "--volumes"));
  if (with.volumes.empty())
    throw InputError("--volumes", "nothing", "one volume or more, such as 500 ft:100 ft");
  if (std::none_of(scenario.bodies.begin(), scenario.bodies.end(),
                   [](const auto& b) { return b.pilot.has_value(); }))
    throw InputError("bodies", "no pilot", "one body or more with a pilot, beside --encounters");
  if (!scenario.orifices.empty()) throw InputError("orifices", "given", "left out beside --encounters");
  if (with.set.count > 0) {
    if (o.trials_given && o.trials > with.set.count)
      throw InputError("--trials", std::to_string(o.trials),
                       "at most the file's " + std::to_string(with.set.count));
    if (!o.trials_given) o.trials = with.set.count;
  }
  Cell none = cells[0];
  none.equipped = false;
  none.name = "none";
  cells.insert(cells.begin(), none);
  return with;
}

std::vector<bool> agents_of(const Scenario& scenario) {
  std::vector<bool> agents;
  for (const simulation::Body& body : scenario.bodies) agents.push_back(body.pilot.has_value());
  return agents;
}

TrialOutcome fly(const Cell& cell, std::uint64_t trial, bool random) {
  return fly_trial(random ? with_random_bodies(cell.scenario, trial) : cell.scenario, trial);
}

/// What became of it.
std::string word_of(const TrialOutcome& outcome) {
  const bool missed = outcome.verdict == ProofVerdict::avoided && outcome.missed;
  return missed ? to_string(PassageVerdict::missed) : to_string(outcome.verdict);
}

std::string header_of(const std::vector<Cell>& cells, const std::optional<Encounters>& with) {
  std::string header = with ? "trial,weight" : "trial";
  for (const Cell& cell : cells) {
    header += "," + cell.name + "," + cell.name + " least distance [m]," + cell.name + " effort [m/s]";
    if (with) header += encounter_columns(cell.name, *with);
  }
  return header;
}

std::string cells_of(const TrialOutcome& o) {
  const bool avoided = o.verdict == ProofVerdict::avoided;
  return "," + word_of(o) + "," + (avoided ? to_text(o.least_distance) : "") + "," + to_text(o.effort);
}

std::string encounter_row(const std::vector<Cell>& cells, std::uint64_t trial, const Encounters& with) {
  const encounters::FlownEncounter encounter = with.set.at(trial);
  std::string row = std::to_string(trial) + "," + to_text(encounter.weight);
  RunOptions options;
  options.log = false;
  options.trial = trial;
  for (const Cell& cell : cells) {
    const Scenario flown = on_encounter(cell.scenario, encounter, cell.equipped);
    const Run run = simulate(flown, options);
    row += cells_of(outcome_of(flown, run)) + encounter_cells(flown, run, agents_of(cell.scenario), with);
  }
  return row;
}

std::string row_of(const std::vector<Cell>& cells, std::uint64_t trial, bool random) {
  std::string row = std::to_string(trial);
  for (const Cell& cell : cells) row += cells_of(fly(cell, trial, random));
  return row;
}

/// What became of the trials of a cell.
struct Found {
  const Cell* cell;
  std::unique_ptr<bool[]> proved;  // avoided, trial by trial
  Share share;
  std::uint64_t avoided = 0, touched = 0, undecided = 0, missed = 0;
  double effort = 0;                     // m/s, the mean
  std::optional<double> least_distance;  // m, the mean over those avoided
};

std::vector<Found> found_of(const simulation::Table& rows, const std::vector<Cell>& cells, std::size_t each,
                            std::size_t before) {
  const std::size_t trials = rows.rows();
  std::vector<Found> all;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const std::vector<std::string>& words = rows.columns[before + each * k].words;
    const std::vector<double>&distances = rows.columns[before + each * k + 1].numbers,
          &efforts = rows.columns[before + each * k + 2].numbers;
    Found& found =
        all.emplace_back(Found{&cells[k], std::make_unique<bool[]>(trials), {}, 0, 0, 0, 0, 0, {}});
    double distance = 0;
    for (std::size_t i = 0; i < trials; ++i) {
      found.proved[i] = words[i] == to_string(ProofVerdict::avoided);
      found.avoided += found.proved[i];
      found.touched += words[i] == to_string(ProofVerdict::touched);
      found.undecided += words[i] == to_string(ProofVerdict::undecided);
      found.missed += words[i] == to_string(PassageVerdict::missed);
      found.effort += efforts[i];
      if (found.proved[i]) distance += distances[i];
    }
    found.share = share_of(found.avoided, trials);
    found.effort /= double(trials);
    if (found.avoided) found.least_distance = distance / double(found.avoided);
  }
  return all;
}

Json to_json(const std::vector<Found>& all, std::uint64_t trials) {
  Json shares = Json::array(), pairs = Json::array();
  for (auto found = all.begin(); found != all.end(); ++found) {
    const Cell& cell = *found->cell;
    shares.push_back({{"level", cell.level.name},
                      {"law", law_of(cell)},
                      {"share", found->share.share},
                      {"low", found->share.low},
                      {"high", found->share.high},
                      {"avoided", found->avoided},
                      {"touched", found->touched},
                      {"undecided", found->undecided},
                      {"effort", found->effort},
                      {"least_distance", number_or_null(found->least_distance)}});
    if (!cell.scenario.orifices.empty()) shares.back()["missed"] = found->missed;
    for (auto other = found + 1; other != all.end() && other->cell->level.name == cell.level.name; ++other) {
      const Paired p = paired({found->proved.get(), trials}, {other->proved.get(), trials});
      pairs.push_back({{"level", cell.level.name},
                       {"first", law_of(cell)},
                       {"second", law_of(*other->cell)},
                       {"first_alone", p.first_alone},
                       {"second_alone", p.second_alone},
                       {"chance", p.chance}});
    }
  }
  return {{"trials", trials}, {"confidence", 0.95}, {"shares", shares}, {"paired", pairs}};
}

void print(const std::vector<Found>& all, std::uint64_t trials, std::ostream& out) {
  char line[160];
  out << trials << " trials a level and law, proved\n"
      << "  level       law           avoided   interval (95 %)      touched  undecided   effort\n"
      << "                                                                              m/s\n";
  for (const Found& found : all) {
    std::snprintf(line, sizeof line, "  %-11s %-12s %7.1f %%  %5.1f to %5.1f %% %10llu %10llu  %7.3g\n",
                  found.cell->level.name.c_str(), law_of(*found.cell), 100 * found.share.share,
                  100 * found.share.low, 100 * found.share.high,
                  static_cast<unsigned long long>(found.touched),
                  static_cast<unsigned long long>(found.undecided), found.effort);
    out << line;
    if (found.missed > 0)
      out << "                           and " << found.missed << " that missed an opening\n";
  }
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : "+") + word;
  return text;
}

int print_one(const TrialsOptions& o, const std::vector<Cell>& cells, std::ostream& out) {
  Json results = Json::array();
  for (const Cell& cell : cells) {
    const TrialOutcome outcome = fly(cell, *o.trial, o.random);
    const bool avoided = outcome.verdict == ProofVerdict::avoided;
    results.push_back({{"trial", *o.trial},
                       {"level", cell.level.name},
                       {"law", to_string(cell.law)},
                       {"verdict", word_of(outcome)},
                       {"least_distance", avoided ? Json(outcome.least_distance) : Json(nullptr)},
                       {"effort", outcome.effort}});
    if (o.json) continue;
    char line[120];
    std::snprintf(line, sizeof line, "%-11s %-12s %-10s effort %.4g m/s", cell.level.name.c_str(),
                  to_string(cell.law), word_of(outcome).c_str(), outcome.effort);
    out << line;
    if (avoided) out << ", apart by " << at_least_text(outcome.least_distance, 4) << " m or more";
    out << '\n';
  }
  if (o.json) out << results.dump(1) << '\n';
  return 0;
}

/// Shares of trials that are proved avoided (and all openings passed), by law and noise. Returns the exit
/// status, 130 interrupted. Throws InputError naming the option or the field.
int run_trials(const TrialsOptions& given, std::ostream& out) {
  if (given.trials < 1 || given.trials > 10'000'000)
    throw InputError("--trials", std::to_string(given.trials), "between 1 and 10000000");
  const Scenario scenario = scenario::read_scenario(given.scenario);
  TrialsOptions options = complete(given, scenario);
  std::vector<Cell> cells = cells_of(options, scenario);
  const std::optional<Encounters> with = encounters_of(options, scenario, cells);
  for (const auto& [name, value] : {std::pair("--part", options.part), std::pair("--rows", options.rows)})
    if (options.trial && !value.empty()) throw InputError(name, value, "left out with --trial");
  if (options.trial) return print_one(options, cells, out);
  work::ResumableTable table{"trials.csv"};
  table.settings = "# vericone trials, " + fs::path(options.scenario).filename().string() + " " +
                   sha256_of_file(options.scenario) + ", seed " + std::to_string(cells[0].scenario.seed) +
                   ", " + std::to_string(options.trials) + " trials, levels " + joined(options.levels) +
                   ", laws " + joined(options.laws) + (options.random ? ", random engagements" : "");
  if (with)
    table.settings += ", encounters " + fs::path(options.encounters).filename().string() + " " +
                      sha256_of_file(options.encounters) + ", volumes " + joined(options.volumes);
  table.header = header_of(cells, with);
  table.count = options.trials;
  table.block = 10;
  table.row = [&](std::uint64_t i) {
    return with ? encounter_row(cells, i, *with) : row_of(cells, i, options.random);
  };
  std::vector<fs::path> inputs{options.scenario};
  if (with) inputs.emplace_back(options.encounters);
  return run_job(
      {options, inputs, {{table, "trials"}}},
      [&](Results& results, work::StagedFolder& folder) {
        const fs::path file = folder.resumable(table.name);
        const simulation::Table rows = simulation::table_of_csv(content_of(file), file.filename().string());
        const std::vector<Found> found =
            found_of(rows, cells, with ? 6 + with->volumes.size() : 3, with ? 2 : 1);
        results.summary = to_json(found, options.trials);
        results.summary["scenario"] = scenario.name;
        results.summary["settings"] = table.settings;
        results.summary_file = "trials.json";
        results.scripts = {"trials.py"};
        results.files = {table.name, "trials.json"};
        results.old = {"trials.pdf", "trials.png"};
        print(found, options.trials, results.text);
        if (with) {
          std::vector<std::string> names;
          for (const Cell& cell : cells) names.push_back(cell.name);
          print_encounters(results.summary["encounters"] = encounters_json(rows, names, *with), results.text);
        } else if (!noisy(cells)) {
          results.text << "no pilot has a sensor: all trials are the same flight\n";
        }
      },
      out);
}

}  // namespace

}  // namespace vericone::trials

namespace vericone {

int trials_command(CommandLine& line) {
  trials::TrialsOptions trials;
  line.option("scenario", trials.scenario, "Scenario file, YAML").required();
  const auto count =
      line.option("-N,--trials", trials.trials,
                  "Trials of every law at every level; of a table of encounters all if left out");
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
  line.option(
      "--encounters", trials.encounters,
      "Encounters with weights, flown in place of the scenario's by every law and by none: a table, or a "
      "population (docs/reference/formats.md)");
  line.option("--volumes", trials.volumes,
              "Near misses: radius:half-height of upright cylinders about agents that no other is to enter")
      .commas();
  read_job_line(line, trials);
  trials.trials_given = count.given();
  return vericone::trials::run_trials(trials, std::cout);
}

}  // namespace vericone
