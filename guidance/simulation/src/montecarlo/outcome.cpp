// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/geometry/error.h>
#include <vericone/guidance/plane_view.h>
#include <vericone/internal/simulation/montecarlo/flight.h>
#include <vericone/simulation/montecarlo/campaign.h>
#include <vericone/simulation/run.h>
#include <algorithm>
#include <cmath>

namespace vericone::montecarlo {
namespace {

using namespace simulation;
using guidance::GuideOptions;
using guidance::LawStatus;

const Ellipsoid& ellipsoid_of(const guidance::BodyState& state) {
  if (!state.shape.quadric() || state.shape.delimited())
    throw InputError("shape", "another body", "an ellipsoid in space, of the agent and of the obstacle");
  return state.shape.quadric()->ellipsoid();
}

/// Fate and least distance of a run that is proved until `end` and then goes straight on for ever.
void settle(const PairProof& proof, const Track& a, const Track& b, double end, Outcome& outcome) {
  if (proof.verdict == ProofVerdict::touched) outcome.fate = Fate::met;
  if (proof.verdict != ProofVerdict::avoided) return;
  const guidance::BodyState at_a = a.state(end), at_b = b.state(end);
  const ConeOracle oracle(ellipsoid_of(at_a), ellipsoid_of(at_b));
  if (oracle.relation() != Relation::disjoint ||
      oracle.membership(at_a.velocity, at_b.velocity) != Membership::out)
    return;
  outcome.fate = Fate::avoided;
  outcome.least_distance =
      std::min(proof.least_distance, clearance_ahead(oracle, at_a.velocity, at_b.velocity));
}

/// What the law says of the tracks at the last command not after `until`: nothing need be done. Where it sees
/// no cone, because the sections overlap, it says nothing.
bool last_word_safe(const Run& run, const GuideOptions& guide, double step, double until) {
  double k = std::floor(until / step);
  if (k * step > until) --k;
  guidance::GuideMemory memory;
  const double t = std::max(k, 0.0) * step;
  const auto said = guidance::guide(run.tracks[0].state(t), run.tracks[1].state(t), guide, memory, t);
  return said && (said->status == LawStatus::clear || said->status == LawStatus::receding);
}

Outcome judge(const Run& run, const GuideOptions& guide, double step) {
  Outcome outcome;
  const PairProof& proof = run.proofs.front().proof;
  settle(proof, run.tracks[0], run.tracks[1], run.end, outcome);
  const double until = outcome.fate == Fate::met ? proof.from : run.end;
  outcome.called_safe = last_word_safe(run, guide, step, until);
  for (const auto& leg : run.tracks[0].legs())
    if (leg->from() <= until) outcome.peak = std::max(outcome.peak, leg->most_acceleration());
  for (const Event& event : run.events)
    if (event.kind == EventKind::leaves_cone && event.t <= until) {
      outcome.left_cone = event.t;
      break;
    }
  return outcome;
}

Flown flown(const std::string& name, const FlightSettings& settings, double most) {
  Flown law{name + "-" + to_text(most), {}};
  GuideOptions& guide = law.guide;
  guide.inversion.gain = guide.clearance.gain = settings.gain;
  guide.inversion.most = guide.clearance.most = most;
  guide.inversion.reference = settings.reference;
  guide.clearance.required = settings.required;
  guide.plane.choice = guidance::PlaneChoice::largest_opening;
  if (name == "slice") {
    guide.sector = guidance::SectorMethod::slice;
  } else if (name == "motion") {
    guide.plane.choice = guidance::PlaneChoice::of_motion;
  } else if (name == "clearance") {
    guide.law = guidance::Law::clearance;
  } else if (name != "exact") {
    throw InputError("laws", name, "slice, exact, motion or clearance");
  }
  return law;
}

}  // namespace

std::vector<Flown> flown_laws(const std::vector<std::string>& names, const FlightSettings& settings) {
  std::vector<Flown> laws;
  for (const double most : {settings.most, kUnlimited})
    for (const std::string& name : names) laws.push_back(flown(name, settings, most));
  return laws;
}

const char* to_string(Fate fate) {
  constexpr const char* kWords[] = {"avoided", "met", "undecided"};
  return kWords[std::size_t(fate)];
}

std::optional<Fate> fate_of(const std::string& text) {
  for (const Fate fate : {Fate::avoided, Fate::met, Fate::undecided})
    if (text == to_string(fate)) return fate;
  return std::nullopt;
}

Outcome fly(const Encounter& encounter, const Flown& law, const FlightSettings& settings) {
  Scenario scenario;
  scenario.name = law.name;
  scenario.step = settings.step;
  scenario.bodies = {encounter.agent, encounter.obstacle};
  Pilot& pilot = scenario.bodies[0].pilot.emplace();
  pilot.guide = law.guide;
  pilot.manner = Manner::source;
  pilot.passing = Passing::centres;
  RunOptions options;
  options.log = false;
  // A run ends when the centres have passed. Long bodies may still be on course to meet then: it goes on.
  scenario.stop_when_passed = true;
  scenario.duration = 4 * encounter.scale() + 2;
  Outcome outcome = judge(simulate(scenario, options), law.guide, settings.step);
  scenario.stop_when_passed = false;
  for (int i = 0; i < 3 && outcome.fate == Fate::undecided; ++i, scenario.duration *= 2)
    outcome = judge(simulate(scenario, options), law.guide, settings.step);
  return outcome;
}

StraightOutcome fly_straight(const Encounter& encounter) {
  Track a(encounter.agent.shape, encounter.agent.start, encounter.agent.orientation, 0),
      b(encounter.obstacle.shape, encounter.obstacle.start, encounter.obstacle.orientation, 0);
  const double end = 2 * encounter.scale();
  a.advance(Eigen::Vector3d::Zero(), end);
  b.advance(Eigen::Vector3d::Zero(), end);
  StraightOutcome straight;
  settle(prove(a, b, 0, end), a, b, end, straight.outcome);

  const guidance::BodyState at_a = a.state(0), at_b = b.state(0);
  const Eigen::Vector3d w = encounter.relative_velocity();
  straight.outcome.called_safe =
      ConeOracle(ellipsoid_of(at_a), ellipsoid_of(at_b)).membership(at_a.velocity, at_b.velocity) ==
      Membership::out;
  const auto look = [&](guidance::SectorMethod method, double& y) {
    const auto view = guidance::plane_view(at_a, at_b, w, method, guidance::RateMethod::none);
    if (!view) return false;
    const guidance::ConeRates rates = guidance::cone_rates(view->state, view->cone);
    y = rates.y;
    return !rates.colliding();
  };
  straight.slice_called_safe = look(guidance::SectorMethod::slice, straight.y_slice);
  straight.exact_called_safe = look(guidance::SectorMethod::true_cone, straight.y_exact);
  return straight;
}

}  // namespace vericone::montecarlo
