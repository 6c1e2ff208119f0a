// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/run_text.h"

#include <vericone/internal/scenarios/words.h>
#include <vericone/internal/scenes/words.h>
#include <vericone/internal/simulation/run_tables.h>
#include <vericone/internal/simulation/shape_in_time.h>
#include <vericone/scenarios/scenario_files.h>
#include <vericone/simulation/run_tables.h>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ostream>
#include <utility>
#include <vector>

#include "json/json_value.h"
#include "output/number_text.h"

namespace vericone::scenario {
namespace {

using namespace simulation;

std::string brief(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.5g", x);
  return text;
}

/// Where that is more than its law may command: by a vehicle, on the way to a goal, or to hold a speed.
std::string reached_text(const simulation::Body& body, const Track& track) {
  const double reached = track.most_acceleration(), most = most_commanded(*body.pilot);
  return reached > most * (1 + 1e-9) ? "; reached up to " + at_most_text(reached, 4) + " m/s^2" : "";
}

void print_bodies(const Scenario& scenario, const Run& run, std::ostream& out) {
  std::string others;
  bool first = true;
  for (std::size_t i = 0; i < scenario.bodies.size(); ++i) {
    const simulation::Body& body = scenario.bodies[i];
    if (body.pilot) {
      print_line(out, first ? "agents" : "", agent_text(scenario, body) + reached_text(body, run.tracks[i]));
      first = false;
    } else {
      others.append(others.empty() ? "" : ", ").append(body.name);
      if (body.appears > 0) others.append(" from " + brief(body.appears) + " s");
    }
  }
  if (!others.empty()) print_line(out, "other bodies", others);
}

bool placed(const simulation::Body& body) { return body.shape.rigid() && body.shape.rigid()->placed(); }

std::string event_text(const Scenario& scenario, const Event& event) {
  const std::string agent = scenario.bodies[event.agent].name, other = obstacle_of(scenario, event);
  const std::string unit = unit_of(scenario, event);
  switch (event.kind) {
    case EventKind::appears:
      return agent + " appears";
    case EventKind::enters_cone:
      if (unit == "m" && event.value >= 0) {
        const std::string now = brief(event.value),
                          required = brief(scenario.bodies[event.agent].pilot->guide.clearance.required);
        return agent + " is on course to pass " + other + " nearer than " + required + " m" +
               (now == required ? "" : ", at " + now + " m");
      }
      return agent + " is on course to meet " + other;
    case EventKind::leaves_cone:
      if (unit == "m") return agent + " is on course to pass " + other + " at " + brief(event.value) + " m";
      return agent + " leaves the cone of " + other;
    case EventKind::passes:
      return agent + " passes " + other +
             (placed(scenario.bodies[event.obstacle]) ? ", its middle " + brief(event.value) + " m away"
                                                      : ", centres " + brief(event.value) + " m apart");
    case EventKind::aligned:
      return agent + " points at its goal";
    case EventKind::reaches_goal:
      if (unit.empty()) return agent + " reaches its goal";
      return agent + " reaches goal " + brief(event.value) + " of " +
             std::to_string(scenario.bodies[event.agent].pilot->goals.size());
    case EventKind::cannot_avoid:
      return agent + " finds no course that avoids " + other;
    case EventKind::goes_through:
    case EventKind::goes_beside:
      return agent +
             (event.kind == EventKind::goes_through ? " goes through " : " crosses the plane beside ") +
             other + ", " + brief(event.value) + " m from its centre";
    case EventKind::sees:
      return agent + " sees " + other;
    case EventKind::loses:
      return agent + " loses sight of " + other;
    case EventKind::contact:
      return agent + " and " + other + " meet: apart before " + brief(event.value) + " s, proved";
  }
  return "";
}

std::string milliseconds(double seconds) {
  const double ms = 1e3 * seconds;
  return (ms < 99.5 ? number_text(ms, 2) : std::to_string(std::lround(ms))) + " ms";
}

std::string not_kept(const PairOutcome& pair) {
  if (pair.kept()) return "";
  return "; nearer than required: " + brief(pair.proof.least_distance) + " of " + brief(pair.required) + " m";
}

/// The worst of all pairs, and what it leaves out.
std::string verdict_text(const Scenario& scenario, const Run& run) {
  const ProofVerdict verdict = run.verdict();
  std::string text = scenario.orifices.empty() ? to_string(verdict) : run_verdict(run);
  if (run.proofs.empty() && run.passages.empty()) {
    text = "none: no pair of bodies could be checked";
  } else if (verdict != ProofVerdict::undecided) {
    text += ", proved";
  }
  const PairOutcome* worst = nullptr;
  for (const PairOutcome& pair : run.proofs)
    if (verdict == ProofVerdict::avoided && !pair.kept() &&
        (worst == nullptr ||
         pair.proof.least_distance - pair.required < worst->proof.least_distance - worst->required))
      worst = &pair;
  if (worst != nullptr) text += not_kept(*worst);
  if (const std::size_t count = run.not_checked.size(); count > 0)
    text += "; not checked: " + std::to_string(count) + (count == 1 ? " pair" : " pairs") +
            " that do not move against each other";
  return text;
}

void print_pair(const Scenario& scenario, const PairOutcome& pair, std::ostream& out) {
  const PairProof& proof = pair.proof;
  const std::string names = scenario.bodies[pair.a].name + ", " + scenario.bodies[pair.b].name + ": ";
  const Eigen::Vector3d& x = proof.place;
  const std::string place = " at (" + brief(x.x()) + ", " + brief(x.y()) + ", " + brief(x.z()) + ") m";
  switch (proof.verdict) {
    case ProofVerdict::avoided:
      return print_line(out, "",
                        names + "apart by " + at_least_text(proof.least_distance, 5) +
                            " m or more, proved from " + brief(proof.from) + " to " + brief(proof.to) +
                            " s; nearest at " + brief(proof.least_time) + " s" + not_kept(pair));
    case ProofVerdict::touched:
      return print_line(out, "",
                        names + "apart before " + bounds_text(proof.from, proof.to, " s, meeting at ") +
                            " s" + place + ", both proved");
    case ProofVerdict::undecided:
      return print_line(out, "",
                        names + "closer than the proof resolves between " +
                            bounds_text(proof.from, proof.to) + " s, near" + place);
  }
}

void print_passages(const Scenario& scenario, const Run& run, std::ostream& out) {
  for (const PassageOutcome& passage : run.passages) {
    const PassageProof& proof = passage.proof;
    const std::string names =
        scenario.bodies[passage.agent].name + " through " + scenario.orifices[passage.orifice].name + ": ";
    const Eigen::Vector3d& x = proof.place;
    const std::string place = " at (" + brief(x.x()) + ", " + brief(x.y()) + ", " + brief(x.z()) + ") m";
    const std::string rim = at_least_text(proof.least_distance, 4) + " m or more from the rim";
    switch (proof.verdict) {
      case PassageVerdict::passed:
        print_line(out, "", names + "passed at " + brief(proof.time) + " s, " + rim + ", proved");
        break;
      case PassageVerdict::missed:
        print_line(out, "", names + (passage.ordered ? "missed" : "not passed") + ", " + rim + ", proved");
        break;
      case PassageVerdict::touched:
        print_line(out, "",
                   names + "apart before " +
                       bounds_text(proof.from, proof.to, " s, touching rim or wall at ") + " s" + place +
                       ", both proved");
        break;
      case PassageVerdict::undecided:
        print_line(out, "",
                   names + "nearer than the proof resolves between " + bounds_text(proof.from, proof.to) +
                       " s, near" + place);
        break;
    }
  }
}

/// What a reader wants to see of many events.
bool decisive(EventKind kind) {
  return kind == EventKind::contact || kind == EventKind::cannot_avoid || kind == EventKind::reaches_goal ||
         kind == EventKind::goes_through || kind == EventKind::goes_beside;
}

constexpr std::size_t kMostEvents = 30, kMostPairs = 10, kNearestPairs = 5;

void print_events(const Scenario& scenario, const Run& run, std::ostream& out) {
  const bool all = run.events.size() <= kMostEvents;
  std::size_t listed = 0;
  for (const Event& event : run.events) {
    if (!all && (!decisive(event.kind) || listed >= kMostEvents)) continue;
    char when[32];
    std::snprintf(when, sizeof when, "%10.4f s  ", event.t);
    print_line(out, listed++ == 0 ? "events" : "", when + event_text(scenario, event));
  }
  if (!all)
    print_line(out, listed == 0 ? "events" : "",
               std::to_string(run.events.size()) + " in all, from " + brief(run.events.front().t) + " to " +
                   brief(run.events.back().t) + " s: events.csv");
}

/// All of a few; of many the worst.
void print_pairs(const Scenario& scenario, const Run& run, std::ostream& out) {
  if (run.proofs.size() <= kMostPairs) {
    for (const PairOutcome& pair : run.proofs) print_pair(scenario, pair, out);
    return;
  }
  std::vector<const PairOutcome*> worst;
  for (const PairOutcome& pair : run.proofs) worst.push_back(&pair);
  const auto rank = [](const PairOutcome* pair) {
    const ProofVerdict verdict = pair->proof.verdict;
    const int order = verdict == ProofVerdict::touched ? 0 : verdict == ProofVerdict::undecided ? 1 : 2;
    return std::pair(order, order < 2 ? pair->proof.to : pair->proof.least_distance - pair->required);
  };
  std::stable_sort(worst.begin(), worst.end(),
                   [&](const PairOutcome* x, const PairOutcome* y) { return rank(x) < rank(y); });
  for (std::size_t k = 0; k < kNearestPairs; ++k) print_pair(scenario, *worst[k], out);
  const auto apart = std::count_if(worst.begin() + kNearestPairs, worst.end(), [](const PairOutcome* pair) {
    return pair->proof.verdict == ProofVerdict::avoided;
  });
  print_line(out, "",
             "and " + std::to_string(worst.size() - kNearestPairs) + " more pairs, " + std::to_string(apart) +
                 " of them avoided, proved: proof.json");
}

/// A vehicle does not carry out at once what it is told, and may go beyond it.
std::string most_text(const simulation::Body& body) {
  const double most = most_commanded(*body.pilot);
  return std::isfinite(most) ? (body.vehicle ? ", commands at most " : ", at most ") + brief(most) + " m/s^2"
                             : "";
}

std::string through_text(const Scenario& scenario, const std::string& agent, const Through& through,
                         const std::string& most) {
  const bool ours = through.law == Through::Law::passage;
  std::string text = agent + ": " + to_string(through.law) + " through ";
  for (std::size_t i = 0; i < through.orifices.size(); ++i)
    text += (i == 0 ? "" : ", ") + through.orifices[i];
  text += ours ? ", " + brief(through.passage.margin) + " m from the rim"
               : ", w " + brief(through.source.reference) + " m^2";
  text += ", gain " + brief(ours ? through.passage.gain : through.source.gain) + "/s";
  return text + most + (scenario.bodies.size() > 1 ? "; sees no bodies" : "");
}

}  // namespace

std::string current_text(const Current& water) {
  return "at z = 0 never faster than " + at_most_text(water.most(0, 0), 4) + " m/s";
}

std::string agent_text(const Scenario& scenario, const simulation::Body& body) {
  const Pilot& pilot = *body.pilot;
  const guidance::GuideOptions& guide = pilot.guide;
  const std::string most = most_text(body);
  if (pilot.own) return body.name + ": " + pilot.own->name() + most;
  if (pilot.through) return through_text(scenario, body.name, *pilot.through, most);
  std::string text = body.name + ": " + guidance::to_string(guide.law);
  if (guide.law == guidance::Law::clearance) {
    text += " to " + brief(guide.clearance.required) + " m";
  } else if (!planar(body.shape) && !guarded(pilot)) {
    text += std::string(", ") + (guide.sector == guidance::SectorMethod::true_cone ? "true" : "slice") +
            " sector, " + guidance::to_string(guide.plane.choice);
  }
  text += guarded(pilot) ? ", guarded" : ", gain " + brief(guide.inversion.gain) + "/s";
  text += most;
  if (pilot.others_most > 0) text += ", others at most " + brief(pilot.others_most) + " m/s^2";
  for (const auto& [name, a] : pilot.others_most_of) text += ", " + name + " at most " + brief(a) + " m/s^2";
  std::string minds;
  for (const std::string& name : pilot.minds) minds.append(minds.empty() ? "; minds " : ", ").append(name);
  return text + (scenario.bodies.size() > 2 ? minds : "");
}

std::string orifice_words(const MovingOrifice& orifice) {
  const Eigen::Vector2d& axes = orifice.opening.semi_axes();
  const Eigen::Vector3d n = orifice.rotation.col(2), &v = orifice.velocity, &p = orifice.position;
  const auto list = [](const Eigen::Vector3d& x) {
    return "(" + brief(x.x()) + ", " + brief(x.y()) + ", " + brief(x.z()) + ")";
  };
  if (orifice.window)
    return "window of a mesh with " + std::to_string(orifice.window->mesh().body.assembly()->size()) +
           " triangles, rim of " + std::to_string(orifice.window->rim().size()) + " corners, mesh at " +
           list(p) + " m" + (v.isZero(0) ? ", at rest" : ", velocity " + list(v) + " m/s") +
           (orifice.spin.isZero(0) ? "" : ", turning at " + list(orifice.spin) + " rad/s");
  std::string text = orifice.opening.polygonal()
                         ? "opening with " + std::to_string(orifice.opening.vertices().size()) + " corners"
                     : axes.x() == axes.y() ? "round opening, radius " + brief(axes.x()) + " m"
                                            : "elliptic opening, semi-axes " + brief(axes.x()) + " and " +
                                                  brief(axes.y()) + " m";
  text += orifice.wall ? " in a wall" : ", its rim alone";
  text += ", at " + list(p) + " m, normal " + list(n);
  text += v.isZero(0) ? ", at rest" : ", velocity " + list(v) + " m/s";
  if (orifice.appears > 0) text += ", appears at " + brief(orifice.appears) + " s";
  if (!orifice.spin.isZero(0)) text += ", turning at " + list(orifice.spin) + " rad/s";
  return text;
}

void print_line(std::ostream& out, std::string label, const std::string& text) {
  label.resize(std::max<std::size_t>(20, label.size() + 1), ' ');
  out << label << text << '\n';
}

std::string certificate_text(const simulation::RunCertificate& certificate) {
  const std::string by = certificate.by > 0 ? " " + to_text(certificate.by) + " m" : "";
  std::string text =
      std::to_string(certificate.pairs.size()) + (certificate.pairs.size() == 1 ? " pair" : " pairs");
  switch (certificate.says) {
    case simulation::RunClaim::apart:
      text += by.empty() ? " apart" : " apart by" + by;
      break;
    case simulation::RunClaim::near:
      text += " no farther apart at a time than" + by;
      break;
    case simulation::RunClaim::meet:
      text += " in contact at a time";
      break;
    case simulation::RunClaim::passed:
      text = "a passage";
      break;
    case simulation::RunClaim::stays:
      text = "a corridor";
      break;
  }
  return text + " from " + to_text(certificate.from) + " to " + to_text(certificate.to) + " s";
}

void Facts::print(bool json, std::ostream& out) const {
  Json list = Json::array();
  for (const auto& [label, text] : lines_) {
    if (json)
      list.push_back({{"label", label}, {"text", text}});
    else
      print_line(out, label, text);
  }
  if (json) out << list.dump(1) << '\n';
}

void print_run(const Scenario& scenario, const Run& run, double seconds, std::ostream& out) {
  print_line(out, "scenario", scenario.name);
  print_line(out, "verdict", verdict_text(scenario, run));
  print_pairs(scenario, run, out);
  print_passages(scenario, run, out);
  print_bodies(scenario, run, out);
  if (scenario.water.moves()) print_line(out, "current", current_text(scenario.water));
  print_line(out, "time",
             brief(run.end) + " s in steps of " + brief(scenario.step) + " s, computed and proved in " +
                 number_text(seconds, 2) + " s: " + number_text(run.end / seconds, 4) + " times real time");
  if (run.times.decisions > 0)
    print_line(out, "time of decisions",
               "mean " + milliseconds(run.times.mean) + ", 99 % within " + milliseconds(run.times.within) +
                   ", worst " + milliseconds(run.times.worst) + ", of " +
                   std::to_string(run.times.decisions) + "; proofs " + number_text(run.times.proofs, 2) +
                   " s");
  for (const VehicleBeyond& beyond : run.limits_broken)
    print_line(out, "beyond its limits",
               scenario.bodies[beyond.body].name + " at " + brief(beyond.broken.t) +
                   " s: " + beyond.broken.limit + " " + brief(beyond.broken.value) + ", declared " +
                   brief(beyond.broken.allowed));
  print_events(scenario, run, out);
}

std::string shape_words(const simulation::Body& body) {
  const WorldBody shape = shape_at(body.shape, body.appears, body.start.position, body.start.rotation);
  return (shape.planar() ? scenes::body_words(*shape.flat()) : scenes::body_words(shape.as_placed())) +
         (body.shape.rigid() ? "" : ", k may change");
}

}  // namespace vericone::scenario
