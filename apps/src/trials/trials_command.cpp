// SPDX-License-Identifier: BSD-3-Clause
#include "trials/trials_command.h"

#include <vericone/geometry/error.h>
#include <vericone/internal/simulation/montecarlo/flight.h>
#include <vericone/internal/simulation/trials.h>
#include <vericone/simulation/montecarlo/campaign.h>
#include <vericone/simulation/trials.h>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>
#include <ostream>
#include <sstream>

#include "input/stopwatch.h"
#include "json/json_value.h"
#include "output/figures.h"
#include "output/file_hash.h"
#include "output/interrupt.h"
#include "output/output_file.h"
#include "output/provenance.h"
#include "output/resumable_table.h"
#include "output/staged_folder.h"
#include "output/threads.h"
#include "scenarios/read_scenario.h"

namespace vericone::trials {
namespace {

namespace fs = std::filesystem;
using namespace simulation;

/// A law at a level: one group of columns.
struct Cell {
  TrialLevel level;
  TrialLaw law;
  Scenario scenario;
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
      Cell& cell = cells.emplace_back(Cell{trial_level(level), trial_law(law), {}});
      cell.scenario = trial_scenario(scenario, cell.law, cell.level);
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

TrialOutcome fly(const Cell& cell, std::uint64_t trial, bool random) {
  return fly_trial(random ? with_random_bodies(cell.scenario, trial) : cell.scenario, trial);
}

/// What became of it.
std::string word_of(const TrialOutcome& outcome) {
  const bool missed = outcome.verdict == ProofVerdict::avoided && outcome.missed;
  return missed ? to_string(PassageVerdict::missed) : to_string(outcome.verdict);
}

std::string header_of(const std::vector<Cell>& cells) {
  std::string header = "trial";
  for (const Cell& cell : cells) {
    const std::string name = cell.level.name + " " + to_string(cell.law);
    header += "," + name + "," + name + " least distance [m]," + name + " effort [m/s]";
  }
  return header;
}

std::string row_of(const std::vector<Cell>& cells, std::uint64_t trial, bool random) {
  std::string row = std::to_string(trial);
  for (const Cell& cell : cells) {
    const TrialOutcome o = fly(cell, trial, random);
    const bool avoided = o.verdict == ProofVerdict::avoided;
    row += "," + word_of(o) + "," + (avoided ? to_text(o.least_distance) : "") + "," + to_text(o.effort);
  }
  return row;
}

/// What became of the trials of a cell.
struct Column {
  std::unique_ptr<bool[]> avoided;
  std::uint64_t count = 0, touched = 0, undecided = 0, missed = 0;
  double effort = 0, distance = 0;  // sums
};

std::vector<Column> read_rows(const fs::path& file, std::size_t cells, std::uint64_t trials) {
  std::vector<Column> columns(cells);
  for (Column& column : columns) column.avoided = std::make_unique<bool[]>(trials);
  std::ifstream in(file);
  std::string line, verdict, distance, effort;
  std::getline(in, line);  // settings
  std::getline(in, line);  // header
  for (std::uint64_t i = 0; i < trials && std::getline(in, line); ++i) {
    std::istringstream fields(line);
    std::getline(fields, verdict, ',');  // the trial
    for (Column& column : columns) {
      std::getline(fields, verdict, ',');
      std::getline(fields, distance, ',');
      std::getline(fields, effort, ',');
      column.avoided[i] = verdict == to_string(ProofVerdict::avoided);
      column.count += column.avoided[i];
      column.touched += verdict == to_string(ProofVerdict::touched);
      column.undecided += verdict == to_string(ProofVerdict::undecided);
      column.missed += verdict == to_string(PassageVerdict::missed);
      column.effort += std::stod(effort);
      if (column.avoided[i]) column.distance += std::stod(distance);
    }
  }
  return columns;
}

Json summarise(const TrialsOptions& o, const std::vector<Cell>& cells, const std::vector<Column>& columns) {
  Json shares = Json::array(), pairs = Json::array();
  const double n = double(o.trials);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Column& c = columns[i];
    const Share share = share_of(c.count, o.trials);
    shares.push_back({{"level", cells[i].level.name},
                      {"law", to_string(cells[i].law)},
                      {"share", share.share},
                      {"low", share.low},
                      {"high", share.high},
                      {"avoided", c.count},
                      {"touched", c.touched},
                      {"undecided", c.undecided},
                      {"effort", c.effort / n},
                      {"least_distance", c.count ? Json(c.distance / double(c.count)) : Json(nullptr)}});
    if (!cells[i].scenario.orifices.empty()) shares.back()["missed"] = c.missed;
    for (std::size_t j = i + 1; j < cells.size() && cells[j].level.name == cells[i].level.name; ++j) {
      const Paired p = paired({c.avoided.get(), o.trials}, {columns[j].avoided.get(), o.trials});
      pairs.push_back({{"level", cells[i].level.name},
                       {"first", to_string(cells[i].law)},
                       {"second", to_string(cells[j].law)},
                       {"first_alone", p.first_alone},
                       {"second_alone", p.second_alone},
                       {"chance", p.chance}});
    }
  }
  return {{"trials", o.trials}, {"confidence", 0.95}, {"shares", shares}, {"paired", pairs}};
}

void print_summary(const Json& summary, std::ostream& out) {
  char line[160];
  out << summary["trials"].get<std::uint64_t>() << " trials a level and law, proved\n"
      << "  level       law           avoided   interval (95 %)      touched  undecided   effort\n"
      << "                                                                              m/s\n";
  for (const Json& s : summary["shares"]) {
    std::snprintf(line, sizeof line, "  %-11s %-12s %7.1f %%  %5.1f to %5.1f %% %10llu %10llu  %7.3g\n",
                  s["level"].get<std::string>().c_str(), s["law"].get<std::string>().c_str(),
                  100 * s["share"].get<double>(), 100 * s["low"].get<double>(), 100 * s["high"].get<double>(),
                  static_cast<unsigned long long>(s["touched"].get<std::uint64_t>()),
                  static_cast<unsigned long long>(s["undecided"].get<std::uint64_t>()),
                  s["effort"].get<double>());
    out << line;
    if (s.value("missed", 0) > 0)
      out << "                           and " << s["missed"].get<std::uint64_t>()
          << " that missed an opening\n";
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
  }
  if (o.json) {
    out << results.dump(1) << '\n';
    return 0;
  }
  for (const Json& r : results) {
    char line[120];
    std::snprintf(line, sizeof line, "%-11s %-12s %-10s effort %.4g m/s",
                  r["level"].get<std::string>().c_str(), r["law"].get<std::string>().c_str(),
                  r["verdict"].get<std::string>().c_str(), r["effort"].get<double>());
    out << line;
    if (r["least_distance"].is_number()) {
      std::snprintf(line, sizeof line, ", apart by %.4g m or more", r["least_distance"].get<double>());
      out << line;
    }
    out << '\n';
  }
  return 0;
}

}  // namespace

int run_trials(const TrialsOptions& given, std::ostream& out) {
  if (given.trials < 1 || given.trials > 10'000'000)
    throw InputError("--trials", std::to_string(given.trials), "between 1 and 10000000");
  const Scenario scenario = scenario::read_scenario(given.scenario);
  const TrialsOptions options = complete(given, scenario);
  const std::vector<Cell> cells = cells_of(options, scenario);
  if (options.trial) return print_one(options, cells, out);
  StagedFolder folder(options.out, "--out");
  const auto start = Clock::now();
  ResumableTable table{folder, "trials.csv"};
  table.settings = "# vericone trials, " + fs::path(options.scenario).filename().string() + " " +
                   sha256_of_file(options.scenario) + ", seed " + std::to_string(cells[0].scenario.seed) +
                   ", " + std::to_string(options.trials) + " trials, levels " + joined(options.levels) +
                   ", laws " + joined(options.laws) + (options.random ? ", random engagements" : "");
  table.header = header_of(cells);
  table.count = options.trials;
  table.threads = threads_for(options.threads);
  table.quiet = options.quiet;
  table.label = "trials";
  table.block = 10;
  table.row = [&](std::uint64_t i) { return row_of(cells, i, options.random); };
  if (run_table(table) == TableOutcome::interrupted) {
    out << "interrupted; the same command goes on where it stopped (" << options.out << ")\n";
    return kExitInterrupted;
  }
  const double seconds = seconds_since(start);
  Json summary =
      summarise(options, cells, read_rows(folder.resumable(table.name), cells.size(), options.trials));
  summary["scenario"] = scenario.name;
  summary["settings"] = table.settings;
  summary["seconds"] = seconds;
  write_whole(folder.path() / "trials.json", summary.dump(1) + "\n");
  write_whole(folder.path() / "provenance.json",
              provenance(options.command_line, table.threads, {options.scenario}).dump(1) + "\n");
  if (options.figures) draw_figures("trials.py", folder.path());
  const std::vector<fs::path> files = folder.publish({"trials.pdf", "trials.png"});
  if (options.json) {
    out << summary.dump(1) << '\n';
    return 0;
  }
  print_summary(summary, out);
  if (!noisy(cells)) out << "no pilot has a sensor: all trials are the same flight\n";
  const fs::path shown = options.out;
  out << "tables    " << (shown / table.name).string() << ", " << (shown / "trials.json").string() << '\n';
  for (const fs::path& picture : pictures_of(files)) out << "picture   " << picture.string() << '\n';
  return 0;
}

}  // namespace vericone::trials
