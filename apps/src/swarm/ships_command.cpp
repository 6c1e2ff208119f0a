// SPDX-License-Identifier: BSD-3-Clause
#include "swarm/ships_command.h"

#include <vericone/geometry/error.h>
#include <vericone/ships/ships.h>
#include <vericone/work/staged_folder.h>
#include <algorithm>
#include <cmath>
#include <ostream>

#include "job/job.h"
#include "json/json_value.h"
#include "output/number_text.h"
#include "output/output_file.h"
#include "output/progress.h"
#include "work/interrupt.h"
#include "work/provenance.h"

namespace vericone::ships {
namespace {

std::string row(std::initializer_list<std::string> entries) {
  std::string text;
  for (const std::string& entry : entries) text.append(text.empty() ? "" : ",").append(entry);
  return text + "\n";
}

std::string positions_csv(const Voyage& voyage) {
  std::string text = "t,ship,x,y,heading,speed\n";
  for (const ShipSample& sample : voyage.samples)
    for (std::size_t i = 0; i < sample.positions.size(); ++i)
      text += row({to_text(sample.t), std::to_string(i), to_text(sample.positions[i].x()),
                   to_text(sample.positions[i].y()), to_text(sample.headings[i]), to_text(sample.speeds[i])});
  return text;
}

std::string ships_csv(const std::vector<Ship>& ships, const Voyage& voyage) {
  std::string text =
      "ship,length,beam,domain_ahead,domain_abeam,center_ahead,center_port,goal_x,goal_y,arrived,path\n";
  for (std::size_t i = 0; i < ships.size(); ++i) {
    const Ship& ship = ships[i];
    text += row({std::to_string(i), to_text(ship.handling.length), to_text(ship.handling.beam),
                 to_text(ship.domain.half.x()), to_text(ship.domain.half.y()),
                 to_text(ship.domain.center.x()), to_text(ship.domain.center.y()), to_text(ship.goal.x()),
                 to_text(ship.goal.y()), to_text(voyage.arrived[i]), to_text(voyage.path[i])});
  }
  return text;
}

/// Words without the comma of a table.
std::string word(Encounter encounter) {
  std::string text = to_string(encounter);
  std::erase(text, ',');
  return text;
}

std::string pairs_csv(const Voyage& voyage) {
  std::string text =
      "a,b,tcpa,dcpa,starts_as,encounter,seen,passed,risk_when_nearest,side_kept,stand_on_acted,stand_on_"
      "turned,nearest,"
      "least_domain_distance,verdict\n";
  for (const PairOfShips& pair : voyage.pairs)
    text += row({std::to_string(pair.a), std::to_string(pair.b), to_text(pair.at_start.time),
                 to_text(pair.at_start.distance), word(pair.starts_as), word(pair.encounter),
                 to_text(pair.seen), to_string(pair.passed), pair.risk_when_nearest ? "1" : "0",
                 pair.side_kept ? "1" : "0", pair.stand_on_acted ? "1" : "0", to_text(pair.stand_on_turned),
                 to_text(pair.nearest), to_text(pair.least_domain_distance), to_string(pair.verdict)});
  return text;
}

Json pairs_json(const Voyage& voyage) {
  Json all = Json::array();
  for (const PairOfShips& pair : voyage.pairs)
    all.push_back({{"a", pair.a},
                   {"b", pair.b},
                   {"tcpa", pair.at_start.time},
                   {"dcpa", pair.at_start.distance},
                   {"starts_as", to_string(pair.starts_as)},
                   {"encounter", to_string(pair.encounter)},
                   {"seen", pair.seen < 0 ? Json(nullptr) : Json(pair.seen)},
                   {"passed", to_string(pair.passed)},
                   {"risk_when_nearest", pair.risk_when_nearest},
                   {"side_kept", pair.side_kept},
                   {"stand_on_acted", pair.stand_on_acted},
                   {"stand_on_turned", pair.stand_on_turned},
                   {"nearest", pair.nearest},
                   {"least_domain_distance", pair.least_domain_distance},
                   {"verdict", simulation::to_string(pair.verdict)}});
  return all;
}

Json summary_of(const SwarmCommand& command, const FleetOptions& options, const Voyage& voyage) {
  double last = 0;
  std::size_t arrived = 0;
  for (const double t : voyage.arrived)
    if (std::isfinite(t)) {
      ++arrived;
      last = std::max(last, t);
    }
  double least = -1;
  std::size_t kept = 0, sides = 0;
  for (const PairOfShips& pair : voyage.pairs) {
    const bool proved = pair.verdict == simulation::ProofVerdict::avoided;
    kept += proved ? 1 : 0;
    sides += pair.side_kept ? 0 : 1;
    if (proved) least = least < 0 ? pair.least_domain_distance : std::min(least, pair.least_domain_distance);
  }
  return {{"start", command.start},
          {"ships", voyage.arrived.size()},
          {"step", options.step},
          {"current", {options.current.x(), options.current.y()}},
          {"end", voyage.end},
          {"arrived", arrived},
          {"last_arrival", arrived == voyage.arrived.size() ? Json(last) : Json(nullptr)},
          {"pairs_kept", kept},
          {"sides_given_up", sides},
          {"least_domain_distance", least < 0 ? Json(nullptr) : Json(least)},
          {"commands", voyage.counts.commands},
          {"fallbacks", voyage.counts.fallbacks},
          {"pairs", pairs_json(voyage)}};
}

void print(const Json& summary, const Voyage& voyage, std::ostream& out) {
  const auto number = [&](const char* key) {
    return summary[key].is_null() ? std::string("-") : number_text(summary[key].get<double>(), 4);
  };
  const auto count = [&](const char* key) { return std::to_string(summary[key].get<std::uint64_t>()); };
  const bool all_kept = summary["pairs_kept"] == voyage.pairs.size();
  out << "ships     " << summary["start"].get<std::string>() << ", " << count("ships") << " ships\n"
      << "domains   " << count("pairs_kept") << " of " << voyage.pairs.size() << " pairs kept"
      << (summary["least_domain_distance"].is_null()
              ? std::string("\n")
              : std::string(all_kept ? ", " : "; of these ") + "no hull nearer to a domain than " +
                    at_least_text(summary["least_domain_distance"].get<double>(), 4) + " m: proved\n");
  for (const PairOfShips& pair : voyage.pairs)
    out << "          " << pair.a << " and " << pair.b << ": "
        << (pair.encounter == Encounter::none ? std::string("no risk") : to_string(pair.encounter)) << ", "
        << (pair.passed == Side::port ? "port to port, " : "starboard to starboard, ")
        << (pair.verdict == simulation::ProofVerdict::avoided
                ? at_least_text(pair.least_domain_distance, 4) + " m"
                : std::string(simulation::to_string(pair.verdict)))
        << (pair.side_kept ? "" : ", the rules' side given up")
        << (pair.stand_on_acted ? ", who stands on had to act" : "") << '\n';
  out << "arrived   " << count("arrived") << " of " << count("ships") << ", the last after "
      << number("last_arrival") << " s\n"
      << "commands  " << count("commands") << ", of them " << count("fallbacks") << " fallbacks\n";
}

void refuse_what_ships_have_not(const SwarmCommand& command) {
  const auto refuse = [&](const char* name, const std::string& value, const char* requirement) {
    throw InputError(name, value, requirement + command.start);
  };
  if (command.agents != 0) refuse("--agents", std::to_string(command.agents), "left out with ");
  if (command.method != "proved") refuse("--method", command.method, "proved with ");
  if (command.lost != 0) refuse("--lost", to_text(command.lost), "left out with ");
  if (!command.current.empty() && command.current.size() != 2)
    throw InputError("--current", std::to_string(command.current.size()) + " numbers",
                     "two: EAST,NORTH (m/s)");
}

}  // namespace

bool is_of_ships(const std::string& start) {
  const std::vector<std::string>& names = encounter_names();
  return std::find(names.begin(), names.end(), start) != names.end();
}

int run_ships(const SwarmCommand& command, std::ostream& out) {
  refuse_what_ships_have_not(command);
  const std::vector<Ship> ships = ships_of(command.start);
  FleetOptions options;
  VoyageOptions sailed;
  if (command.step) options.step = *command.step;
  if (command.duration) sailed.duration = *command.duration;
  if (command.sample) sailed.sample = *command.sample;
  if (!command.current.empty()) options.current = {command.current[0], command.current[1]};
  work::StagedFolder folder(command.out, "--out");
  Progress progress(command.quiet);
  sailed.progress = [&](double share) { return progress.show("sailing " + command.start, share); };
  const Voyage voyage = [&] {
    try {
      return sail(ships, options, sailed);
    } catch (const InputError& error) {
      for (const char* name : {"step", "duration", "sample", "current"})
        if (error.field() == name)
          throw InputError(std::string("--") + name, error.value(), error.requirement());
      throw;
    }
  }();
  if (voyage.interrupted) return kExitInterrupted;
  write_whole(folder.path() / "positions.csv", positions_csv(voyage));
  write_whole(folder.path() / "ships.csv", ships_csv(ships, voyage));
  write_whole(folder.path() / "pairs.csv", pairs_csv(voyage));
  Results results;
  results.summary = summary_of(command, options, voyage);
  results.origin = provenance(command.command_line, 1, {});
  results.scripts = {"ships.py"};
  results.files = {"positions.csv", "ships.csv", "pairs.csv", "summary.json"};
  results.old = {"ships.pdf", "ships.png"};
  print(results.summary, voyage, results.text);
  results.status = voyage.kept() ? 0 : 1;
  return publish(results, command, folder, out);
}

}  // namespace vericone::ships
