// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/simulation/trials.h>
#include <vericone/simulation/trials.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace vericone::simulation::trials_test {
namespace {

using Eigen::Vector3d;

/// P(X <= k) of the binomial distribution, summed term by term.
double binomial_at_most(std::uint64_t k, std::uint64_t n, double p) {
  double sum = 0;
  for (std::uint64_t i = 0; i <= k; ++i)
    sum += std::exp(std::lgamma(double(n + 1)) - std::lgamma(double(i + 1)) - std::lgamma(double(n - i + 1)) +
                    (i ? double(i) * std::log(p) : 0) + (n - i ? double(n - i) * std::log1p(-p) : 0));
  return sum;
}

TEST(Trials, IntervalsAreThoseOfTheBinomialDistribution) {
  for (const std::uint64_t n : {1u, 10u, 100u, 1000u})
    for (const std::uint64_t k : {std::uint64_t(0), n / 10, n / 2, n - n / 10, n}) {
      const Share share = share_of(k, n);
      EXPECT_LE(share.low, share.share);
      EXPECT_GE(share.high, share.share);
      // At the ends of the interval what was seen, or more (less), has a chance of 2.5 %.
      if (k < n) {
        EXPECT_NEAR(binomial_at_most(k, n, share.high), 0.025, 1e-9) << k << " of " << n;
      } else {
        EXPECT_EQ(share.high, 1);
      }
      if (k > 0) {
        EXPECT_NEAR(1 - binomial_at_most(k - 1, n, share.low), 0.025, 1e-9) << k << " of " << n;
      } else {
        EXPECT_EQ(share.low, 0);
      }
    }
  EXPECT_NEAR(share_of(1000, 1000).low, std::pow(0.025, 1e-3), 1e-12);
}

TEST(Trials, PairsAreComparedByWhatDiffersAlone) {
  std::array<bool, 20> first{}, second{};
  first.fill(true);
  second.fill(true);
  for (std::size_t i = 0; i < 8; ++i) second[i] = false;
  first[19] = false;
  const Paired p = paired(first, second);
  EXPECT_EQ(p.first_alone, 8u);
  EXPECT_EQ(p.second_alone, 1u);
  EXPECT_NEAR(p.chance, 2 * (1 + 9) / 512.0, 1e-12);
  EXPECT_EQ(paired(first, first).chance, 1);
}

/// The source's 7.5 with few steps: two ellipsoids on a collision course.
Scenario engagement() {
  Scenario scenario;
  scenario.duration = 3;
  scenario.step = 0.05;
  for (const char* name : {"A", "B"}) {
    Body& body = scenario.bodies.emplace_back();
    body.name = name;
    body.shape = RigidShape{CombinedEllipsoid(Ellipsoid::from_axes(Vector3d::Zero(), {4, 2, 1}))};
    body.orientation = Orientation::heading;
  }
  scenario.bodies[0].start = {{0, 0, 0}, {8, 0, 0}, Eigen::Matrix3d::Identity()};
  scenario.bodies[1].start = {{25, 1, 0.5}, {-5, 0, 0}, Eigen::Matrix3d::Identity()};
  Pilot& pilot = scenario.bodies[0].pilot.emplace();
  pilot.guide.inversion = {2, 0.05, 10, 0, 1, 1e-9};
  pilot.guide.clearance.most = 10;
  pilot.guide.clearance.required = 0.2;
  pilot.guide.plane.planes = 6;
  return scenario;
}

TEST(Trials, ALevelIsOfTheErrorsAlone) {
  Scenario scenario = engagement();
  Sensor& sensor = scenario.bodies[0].pilot->sensor.emplace();
  sensor.position = sensor.bias = 0.5;
  sensor.range = 9;
  sensor.period = 0.2;
  const Sensor
      percent = trial_scenario(scenario, TrialLaw::own, trial_level("6:15")).bodies[0].pilot->sensor.value(),
      twice = trial_scenario(scenario, TrialLaw::own, trial_level("x2")).bodies[0].pilot->sensor.value();
  EXPECT_EQ(percent.noise, Noise::per_axis);
  EXPECT_EQ(percent.position, 0.06);
  EXPECT_EQ(percent.bias, 0);
  EXPECT_EQ(twice.position, 1);
  EXPECT_EQ(twice.bias, 1);
  for (const Sensor& one : {percent, twice}) {
    EXPECT_EQ(one.range, 9);
    EXPECT_EQ(one.period, 0.2);
  }
}

TEST(Trials, AllLawsFlyAndATrialAloneIsTheSame) {
  for (const TrialLaw law : all_trial_laws()) {
    const Scenario flown = trial_scenario(engagement(), law, trial_level("5:10"));
    EXPECT_EQ(trial_law(to_string(law)), law);
    const TrialOutcome once = fly_trial(flown, 3);
    EXPECT_GT(once.effort, 0) << to_string(law);
    for (const std::uint64_t other : {2u, 4u}) fly_trial(flown, other);
    const TrialOutcome again = fly_trial(flown, 3);
    EXPECT_EQ(once.effort, again.effort) << to_string(law);
    EXPECT_EQ(once.verdict, again.verdict) << to_string(law);
    EXPECT_EQ(once.least_distance, again.least_distance) << to_string(law);
    EXPECT_NE(once.least_distance, fly_trial(flown, 4).least_distance) << to_string(law);
  }
}

TEST(Trials, LevelsMeanWhatTheySay) {
  const TrialLevel level = trial_level("7.5:15");
  ASSERT_TRUE(level.sensor);
  EXPECT_EQ(level.sensor->noise, Noise::per_axis);
  EXPECT_DOUBLE_EQ(level.sensor->position, 0.075);
  EXPECT_DOUBLE_EQ(level.sensor->velocity, 0.15);
  Scenario scenario = engagement();
  Sensor& sensor = scenario.bodies[0].pilot->sensor.emplace();
  sensor.position = 0.5;
  sensor.velocity = 0.25;
  const Scenario four = trial_scenario(scenario, TrialLaw::di_state, trial_level("x4"));
  EXPECT_EQ(four.bodies[0].pilot->sensor->position, 2);
  EXPECT_EQ(four.bodies[0].pilot->sensor->velocity, 1);
}

/// The run of the scenario itself is the truth: its proofs, and the integrals of |a|.
void expect_own(const Scenario& scenario, std::uint64_t trial) {
  const Scenario flown = trial_scenario(scenario, TrialLaw::own, trial_level("x1"));
  RunOptions options;
  options.trial = trial;
  const Run run = simulate(scenario, options);
  const TrialOutcome outcome = fly_trial(flown, trial);
  EXPECT_EQ(outcome.verdict, run.verdict());
  double least = std::numeric_limits<double>::infinity(), effort = 0;
  for (const PairOutcome& pair : run.proofs) least = std::min(least, pair.proof.least_distance);
  for (const PassageOutcome& passage : run.passages) least = std::min(least, passage.proof.least_distance);
  EXPECT_EQ(outcome.least_distance, run.verdict() == ProofVerdict::avoided ? least : 0);
  for (std::size_t i = 0; i < run.tracks.size(); ++i) {
    if (!scenario.bodies[i].pilot) continue;
    const double dt = 1e-3;
    for (double t = dt / 2; t < run.end; t += dt) effort += dt * run.tracks[i].acceleration(t).norm();
  }
  EXPECT_NEAR(outcome.effort, effort, 0.02 * effort + 1e-9);
}

TEST(Trials, AnyPilotsAndLaws) {
  Scenario two = engagement();
  two.bodies[1].pilot = two.bodies[0].pilot;
  two.bodies[1].pilot->guide.law = guidance::Law::clearance;
  for (Body& body : two.bodies) {
    Sensor& sensor = body.pilot->sensor.emplace();
    sensor.position = 0.1;
    sensor.velocity = 0.1;
  }
  for (const std::uint64_t trial : {0u, 5u}) expect_own(two, trial);
  EXPECT_NE(fly_trial(trial_scenario(two, TrialLaw::own, trial_level("x1")), 0).least_distance,
            fly_trial(trial_scenario(two, TrialLaw::own, trial_level("x1")), 5).least_distance);
  Scenario nobody = engagement();
  nobody.bodies[0].pilot.reset();
  expect_own(nobody, 0);
  // Both avoid, by a law of the source.
  two.bodies[1].pilot->guide.law = guidance::Law::avoidance;
  const Scenario changed = trial_scenario(two, TrialLaw::di_filter, trial_level("7.5:15"));
  for (const Body& body : changed.bodies) {
    EXPECT_TRUE(body.pilot->guide.filter.y);
    EXPECT_EQ(body.pilot->sensor->noise, Noise::per_axis);
  }
  static_cast<void>(fly_trial(changed, 1));
}

TEST(Trials, AnOpeningThatIsMissedIsNoSuccess) {
  for (const bool through : {true, false}) {
    Scenario scenario;
    scenario.duration = 4;
    scenario.step = 0.05;
    Body& body = scenario.bodies.emplace_back();
    body.name = "A";
    body.shape = RigidShape{CombinedEllipsoid(Ellipsoid::from_axes(Vector3d::Zero(), {0.3, 0.2, 0.2}))};
    body.start.velocity = {through ? 2.0 : -2.0, 0, 0};
    MovingOrifice& ring = scenario.orifices.emplace_back();
    ring.name = "ring";
    ring.opening = Opening::circle(1);
    ring.position = {4, 0, 0};
    ring.rotation << 0, 0, 1, 1, 0, 0, 0, 1, 0;
    ring.wall = false;
    Pilot& pilot = body.pilot.emplace();
    pilot.through.emplace().orifices = {"ring"};
    pilot.through->passage.most = 0.01;
    expect_own(scenario, 0);
    const TrialOutcome outcome = fly_trial(scenario, 0);
    EXPECT_EQ(outcome.verdict, ProofVerdict::avoided);
    EXPECT_EQ(outcome.missed, !through);
  }
}

template <typename Make>
void expect_refused(Make make, const std::string& field) {
  try {
    static_cast<void>(make());
    ADD_FAILURE() << "accepted: " << field;
  } catch (const InputError& e) {
    EXPECT_EQ(e.field(), field);
  }
}

TEST(Trials, WhatCannotBeIsRefusedByName) {
  for (const char* text : {"", "x", "5", "5:", ":5", "-1:2", "x-1", "5:10:15", "xnan"})
    expect_refused([&] { return trial_level(text); }, "--levels");
  expect_refused([] { return trial_law("best"); }, "--laws");
  expect_refused([] { return trial_scenario(engagement(), TrialLaw::di, trial_level("x2")); }, "--levels");
  Scenario none = engagement();
  none.bodies[0].pilot.reset();
  expect_refused([&] { return trial_scenario(none, TrialLaw::di, trial_level("5:10")); }, "bodies");
  Scenario two = engagement();
  two.bodies[1].pilot = two.bodies[0].pilot;
  two.bodies[0].pilot->sensor.emplace();
  expect_refused([&] { return trial_scenario(two, TrialLaw::di, trial_level("x2")); }, "--levels");
  expect_refused([] { return trial_scenario(engagement(), TrialLaw::own, trial_level("x2")); }, "--levels");
  Scenario other = engagement();
  other.bodies[0].pilot->guide.law = guidance::Law::clearance;
  expect_refused([&] { return trial_scenario(other, TrialLaw::di, trial_level("5:10")); }, "law");
}

}  // namespace
}  // namespace vericone::simulation::trials_test
