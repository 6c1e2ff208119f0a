// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/internal/simulation/trials.h>
#include <vericone/simulation/trials.h>

#include <vericone/geometry/error.h>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

namespace vericone::simulation {
namespace {

constexpr std::array<std::pair<TrialLaw, const char*>, 11> kLaws{{{TrialLaw::di, "di"},
                                                                  {TrialLaw::di_filter, "di-filter"},
                                                                  {TrialLaw::rdi, "rdi"},
                                                                  {TrialLaw::rdi_filter, "rdi-filter"},
                                                                  {TrialLaw::di_rates, "di-rates"},
                                                                  {TrialLaw::di_analytic, "di-analytic"},
                                                                  {TrialLaw::di_state, "di-state"},
                                                                  {TrialLaw::di_margin, "di-margin"},
                                                                  {TrialLaw::clearance, "clearance"},
                                                                  {TrialLaw::robust, "robust"},
                                                                  {TrialLaw::own, "own"}}};

double number_of(const std::string& text, const std::string& whole) {
  double x = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
  if (error != std::errc() || end != text.data() + text.size() || !(x >= 0) || !std::isfinite(x))
    throw InputError("--levels", whole.empty() ? "nothing" : whole,
                     "percent of position and of velocity, such as 7.5:15, or x and a number, such as x4");
  return x;
}

/// One that minds bodies, or could.
bool about_bodies(const Body& body) { return body.pilot && minds_bodies(*body.pilot); }

/// What an outer loop does where the scenario does not say: a and |b| as the noise leaves them, and a bound
/// of its influence that a step of 0.01 s can keep.
guidance::OuterLoopOptions usual_outer_loop(double step) {
  guidance::OuterLoopOptions outer;
  outer.from_noise = true;
  outer.model.dt = step;
  outer.options.mu = 10;
  outer.options.input_weight = 1e-5;
  return outer;
}

/// When it measures and what it sees stays.
Sensor with_errors_of(const Sensor& errors, Sensor sensor) {
  sensor.noise = errors.noise;
  sensor.engagement = errors.engagement;
  sensor.position = errors.position;
  sensor.velocity = errors.velocity;
  sensor.deviation = errors.deviation;
  sensor.shared = errors.shared;
  sensor.bias = errors.bias;
  return sensor;
}

void require_sensor(bool there, const TrialLevel& level) {
  if (!there)
    throw InputError("--levels", level.name, "such as 7.5:15: the scenario has no sensor to be multiplied");
}

void change(Pilot& pilot, TrialLaw law, double step) {
  using enum TrialLaw;
  guidance::GuideOptions& guide = pilot.guide;
  if (guide.law != guidance::Law::avoidance)
    throw InputError("law", guidance::to_string(guide.law),
                     "avoidance: the trials change it as their names say");
  pilot.manner = Manner::source;
  const bool outer = law == rdi || law == rdi_filter;
  if (!outer)
    guide.robust.reset();
  else if (!guide.robust)
    guide.robust = usual_outer_loop(step);
  guide.filter.y = law == di_filter || law == rdi_filter;
  guide.filter.rates = guide.filter.y || law == di_rates;
  const bool by_state = law == di_state || law == di_margin || law == clearance || law == robust;
  guide.rates =
      law == di_analytic || by_state ? guidance::GuideRates::analytic : guidance::GuideRates::backward;
  guide.margin = law == di_margin || law == clearance ? 3 : 0;
  const bool measures_state = pilot.sensor->noise != Noise::engagement;
  if (by_state && !measures_state)
    throw InputError("--laws", to_string(law),
                     "laws of the plane: the sensor measures no position and velocity");
  pilot.estimator = by_state ? Estimator::state : Estimator::none;
  guide.errors = law == robust ? 3 : 0;
  if (law == clearance || law == robust) guide.law = guidance::Law::clearance;
}

}  // namespace

const char* to_string(TrialLaw law) {
  return std::find_if(kLaws.begin(), kLaws.end(), [&](const auto& entry) { return entry.first == law; })
      ->second;
}

std::span<const TrialLaw> all_trial_laws() {
  static constexpr auto kAll = [] {
    std::array<TrialLaw, kLaws.size()> all{};
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = kLaws[i].first;
    return all;
  }();
  return kAll;
}

TrialLaw trial_law(const std::string& name) {
  std::string list;
  for (const auto& [law, known] : kLaws) {
    if (name == known) return law;
    list.append(list.empty() ? "" : ", ").append(known);
  }
  throw InputError("--laws", name, "one of " + list);
}

TrialLevel trial_level(const std::string& text) {
  TrialLevel level{text, std::nullopt, 1};
  const std::size_t colon = text.find(':');
  if (colon != std::string::npos) {
    Sensor& sensor = level.sensor.emplace();
    sensor.noise = Noise::per_axis;
    sensor.position = number_of(text.substr(0, colon), text) / 100;
    sensor.velocity = number_of(text.substr(colon + 1), text) / 100;
    sensor.deviation = 1.0 / 3;  // m(t) of (7.27)
  } else {
    level.times = number_of(text.starts_with('x') ? text.substr(1) : "", text);
  }
  return level;
}

Scenario trial_scenario(const Scenario& scenario, TrialLaw law, const TrialLevel& level) {
  Scenario flown = scenario;
  bool any = false, senses = false;
  for (Body& body : flown.bodies) {
    if (!about_bodies(body)) continue;
    Pilot& pilot = *body.pilot;
    if (level.sensor)
      pilot.sensor = with_errors_of(*level.sensor, pilot.sensor.value_or(Sensor{}));
    else if (pilot.sensor)
      pilot.sensor = pilot.sensor->times(level.times);
    any = true;
    senses |= pilot.sensor.has_value();
    if (law == TrialLaw::own) continue;
    require_sensor(pilot.sensor.has_value(), level);
    change(pilot, law, scenario.step);
  }
  if (!any && law != TrialLaw::own)
    throw InputError("bodies", "no pilot", "one body or more with a pilot that avoids");
  require_sensor(senses || level.times == 1, level);  // without noise each trial is the run itself
  check(flown);
  return flown;
}

TrialOutcome fly_trial(const Scenario& scenario, std::uint64_t trial) {
  RunOptions options;
  options.log = false;
  options.trial = trial;
  return outcome_of(scenario, simulate(scenario, options));
}

TrialOutcome outcome_of(const Scenario& scenario, const Run& run) {
  const auto flies = [&](std::size_t i) { return scenario.bodies[i].pilot.has_value(); };
  const bool any = std::any_of(scenario.bodies.begin(), scenario.bodies.end(),
                               [](const Body& body) { return body.pilot.has_value(); });
  TrialOutcome outcome;
  outcome.verdict = ProofVerdict::avoided;
  outcome.least_distance = std::numeric_limits<double>::infinity();
  const auto add = [&](ProofVerdict verdict, double least_distance) {
    if (verdict == ProofVerdict::touched || outcome.verdict == ProofVerdict::avoided)
      outcome.verdict = verdict;
    outcome.least_distance = std::min(outcome.least_distance, least_distance);
  };
  for (const PairOutcome& pair : run.proofs)
    if (!any || flies(pair.a) || flies(pair.b)) add(pair.proof.verdict, pair.proof.least_distance);
  for (const PassageOutcome& passage : run.passages) {
    const PassageVerdict verdict = passage.proof.verdict;
    outcome.missed |= passage.ordered && verdict == PassageVerdict::missed;
    add(verdict == PassageVerdict::touched     ? ProofVerdict::touched
        : verdict == PassageVerdict::undecided ? ProofVerdict::undecided
                                               : ProofVerdict::avoided,
        passage.proof.least_distance);
  }
  if (outcome.verdict != ProofVerdict::avoided || !std::isfinite(outcome.least_distance))
    outcome.least_distance = 0;
  for (std::size_t i = 0; i < run.tracks.size(); ++i)
    for (const auto& leg : run.tracks[i].legs())
      if (flies(i)) outcome.effort += leg->most_acceleration() * (leg->to() - leg->from());
  return outcome;
}

}  // namespace vericone::simulation
