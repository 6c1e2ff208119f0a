// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/scenarios/scenario_files.h>
#include <vericone/simulation/reach.h>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "commands.h"
#include "input/scene.h"
#include "json/json_value.h"
#include "output/number_text.h"
#include "output/progress.h"
#include "simulate/run_text.h"
#include "work/interrupt.h"

namespace vericone {
namespace {

using namespace simulation;
using scenario::print_line;

struct ReachOptions {
  std::string scenario;
  bool current = false;  // also what current the passages endure
  int directions = 4;    // of currents in which it is flown again
  int runs = 6;          // each
  bool quiet = false;
  bool json = false;
};

/// What the scenario's own run proves.
struct Flown {
  Run run;
  std::optional<double> drift;  // m/s
  struct Again {
    double azimuth = 0;             // rad
    std::optional<double> current;  // m/s
  };
  std::vector<Again> again;
};

const PassageProof* passage_of(const Run& run, std::size_t agent, std::size_t orifice) {
  const auto it = std::find_if(run.passages.begin(), run.passages.end(), [&](const PassageOutcome& p) {
    return p.agent == agent && p.orifice == orifice;
  });
  return it == run.passages.end() ? nullptr : &it->proof;
}

bool any_carried(const Scenario& scenario, const std::vector<AgentReach>& agents) {
  return std::any_of(agents.begin(), agents.end(), [&](const AgentReach& a) {
    const auto& vehicle = scenario.bodies[a.agent].vehicle;
    return vehicle && vehicle->carried();
  });
}

/// Nothing where it was interrupted.
std::optional<Flown> fly(const Scenario& scenario, const std::vector<AgentReach>& agents,
                         const ReachOptions& options) {
  Progress progress(options.quiet);
  RunOptions run_options;
  run_options.log = false;
  const std::string what = "simulating " + scenario.name;
  run_options.progress = [&](double t) { return progress.show(what, t / scenario.duration); };
  run_options.proving = [&](double share) { return progress.show("proving " + scenario.name, share); };
  Flown flown{simulate(scenario, run_options), {}, {}};
  if (flown.run.interrupted) return std::nullopt;
  if (!options.current) return flown;
  // To the end: one that stops as soon as all is passed is behind the last opening by a hair.
  Scenario whole = scenario;
  whole.stop_when_passed = false;
  const Run run = scenario.stop_when_passed ? simulate(whole, run_options) : flown.run;
  if (run.interrupted) return std::nullopt;
  flown.drift = largest_drift(whole, run);
  if (!any_carried(scenario, agents)) return flown;
  for (int i = 0; i < options.directions; ++i) {
    const double azimuth = 2 * std::numbers::pi * i / options.directions;
    bool going = true;
    const auto go_on = [&] {
      going = progress.show("flying in currents", double(i) / options.directions);
      return going;
    };
    constexpr double kFirst = 0.01;
    const auto current =
        largest_current(whole, {std::cos(azimuth), std::sin(azimuth), 0}, kFirst, options.runs, go_on);
    if (!going) return std::nullopt;
    flown.again.push_back({azimuth, current});
  }
  return flown;
}

double degrees_of(double radians) { return radians * 180 / std::numbers::pi; }

Json number(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

Json time_json(const ReachTime& time) {
  return {{"not_before", number(time.not_before)},
          {"unreachable", std::isinf(time.not_before)},
          {"limit", to_string(time.by)}};
}

/// What a vehicle broke of its own limits, on which all bounds stand.
const LimitBroken* broken_by(const Run& run, std::size_t agent) {
  const auto it = std::find_if(run.limits_broken.begin(), run.limits_broken.end(),
                               [&](const VehicleBeyond& beyond) { return beyond.body == agent; });
  return it == run.limits_broken.end() ? nullptr : &it->broken;
}

Json reach_json(const Scenario& scenario, const std::vector<AgentReach>& agents, const Flown& flown,
                const ReachOptions& options) {
  Json json{{"scenario", scenario.name}, {"horizon", scenario.duration}, {"agents", Json::array()}};
  for (const AgentReach& agent : agents) {
    const ReachLimits& l = agent.limits;
    Json orifices = Json::array();
    for (std::size_t k = 0; k < agent.reach.size(); ++k) {
      const PassageProof* proof = passage_of(flown.run, agent.agent, agent.orifices[k]);
      const bool passed = proof && proof->verdict == PassageVerdict::passed;
      orifices.push_back({{"orifice", scenario.orifices[agent.orifices[k]].name},
                          {"edge", time_json(agent.reach[k].edge)},
                          {"center", time_json(agent.reach[k].center)},
                          {"by", passed ? Json(proof->time) : Json(nullptr)},
                          {"verdict", proof ? Json(to_string(proof->verdict)) : Json(nullptr)}});
    }
    json["agents"].push_back({{"agent", scenario.bodies[agent.agent].name},
                              {"limits",
                               {{"speed", number(l.speed)},
                                {"acceleration", number(l.acceleration)},
                                {"turn_rate", number(l.turn_rate)},
                                {"course_rate", number(l.course_rate)},
                                {"climb", number(l.climb)},
                                {"climb_jerk", number(l.climb_jerk)},
                                {"top", number(l.top)},
                                {"bottom", number(l.bottom)}}},
                              {"orifices", orifices}});
    if (const LimitBroken* broken = broken_by(flown.run, agent.agent))
      json["agents"].back()["limit_broken"] = {{"limit", broken->limit}, {"t", broken->t}};
  }
  if (!options.current) return json;
  json["current"] = {{"recorded", flown.drift ? Json(*flown.drift) : Json(nullptr)},
                     {"sampled", Json::array()}};
  for (const Flown::Again& again : flown.again)
    json["current"]["sampled"].push_back(
        {{"azimuth", again.azimuth}, {"speed", again.current ? Json(*again.current) : Json(nullptr)}});
  return json;
}

std::string limits_text(const ReachLimits& l) {
  std::string text;
  const auto add = [&](double limit, const std::string& before, const std::string& after) {
    if (std::isfinite(limit)) text += (text.empty() ? "" : ", ") + before + at_most_text(limit, 4) + after;
  };
  add(l.speed, "", " m/s");
  add(l.acceleration, "", " m/s^2");
  add(degrees_of(l.turn_rate), "turns by ", " deg/s");
  add(degrees_of(l.course_rate), "turns its course by ", " deg/s");
  add(l.climb, "climbs by ", " m/s");
  add(l.climb_jerk, "and by ", " m/s^3");
  add(l.top, "up to z = ", " m");
  add(l.bottom, "down to z = ", " m");
  return text.empty() ? "no limits" : "at most " + text;
}

const char* reason(ReachLimit limit) {
  switch (limit) {
    case ReachLimit::none:
      return "it is there";
    case ReachLimit::speed:
      return "too far for its speed";
    case ReachLimit::turning:
      return "too far aside for how it turns";
    case ReachLimit::climb:
      return "too far above or below for how it climbs";
    case ReachLimit::height:
      return "above or below all places where it can be";
    case ReachLimit::appearance:
      return "it appears then";
  }
  return "";
}

std::string reach_text(const Scenario& scenario, const Reach& reach, const PassageProof* proof) {
  std::string text;
  if (std::isinf(reach.edge.not_before)) {
    text = "unreachable within " + number_text(scenario.duration) + " s: " + reason(reach.edge.by);
  } else {
    text = "not before " + at_least_text(reach.edge.not_before, 4) + " s (" + reason(reach.edge.by) + ")";
    text += std::isinf(reach.center.not_before)
                ? ", its centre unreachable within " + number_text(scenario.duration) + " s"
                : ", its centre not before " + at_least_text(reach.center.not_before, 4) + " s";
  }
  if (!proof) return text + "; the run ends before";
  if (proof->verdict == PassageVerdict::passed)
    return text + "; passed by " + number_text(proof->time) + " s, proved";
  return text + "; the run does not show it: " + to_string(proof->verdict);
}

std::string current_text(const std::optional<double>& current) {
  return current ? at_least_text(*current, 3) + " m/s" : "none: not all are passed without";
}

void print_reach(const Scenario& scenario, const std::vector<AgentReach>& agents, const Flown& flown,
                 const ReachOptions& options, std::ostream& out) {
  for (const AgentReach& agent : agents) {
    print_line(out, scenario.bodies[agent.agent].name, limits_text(agent.limits));
    for (std::size_t k = 0; k < agent.reach.size(); ++k)
      print_line(
          out, "",
          scenario.orifices[agent.orifices[k]].name + ": " +
              reach_text(scenario, agent.reach[k], passage_of(flown.run, agent.agent, agent.orifices[k])));
  }
  if (!options.current) return;
  print_line(out, "recorded run",
             flown.drift ? "endures every constant current up to " + current_text(flown.drift) + ", proved"
                         : "endures no current: not all are passed without");
  for (const Flown::Again& again : flown.again)
    print_line(out, &again == &flown.again.front() ? "flown again" : "",
               "current along " + number_text(degrees_of(again.azimuth)) + " deg: all passed up to " +
                   current_text(again.current) + ", sampled at " + std::to_string(options.runs) + " speeds");
  if (flown.again.empty()) print_line(out, "flown again", "no agent is a vehicle that the water carries");
}

/// When the openings of a scenario can be reached at the earliest, by what its agents' limits prove, and by
/// when its own run passes them, proved. Returns the exit status: 0 whatever the answers are, 130
/// interrupted. Throws InputError.
int run_reach(const ReachOptions& options, std::ostream& out) {
  const Scenario scenario =
      scenario::scenario_of_text(input::read_scene_text(options.scenario), options.scenario);
  check(scenario);
  const std::vector<AgentReach> agents = reach(scenario);
  const std::optional<Flown> flown = fly(scenario, agents, options);
  if (!flown) return kExitInterrupted;
  if (options.json)
    out << reach_json(scenario, agents, *flown, options).dump(1) << '\n';
  else
    print_reach(scenario, agents, *flown, options, out);
  return 0;
}

}  // namespace

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

}  // namespace vericone
