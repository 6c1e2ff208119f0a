// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/scenarios/scenario_files.h>
#include <vericone/swarm/swarm.h>
#include <vericone/work/staged_folder.h>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <map>
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
#include "output/progress.h"
#include "swarm/ships_command.h"
#include "work/interrupt.h"
#include "work/provenance.h"
#include "work/threads.h"

namespace vericone::swarm {
namespace {

/// A real building, scanned.
constexpr const char* kRoom = R"(name: room
bodies:
  - name: building
    shape: {octree: /usr/share/doc/liboctomap-dev/examples/data/geb079.bt, unknown: free}
    position: [0, 0, 0]
)";

bool is_named(const std::string& start) {
  const std::vector<std::string>& names = start_names();
  return std::find(names.begin(), names.end(), start) != names.end();
}

/// As many as the tables of docs/measured/swarms.md have.
std::uint64_t usual_agents(const std::string& start) {
  static const std::map<std::string, std::uint64_t> usual{{"sphere", 812},  {"crossing", 500}, {"gap", 200},
                                                          {"slender", 200}, {"turning", 200},  {"room", 50}};
  const auto found = usual.find(start);
  return found == usual.end() ? 100 : found->second;
}

/// By its name, or of a scenario's bodies; where these have no agent, agents are drawn amid them. What the
/// scenario says of step and duration goes to the command where that does not.
Start start_for(SwarmCommand& command) {
  const std::uint64_t agents = command.agents > 0 ? command.agents : usual_agents(command.start);
  if (is_named(command.start)) return start_of(command.start, agents, command.seed);
  const bool room = command.start == "room";
  if (!room && !std::filesystem::exists(command.start))
    throw InputError(
        "start", command.start,
        "circle, sphere, crossing, gap, forest, slender, turning, room, imazu-01 to imazu-22, harbour or a "
        "scenario's file");
  const simulation::Scenario scenario =
      room ? scenario::scenario_of_text(kRoom, "room") : scenario::read_scenario(command.start);
  Start start = start_of(scenario);
  if (!room) {
    command.start = scenario.name;
    if (!command.step) command.step = scenario.step;
    if (!command.duration) command.duration = scenario.duration;
  }
  if (start.agents.empty()) return start_amid(std::move(start.obstacles), agents, command.seed);
  if (command.agents > 0 && command.agents != start.agents.size())
    throw InputError("agents", std::to_string(command.agents), "left out: the scenario has its agents");
  return start;
}

SwarmOptions options_of(const SwarmCommand& command) {
  if (command.method != "proved" && command.method != "orca")
    throw InputError("--method", command.method, "proved or orca");
  SwarmOptions options = command.method == "orca" ? SwarmOptions::published() : SwarmOptions{};
  options.step = command.step.value_or(options.step);
  options.lost = command.lost;
  options.seed = command.seed;
  options.threads = threads_for(command.threads);
  return options;
}

std::string row(std::initializer_list<double> numbers) {
  std::string text;
  for (const double x : numbers) text.append(text.empty() ? "" : ",").append(to_text(x));
  return text + "\n";
}

std::string positions_csv(const SwarmFlight& flight) {
  std::string text = "t,agent,x,y,z\n";
  for (const SwarmSample& sample : flight.samples)
    for (std::size_t i = 0; i < sample.positions.size(); ++i) {
      const Eigen::Vector3d& x = sample.positions[i];
      text += row({sample.t, static_cast<double>(i), x.x(), x.y(), x.z()});
    }
  return text;
}

std::string agents_csv(const Swarm& swarm, const SwarmFlight& flight) {
  std::string text = "agent,arrived,path,straight,reach\n";
  for (std::size_t i = 0; i < flight.arrived.size(); ++i)
    text += row({static_cast<double>(i), flight.arrived[i], flight.path[i], flight.straight[i],
                 swarm.agents()[i].body.reach()});
  return text;
}

std::string obstacles_csv(const Swarm& swarm) {
  std::string text = "x,y,z,half_x,half_y,half_z,box\n";
  for (const Obstacle& obstacle : swarm.obstacles()) {
    // Along the axes of the world, as wide as the body.
    const Eigen::Matrix3d axes = obstacle.body.rotation * obstacle.body.half.asDiagonal();
    const Eigen::Vector3d half = obstacle.body.box ? Eigen::Vector3d(axes.cwiseAbs().rowwise().sum())
                                                   : Eigen::Vector3d(axes.rowwise().norm());
    const Eigen::Vector3d& x = obstacle.position;
    text += row({x.x(), x.y(), x.z(), half.x(), half.y(), half.z(), obstacle.body.box ? 1.0 : 0.0});
  }
  return text;
}

Json pairs_json(const std::vector<TouchedPair>& pairs) {
  Json all = Json::array();
  for (const TouchedPair& pair : pairs)
    all.push_back({{"a", pair.a}, {"b", pair.b}, {"from", pair.from}, {"to", pair.to}});
  return all;
}

Json finite(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

Json summary_of(const SwarmCommand& command, const Swarm& swarm, const SwarmFlight& flight) {
  double last = 0, path = 0, straight = 0, worst = 0;
  std::size_t arrived = 0;
  for (std::size_t i = 0; i < flight.arrived.size(); ++i) {
    if (!std::isfinite(flight.arrived[i])) continue;
    ++arrived;
    last = std::max(last, flight.arrived[i]);
    path += flight.path[i];
    straight += flight.straight[i];
    if (flight.straight[i] > 0) worst = std::max(worst, flight.path[i] / flight.straight[i]);
  }
  return {{"start", command.start},
          {"method", command.method},
          {"seed", command.seed},
          {"agents", swarm.agents().size()},
          {"obstacles", swarm.obstacles().size()},
          {"step", swarm.options().step},
          {"lost", command.lost},
          {"end", flight.end},
          {"arrived", arrived},
          {"last_arrival", arrived == flight.arrived.size() ? Json(last) : Json(nullptr)},
          {"path_ratio", straight > 0 ? Json(path / straight) : Json(nullptr)},
          {"path_ratio_worst", worst > 0 ? Json(worst) : Json(nullptr)},
          {"touched", flight.touched.size()},
          {"undecided", flight.undecided.size()},
          {"least_distance", finite(flight.least_distance)},
          {"commands", flight.counts.commands},
          {"fallbacks", flight.counts.fallbacks},
          {"planes_left", flight.counts.unsafe},
          {"deadlocks", flight.counts.deadlocks},
          {"touched_pairs", pairs_json(flight.touched)},
          {"undecided_pairs", pairs_json(flight.undecided)}};
}

void print_flight(const Json& summary, std::ostream& out) {
  const auto number = [&](const char* key) {
    return summary[key].is_null() ? std::string("-") : number_text(summary[key].get<double>(), 4);
  };
  const auto count = [&](const char* key) { return std::to_string(summary[key].get<std::uint64_t>()); };
  const bool all = !summary["last_arrival"].is_null();
  out << "swarm     " << summary["start"].get<std::string>() << ", " << count("agents") << " agents, "
      << count("obstacles") << " obstacles, method " << summary["method"].get<std::string>() << '\n'
      << "pairs     " << count("touched") << " touched, " << count("undecided") << " undecided, "
      << (summary["least_distance"].is_null()
              ? std::string("no others: proved\n")
              : "all others apart by " + at_least_text(summary["least_distance"].get<double>(), 4) +
                    " m or more: proved\n")
      << "arrived   " << count("arrived") << " of " << count("agents")
      << " within their reach of the last goal, "
      << (all ? "the last after " + number("last_arrival") : "in " + number("end")) << " s; paths "
      << number("path_ratio") << " of straight, at most " << number("path_ratio_worst") << '\n'
      << "commands  " << count("commands") << ", of them " << count("fallbacks") << " fallbacks, "
      << count("planes_left") << " with planes left; " << count("deadlocks") << " deadlocks\n";
}

/// Flies a swarm and writes what became of it. Returns the exit status: 1 where a pair touched, or is
/// undecided, by the method that promises that none does, 130 interrupted. Throws InputError.
int run_swarm(SwarmCommand command, std::ostream& out) {
  if (!command.current.empty())
    throw InputError("--current", "a current", "left out: " + command.start + " has no water");
  (void)options_of(command);
  work::StagedFolder folder(command.out, "--out");
  const auto named = [](auto&& work) {
    try {
      return work();
    } catch (const InputError& error) {
      if (error.field() == "name") throw InputError("start", error.value(), error.requirement());
      for (const char* name : {"agents", "step", "lost", "duration", "sample"})
        if (error.field() == name)
          throw InputError(std::string("--") + name, error.value(), error.requirement());
      throw;
    }
  };
  Start start = named([&] { return start_for(command); });
  const SwarmOptions options = options_of(command);
  Swarm swarm = named([&] { return Swarm(std::move(start.agents), std::move(start.obstacles), options); });
  FlightOptions flown;
  flown.duration = command.duration.value_or(flown.duration);
  flown.sample = command.sample.value_or(flown.sample);
  Progress progress(command.quiet);
  flown.progress = [&](double share) { return progress.show("flying " + command.start, share); };
  const SwarmFlight flight = named([&] { return fly(swarm, flown); });
  if (flight.interrupted) return kExitInterrupted;
  write_whole(folder.path() / "positions.csv", positions_csv(flight));
  write_whole(folder.path() / "agents.csv", agents_csv(swarm, flight));
  write_whole(folder.path() / "obstacles.csv", obstacles_csv(swarm));
  Results results;
  results.summary = summary_of(command, swarm, flight);
  results.origin = provenance(command.command_line, options.threads, {});
  results.origin["seconds"] = {{"stepping", flight.stepping}, {"proving", flight.proving}};
  results.scripts = {"swarm.py"};
  results.files = {"positions.csv", "agents.csv", "obstacles.csv", "summary.json"};
  results.old = {"swarm.pdf", "swarm.png"};
  print_flight(results.summary, results.text);
  const double each =
      flight.stepping / static_cast<double>(std::max<std::uint64_t>(flight.counts.commands, 1));
  results.text << "time      " << number_text(1e6 * each, 3) << " us an agent step, "
               << number_text(flight.proving, 3) << " s of proofs\n";
  const bool broken = !flight.touched.empty() || !flight.undecided.empty();
  results.status = options.method == Method::proved && broken ? 1 : 0;
  return publish(results, command, folder, out);
}

}  // namespace
}  // namespace vericone::swarm

namespace vericone {

int swarm_command(CommandLine& line) {
  swarm::SwarmCommand swarm;
  line.option("start", swarm.start,
              "circle, sphere, crossing, gap, forest, slender, turning, room, a scenario's file "
              "(docs/explanation/swarms.md); imazu-01 to imazu-22 or harbour (docs/explanation/ships.md)")
      .required();
  line.option("-N,--agents", swarm.agents, "Agents, 0: as many as the measured tables have, or the scenario");
  line.option("--seed", swarm.seed, "Seed of all random numbers");
  line.option("--method", swarm.method, "proved; orca, as published, changes velocities at once");
  line.option("--step", swarm.step,
              "Between two commands, s; left out: the scenario's, or 0.125, of ships 10");
  line.option("--duration", swarm.duration,
              "At most, s; ends when all have arrived; left out: the scenario's, 600, ships 10800");
  line.option("--sample", swarm.sample,
              "Between two rows of an agent in positions.csv, s; left out: 1, of ships 30");
  line.option("--lost", swarm.lost, "Of the messages of one agent to another the share that is lost");
  line.option("--current", swarm.current, "Of the water that ships sail, EAST,NORTH m/s").commas();
  read_output_line(line, swarm);
  if (ships::is_of_ships(swarm.start)) return ships::run_ships(swarm, std::cout);
  return swarm::run_swarm(swarm, std::cout);
}

}  // namespace vericone
