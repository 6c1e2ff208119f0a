// SPDX-License-Identifier: BSD-3-Clause
//
// Section 6.5.
#include <vericone/guidance/guide.h>
#include <vericone/guidance/plane_view.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "claims.h"
#include "given.h"

namespace vericone::dhal2022 {
namespace {

using simulation::EncounterSample;
using simulation::EventKind;

constexpr const char* kSection = "6.5";
const std::string kOpen =
    "K, w, the limit of the acceleration and the sizes of C, D, E, B2 are not printed; ours were chosen so "
    "that A "
    "is on the courses of B, C and D when the source says so";

/// From when on both y > 0 and V_r > 0 have been seen: out of the cone, and moving apart.
std::optional<double> steered_away(const PaperRun& run, const std::string& agent,
                                   const std::string& obstacle) {
  const auto out = run.time_of(EventKind::leaves_cone, agent, obstacle);
  const auto passed = run.time_of(EventKind::passes, agent, obstacle);
  if (!out || !passed) return std::nullopt;
  return std::max(*out, *passed);
}

/// When the bodies, not their centres, come nearest: another reading of having steered away.
std::string nearest(const PaperRun& run, const std::string& a, const std::string& b) {
  const auto proof = run.proof(a, b);
  if (!proof || proof->verdict != simulation::ProofVerdict::avoided) return "";
  return "; the bodies themselves, long as they are, come nearest at about " +
         short_text(proof->least_time, 2) + " s, another reading";
}

/// The first command with y > 0 on the plane taken.
std::optional<double> first_positive(const PaperRun& run, const std::string& obstacle) {
  for (const EncounterSample& sample : run.run.encounters)
    if (run.scenario.bodies[sample.obstacle].name == obstacle && sample.cone && sample.step.y > 0)
      return sample.t;
  return std::nullopt;
}

/// Largest y of an encounter on the planes logged at its first sample.
double largest_y_at_first(const PaperRun& run, const std::string& obstacle, double t) {
  double largest = -std::numeric_limits<double>::infinity();
  for (const simulation::PlaneSample& sample : run.run.planes)
    if (run.scenario.bodies[sample.obstacle].name == obstacle && std::abs(sample.t - t) < 1e-9)
      largest = std::max(largest, sample.plane.y);
  return largest;
}

/// By how much the plane chosen opens less than the widest plane logged at that moment, at worst, rad.
double plane_behind_widest(const PaperRun& run) {
  std::map<std::pair<double, std::size_t>, double> chosen;
  for (const EncounterSample& sample : run.run.encounters)
    if (sample.cone) chosen[{sample.t, sample.obstacle}] = sample.step.psi;
  double behind = 0;
  for (const simulation::PlaneSample& sample : run.run.planes)
    if (const auto it = chosen.find({sample.t, sample.obstacle}); it != chosen.end())
      behind = std::max(behind, sample.plane.psi - it->second);
  return behind;
}

/// Whether the relative velocity is in the cone that the law sees, not only in its part on the plane chosen.
Claim on_course(const PaperRun& run, const std::string& id, const std::vector<std::string>& figures,
                const std::string& agent, const std::string& obstacle, double t, const std::string& text,
                const std::string& note) {
  const EncounterSample sample = run.sample(agent, obstacle, t);
  const auto course = guidance::on_collision_course(run.track(agent).state(t), run.track(obstacle).state(t),
                                                    run.body(agent).pilot->guide.sector);
  const bool holds = course.value_or(false);
  std::string ours = holds ? "on course" : "not on course";
  if (sample.cone) ours += "; y = " + short_text(sample.step.y, 3) + " on the plane taken";
  ours += "; V_r = " + short_text(sample.state.v_r, 3) + " m/s";
  return statement(
      {id, kSection, figures, agent + " and " + obstacle + " at " + short_text(t) + " s", note, true}, text,
      holds, ours);
}

Claim avoided(const PaperRun& run, const std::string& id, const std::vector<std::string>& figures,
              const std::string& agent, const std::string& obstacle, const std::string& text) {
  const auto proof = run.proof(agent, obstacle);
  const auto away = steered_away(run, agent, obstacle);
  const auto passed = run.time_of(EventKind::passes, agent, obstacle);
  std::string ours = proof ? std::string(simulation::to_string(proof->verdict)) + ", proved" : "no proof";
  if (proof && proof->verdict == simulation::ProofVerdict::avoided)
    ours += "; never nearer than " + short_text(proof->least_distance, 3) + " m";
  if (proof && proof->verdict == simulation::ProofVerdict::touched)
    ours += " at " + short_text(proof->to, 4) + " s";
  if (away)
    ours += "; y > 0 and V_r > 0 from " + short_text(*away, 4) + " s on";
  else if (passed)
    ours += "; passed at " + short_text(*passed, 4) + " s";
  return statement({id, kSection, figures, agent + " and " + obstacle,
                    "disjoint at every step exactly, with a margin proved in between. " + kOpen, true},
                   text, proof && proof->verdict == simulation::ProofVerdict::avoided, ours);
}

}  // namespace

void claims_6_5_noncooperative(PaperRuns& runs, std::vector<Claim>& claims) {
  const PaperRun& run = runs.run("6.5-noncooperative");
  const std::string base = "6.5/noncooperative/";
  const std::vector<std::string> path{"6.8"}, planes{"6.9"}, speeds{"6.10"};
  given_body(run, kSection, {"6.8", "6.12"}, "A", {{10, 5, 3}, {}, {10, 0, 0}, 8.5, {0, 69}, {}}, claims);
  given_body(run, kSection, path, "B", {{10, 5, 3}, {}, {0, 0, 20}, 5.0, {0, 0}, {}}, claims);
  given_body(run, kSection, path, "C", {{}, {}, {50, 15, 30}, 5.1, {0, 34.5}, 4.7}, claims);
  given_body(run, kSection, path, "D", {{}, {}, {95, -5, 40}, 3.61, {5, 28}, 8.0}, claims);
  given_body(run, kSection, path, "E", {{}, {}, {110, 30, 40}, 5.1, {0, 34.5}, 10.5}, claims);
  const auto& hull = std::get<simulation::RigidShape>(run.body("E").shape).shape;
  const std::size_t corners = std::get<HullBody>(hull).points().size();
  claims.push_back(statement(
      {base + "faces", kSection, path, "faces of E",
       "given; assumed: a pentagonal bipyramid, 7 corners and triangles only, so 2 x 7 - 4 faces", false},
      "10", 2 * corners - 4 == 10, std::to_string(2 * corners - 4)));
  claims.back().given = true;

  const EncounterSample start = run.sample("A", "B", 0);
  const double largest = largest_y_at_first(run, "B", 0);
  claims.push_back(statement({base + "y-0", kSection, planes, "y of A and B at 0 s on all planes",
                              "assumed: both bodies lie along their headings", true},
                             "negative", largest < 0,
                             "at most " + short_text(largest, 3) + " on the planes logged, " +
                                 short_text(start.step.y, 4) + " on that of the largest psi"));
  claims.push_back(statement({base + "V_r-0", kSection, speeds, "V_r of A and B at 0 s",
                              "follows from printed numbers alone", false},
                             "negative", start.state.v_r < 0, short_text(start.state.v_r, 4) + " m/s"));
  claims.push_back(on_course(run, base + "course-B", planes, "A", "B", 0, "on a collision course",
                             "assumed: both bodies lie along their headings"));
  const double behind = plane_behind_widest(run);
  claims.push_back(
      statement({base + "plane",
                 kSection,
                 {"6.9", "6.13"},
                 "plane chosen at each instant",
                 "the plane is found among 24 and refined; compared with the 12 planes logged",
                 false},
                "maximum psi", behind < 1e-3,
                "opens at most " + short_text(behind, 2) + " rad less than the widest plane logged"));
  const auto away = steered_away(run, "A", "B");
  claims.push_back(statement({base + "signs-B",
                              kSection,
                              {"6.10", "6.13"},
                              "y on the plane of maximum psi, and V_r, after a certain time",
                              kOpen,
                              true},
                             "both greater than zero", away.has_value(),
                             away ? "from " + short_text(*away, 4) + " s on" : "never both"));
  claims.push_back(number(
      {base + "clear-of-B",
       kSection,
       {"6.10", "6.13"},
       "A has fully steered away from B",
       "reading assumed: y > 0 and V_r > 0. " + kOpen +
           ". In all runs tried with other gains and limits the centres had passed before 3 s, as r(0) = "
           "22.4 m and V_r(0) = -8 m/s follow from printed numbers" +
           nearest(run, "A", "B"),
       true},
      4.7, "after 4.7", "s", away, {0.05, "half a unit of the last printed digit"}));
  claims.push_back(on_course(run, base + "course-C", planes, "A", "C", 4.7, "on a collision course",
                             kOpen + ", and where A is by then depends on them"));
  claims.push_back(avoided(run, base + "avoids-C", {"6.8", "6.13"}, "A", "C", "steered out of the cone"));
  claims.push_back(on_course(run, base + "course-D", planes, "A", "D", 8,
                             "commands against D (so on a collision course)",
                             kOpen + ", and where A is by then depends on them"));
  claims.push_back(avoided(run, base + "avoids-D", {"6.8", "6.13"}, "A", "D", "steered out of the cone"));
  claims.push_back(on_course(run, base + "course-E", planes, "A", "E", 10.5,
                             "commands against E (so on a collision course)",
                             kOpen + ", and where A is by then depends on them"));
  claims.push_back(avoided(run, base + "avoids-E", {"6.8", "6.13"}, "A", "E", "successfully cleared"));
  claims.push_back(avoided(run, base + "avoids-B", {"6.8", "6.13"}, "A", "B", "successful avoidance"));
}

namespace {

/// a_B / a_A of (6.19) in the plane chosen, at every command: its range.
struct Ratio {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  int commands = 0;
};
Ratio acceleration_ratio(const PaperRun& run) {
  Ratio ratio;
  for (const EncounterSample& sample : run.run.encounters) {
    if (!sample.attended || sample.step.a.norm() == 0) continue;
    const guidance::BodyState a = run.run.tracks[sample.agent].state(sample.t),
                              b = run.run.tracks[sample.obstacle].state(sample.t);
    const guidance::PlaneView view = guidance::plane_states(a, b, sample.step.across);
    const double value = sample.step.b.dot(view.lateral_b()) / sample.step.a.dot(view.lateral_a());
    ratio.low = std::min(ratio.low, value);
    ratio.high = std::max(ratio.high, value);
    ++ratio.commands;
  }
  return ratio;
}

}  // namespace

void claims_6_5_cooperative(PaperRuns& runs, std::vector<Claim>& claims) {
  const PaperRun& run = runs.run("6.5-cooperative");
  const std::string base = "6.5/cooperative/";
  const std::vector<std::string> path{"6.14"}, chosen{"6.19"}, command{"6.17"};
  given_body(run, kSection, {"6.14", "6.18"}, "A", {{10, 5, 3}, {}, {10, 0, 0}, 8.5, {0, 69}, {}}, claims);
  given_body(run, kSection, path, "B1", {{10, 5, 3}, {}, {0, 0, 20}, 5.0, {0, 0}, {}}, claims);
  given_body(run, kSection, path, "B2", {{}, {}, {60, 15, 40}, 5.1, {0, 34.5}, 5.5}, claims);
  const Ratio ratio = acceleration_ratio(run);
  claims.push_back(statement(
      {base + "mu", kSection, command, "a_B / a_A",
       "measured from the accelerations in space; " +
           std::string("(6.19) itself is misprinted (docs/errata.md, 3.6), the corrected law is used"),
       false},
      "mu = -0.5",
      ratio.commands > 0 && std::abs(ratio.low + 0.5) < 1e-9 && std::abs(ratio.high + 0.5) < 1e-9,
      "from " + short_text(ratio.low, 6) + " to " + short_text(ratio.high, 6) + " over " +
          std::to_string(ratio.commands) + " commands"));
  claims.push_back(on_course(run, base + "course-B1", {"6.15", "6.16"}, "A", "B1", 0, "on a collision course",
                             "assumed: both bodies lie along their headings"));
  const auto out_1 = first_positive(run, "B1"), away_1 = steered_away(run, "A", "B1"),
             away_2 = steered_away(run, "A", "B2");
  claims.push_back(number(
      {base + "clear-of-B1", kSection, chosen, "y > 0 and psi decreasing against B1",
       "reading assumed: moving apart (psi decreases) with y > 0, as against B. " + kOpen +
           (out_1 ? ". y alone is positive from " + short_text(*out_1, 3) + " s on" : "") +
           nearest(run, "A", "B1"),
       true},
      5.5, "just after 5.5", "s", away_1, {0.1, "\"just after\": one unit of the last printed digit"}));
  claims.push_back(on_course(run, base + "course-B2", {"6.15", "6.19"}, "A", "B2", 5.5,
                             "on a collision course", kOpen + ", and where A is by then depends on them"));
  claims.push_back(number({base + "clear-of-B2", kSection, chosen, "A and B2 are able to steer away",
                           "reading assumed: as against B1. " + kOpen, true},
                          11, "around 11", "s", away_2,
                          {0.5, "\"around\": half a unit of the last printed digit"}));
  claims.push_back(avoided(run, base + "avoids-B1", {"6.14", "6.19"}, "A", "B1", "cooperatively avoided"));
  claims.push_back(
      avoided(run, base + "avoids-B2", {"6.14", "6.19"}, "A", "B2", "steered away from each other"));
}

}  // namespace vericone::dhal2022
