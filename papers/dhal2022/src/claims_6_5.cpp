// SPDX-License-Identifier: BSD-3-Clause
//
// Section 6.5.
#include <vericone/guidance/guide.h>
#include <vericone/guidance/plane_view.h>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "claims.h"
#include "given.h"

namespace vericone::dhal2022 {
namespace {

using simulation::EncounterSample;
using simulation::EventKind;

constexpr const char* kSection = "6.5";
const std::string kOpen =
    "K, w, where it ceases, the limit of the acceleration and the shapes of C, D, E, B2 are not printed";
/// The gains were chosen together with the shapes of C and D, so that A comes onto the courses of B, C, D
/// when the source says so and leaves them (docs/errata.md, 4.2).
const std::vector<std::pair<std::string, int>> kGainsOfA{
    {"K", 1}, {"w", 1}, {"y where it ceases", 1}, {"limit of the acceleration", 1}};
Fit with(const std::string& name, const std::vector<std::pair<std::string, int>>& more) {
  Fit fit{name, kGainsOfA};
  fit.free.insert(fit.free.end(), more.begin(), more.end());
  return fit;
}
const Fit kFitAlone = with("gains and shapes of 6.5, non-cooperative",
                           {{"C's semi-axes and dents", 6}, {"D's semi-axes and k(t)", 7}, {"E's size", 2}});
const Fit kFitTogether = with("gains and shapes of 6.5, cooperative", {{"B2's semi-axes and dents", 6}});

std::string degrees(double angle) { return short_text(angle * 180 / std::numbers::pi, 4) + " deg"; }

/// Out of the cone and receding: y > 0 and V_r_hat >= 0 on the plane of the largest psi.
std::optional<double> steered_away(const PaperRun& run, const std::string& agent,
                                   const std::string& obstacle) {
  return first_time(run.looks(agent, obstacle), [](const Look& look) { return look.clear(); });
}

/// The look with the largest psi until the obstacle recedes: psi decreases from the next one on.
const Look* widest(const PaperRun& run, const std::string& agent, const std::string& obstacle) {
  const Look* most = nullptr;
  for (const Look& look : run.looks(agent, obstacle)) {
    if (most == nullptr || look.psi > most->psi) most = &look;
    if (look.clear()) break;
  }
  return most;
}

/// Largest y of an encounter on the planes logged at its first sample.
double largest_y_at_first(const PaperRun& run, const std::string& obstacle, double t) {
  double largest = -std::numeric_limits<double>::infinity();
  for (const simulation::PlaneSample& sample : run.run.planes)
    if (run.scenario.bodies[sample.obstacle].name == obstacle && std::abs(sample.t - t) < 1e-9)
      largest = std::max(largest, sample.plane.y);
  return largest;
}

/// By how much the plane on which the law commands opens less than the widest plane logged at that moment, at
/// worst, rad. Where it commands nothing the plane logged is that of the log.
double plane_behind_widest(const PaperRun& run) {
  std::map<std::pair<double, std::size_t>, double> chosen;
  for (const EncounterSample& sample : run.run.encounters)
    if (sample.cone && !guidance::commands_nothing(sample.step.status))
      chosen[{sample.t, sample.obstacle}] = sample.step.psi;
  double behind = 0;
  for (const simulation::PlaneSample& sample : run.run.planes)
    if (const auto it = chosen.find({sample.t, sample.obstacle}); it != chosen.end())
      behind = std::max(behind, sample.plane.psi - it->second);
  return behind;
}

/// Whether the relative velocity is in the cone that the law sees, not only in its part on the plane chosen.
Claim on_course(const PaperRun& run, const std::string& id, const std::vector<std::string>& figures,
                const std::string& agent, const std::string& obstacle, double t, const std::string& text,
                const std::string& note, const Fit* fit = nullptr) {
  const EncounterSample sample = run.sample(agent, obstacle, t);
  const auto course = guidance::on_collision_course(run.track(agent).state(t), run.track(obstacle).state(t),
                                                    run.body(agent).pilot->guide.sector);
  const bool holds = course.value_or(false);
  std::string ours = holds ? "on course" : "not on course";
  if (sample.cone) ours += "; y = " + short_text(sample.step.y, 3) + " on the plane taken";
  ours += "; V_r = " + short_text(sample.state.v_r, 3) + " m/s";
  return statement(
      {id, kSection, figures, agent + " and " + obstacle + " at " + short_text(t) + " s", note, true, fit},
      text, holds, ours);
}

Claim avoided(const PaperRun& run, const std::string& id, const std::vector<std::string>& figures,
              const std::string& agent, const std::string& obstacle, const std::string& text,
              const Fit* fit) {
  const auto proof = run.proof(agent, obstacle);
  const std::vector<Look>& looks = run.looks(agent, obstacle);
  const auto away = steered_away(run, agent, obstacle);
  std::string ours = proof ? std::string(simulation::to_string(proof->verdict)) + ", proved" : "no proof";
  if (proof && proof->verdict == simulation::ProofVerdict::avoided)
    ours += "; never nearer than " + short_text(proof->least_distance, 3) + " m";
  if (proof && proof->verdict == simulation::ProofVerdict::touched) ours += " at " + seconds_text(proof->to);
  if (away) ours += "; y > 0 and V_r_hat >= 0 from " + seconds_text(*away) + " on";
  ours += reentries(looks);
  const bool idle = !run.engaged(agent, obstacle);
  if (idle) ours += "; nothing is commanded against it";
  const std::string note = "disjoint at every step exactly, with a margin proved in between. " + kOpen;
  Claim claim = statement({id, kSection, figures, agent + " and " + obstacle, note, true, fit}, text,
                          proof && proof->verdict == simulation::ProofVerdict::avoided, ours);
  if (idle) claim.verdict = Verdict::not_engaged;
  return claim;
}

/// That A is done with an obstacle when the next one is there.
Claim done(const PaperRun& run, const std::string& id, const std::string& obstacle, double by,
           const std::string& next) {
  const auto away = steered_away(run, "A", obstacle);
  return statement({id,
                    kSection,
                    {"6.9", "6.13"},
                    "A and " + obstacle + " when " + next + " appears",
                    "read from the order of the text; done is y > 0 and V_r_hat >= 0. " + kOpen,
                    true},
                   "done with " + obstacle + " by " + short_text(by) + " s", away && *away <= by,
                   away ? "done from " + seconds_text(*away) + " on" : "never done");
}

/// What a body is, as the scenario has it: an ellipsoid delimited by one hyperboloid of two sheets.
bool biconcave(const simulation::Body& body) {
  const auto* rigid = std::get_if<simulation::RigidShape>(&body.shape);
  const auto* shape = rigid ? std::get_if<CombinedEllipsoid>(&rigid->shape) : nullptr;
  if (shape == nullptr || shape->delimiters().size() != 1) return false;
  // {x : x^T M x <= level}: between two sheets M has one positive eigenvalue, within one sheet two.
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(shape->delimiters()[0].matrix);
  return (eigen.eigenvalues().array() > 0).count() == 1;
}
Claim shape_given(const PaperRun& run, const std::string& id, const std::string& figure,
                  const std::string& name) {
  const bool holds = biconcave(run.body(name));
  return ordered({id, kSection, {figure}, "shape of " + name, "the kind is printed, the sizes are not"},
                 "biconcave ellipsoid", holds,
                 holds ? "an ellipsoid delimited by a two-sheeted hyperboloid" : "something else");
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
  claims.push_back(
      ordered({base + "faces", kSection, path, "faces of E",
               "assumed: a pentagonal bipyramid, 7 corners and triangles only, so 2 x 7 - 4 faces"},
              "10", 2 * corners - 4 == 10, std::to_string(2 * corners - 4)));
  claims.push_back(shape_given(run, base + "shape-C", "6.8", "C"));
  const auto* changing = std::get_if<simulation::DentedQuadric>(&run.body("D").shape);
  double least = 1, most = 0;
  for (int i = 0; changing != nullptr && i <= 1000; ++i) {
    const double k = changing->k.at(8 + i * (run.scenario.duration - 8) / 1000);
    least = std::min(least, k);
    most = std::max(most, k);
  }
  const double first_k = changing ? changing->k.at(8) : 1;
  claims.push_back(ordered({base + "shape-D", kSection, path, "shape of D",
                            "the change is printed in words only; k = 0 is the ellipsoid"},
                           "from an ellipsoid to a biconcave ellipsoid with varying concavity",
                           std::abs(first_k) < 1e-9 && most > least,
                           "k = " + short_text(std::abs(first_k) < 1e-9 ? 0 : first_k, 3) + " at 8 s, then " +
                               short_text(std::max(least, 0.0), 2) + " to " + short_text(most, 3)));

  const EncounterSample start = run.sample("A", "B", 0);
  const double largest = largest_y_at_first(run, "B", 0);
  const std::vector<Look>& looks = run.looks("A", "B");
  claims.push_back(statement({base + "y-0", kSection, planes, "y of A and B at 0 s on all planes",
                              "assumed: both bodies lie along their headings", true},
                             "negative", largest < 0,
                             "at most " + short_text(largest, 3) + " on the planes logged, " +
                                 short_text(looks.at(0).y, 4) + " on that of the largest psi"));
  claims.push_back(statement(
      {base + "V_r-0", kSection, speeds, "V_r of A and B at 0 s", "follows from printed numbers alone"},
      "negative", start.state.v_r < 0, short_text(start.state.v_r, 4) + " m/s"));
  claims.push_back(on_course(run, base + "course-B", planes, "A", "B", 0, "on a collision course",
                             "assumed: both bodies lie along their headings"));
  const double behind = plane_behind_widest(run);
  claims.push_back(
      ordered({base + "plane",
               kSection,
               {"6.9", "6.13"},
               "plane chosen at each instant",
               "the scenario orders it; found among 24 and refined, compared with the 12 planes logged"},
              "maximum psi", behind < 1e-3,
              "opens at most " + short_text(behind, 2) + " rad less than the widest plane logged"));
  const auto both = first_time(looks, [](const Look& look) { return look.y > 0 && look.v_r > 0; });
  claims.push_back(statement({base + "signs-B",
                              kSection,
                              {"6.10", "6.13"},
                              "y on the plane of maximum psi, and V_r, after a certain time",
                              kOpen,
                              true},
                             "both greater than zero", both.has_value(),
                             both ? "from " + seconds_text(*both) + " on" : "never both"));
  claims.push_back(number({base + "clear-of-B",
                           kSection,
                           {"6.10", "6.13"},
                           "A has fully steered away from B",
                           "y > 0 and V_r_hat >= 0 on the plane of maximum psi. Fit-free where the law "
                           "ceases at y = 0, as in 5.4.1: "
                           "48 sets of gains and limits give 4.64 to 4.68 s; going on until y = 0.08 gives "
                           "4.56 s (docs/errata.md, 4.2). "
                           "This run ceases at y = " +
                               short_text(run.body("A").pilot->guide.inversion.cease),
                           true},
                          4.7, "after 4.7", "s", steered_away(run, "A", "B"), half_a_digit(1)));
  const std::string where = kOpen + ", and where A is by then depends on them";
  claims.push_back(
      on_course(run, base + "course-C", planes, "A", "C", 4.7, "on a collision course", where, &kFitAlone));
  claims.push_back(
      avoided(run, base + "avoids-C", {"6.8", "6.13"}, "A", "C", "steered out of the cone", &kFitAlone));
  claims.push_back(done(run, base + "done-C", "C", 8, "D"));
  claims.push_back(on_course(run, base + "course-D", planes, "A", "D", 8,
                             "commands against D (so on a collision course)", where, &kFitAlone));
  claims.push_back(
      avoided(run, base + "avoids-D", {"6.8", "6.13"}, "A", "D", "steered out of the cone", &kFitAlone));
  claims.push_back(done(run, base + "done-D", "D", 10.5, "E"));
  claims.push_back(on_course(
      run, base + "course-E", planes, "A", "E", 10.5, "commands against E (so on a collision course)",
      where + ": other gains bring A onto E's course, and then off C's (docs/errata.md, 4.2)", &kFitAlone));
  claims.push_back(
      avoided(run, base + "avoids-E", {"6.8", "6.13"}, "A", "E", "successfully cleared", &kFitAlone));
  claims.push_back(
      avoided(run, base + "avoids-B", {"6.8", "6.13"}, "A", "B", "successful avoidance", &kFitAlone));
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
  claims.push_back(shape_given(run, base + "shape-B2", "6.14", "B2"));
  const Ratio ratio = acceleration_ratio(run);
  claims.push_back(ordered(
      {base + "mu", kSection, command, "a_B / a_A",
       "ordered by the scenario, measured from the accelerations in space; (6.19) itself is misprinted "
       "(docs/errata.md, 3.6), the corrected law is used"},
      "mu = -0.5",
      ratio.commands > 0 && std::abs(ratio.low + 0.5) < 1e-9 && std::abs(ratio.high + 0.5) < 1e-9,
      "from " + short_text(ratio.low, 6) + " to " + short_text(ratio.high, 6) + " over " +
          std::to_string(ratio.commands) + " commands"));
  claims.push_back(on_course(run, base + "course-B1", {"6.15", "6.16"}, "A", "B1", 0, "on a collision course",
                             "assumed: both bodies lie along their headings"));
  const Look* open_1 = widest(run, "A", "B1");
  const auto away_1 = steered_away(run, "A", "B1");
  claims.push_back(number(
      {base + "clear-of-B1", kSection, chosen, "y > 0 and psi decreasing against B1",
       "read literally: from when on psi decreases while y > 0. " + kOpen +
           ". With K = 4 and w = 0.05 where it ceases as well it is 5.50 s, with other settings 5.3 to 6.1 "
           "s, "
           "and none gives this and 4.7 s against B (docs/errata.md, 4.2)",
       true},
      5.5, "just after 5.5", "s", open_1 && open_1->y > 0 ? std::optional<double>(open_1->t) : std::nullopt,
      {0.1, "\"just after\": from then to one unit of the last printed digit later", true}));
  if (open_1)
    claims.back().ours += "; psi is then " + degrees(open_1->psi) +
                          (away_1 ? "; V_r_hat >= 0 from " + seconds_text(*away_1) + " on" : "");
  claims.push_back(on_course(run, base + "course-B2", {"6.15", "6.19"}, "A", "B2", 5.5,
                             "on a collision course", kOpen + ", and where A is by then depends on them",
                             &kFitTogether));
  const Look* open_2 = widest(run, "A", "B2");
  claims.push_back(
      number({base + "clear-of-B2", kSection, chosen, "A and B2 are able to steer away",
              "y > 0 and V_r_hat >= 0 on the plane of maximum psi. " + kOpen, true, &kFitTogether},
             11, "around 11", "s", steered_away(run, "A", "B2"),
             {0.5, "\"around\": half a unit of the last printed digit"}));
  if (open_2) claims.back().ours += "; psi decreases from " + seconds_text(open_2->t) + " on";
  if (!run.engaged("A", "B2")) {
    claims.back().verdict = Verdict::not_engaged;
    claims.back().ours += "; nothing is commanded against B2";
  }
  claims.push_back(
      avoided(run, base + "avoids-B1", {"6.14", "6.19"}, "A", "B1", "cooperatively avoided", &kFitTogether));
  claims.push_back(avoided(run, base + "avoids-B2", {"6.14", "6.19"}, "A", "B2",
                           "steered away from each other", &kFitTogether));
}

}  // namespace vericone::dhal2022
