// SPDX-License-Identifier: BSD-3-Clause
//
// Guarded pilots, and what a verdict says of all pairs.
#include <gtest/gtest.h>
#include <vericone/simulation/run.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vericone::simulation::guarded_test {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;
using guidance::Law;

Body ball(const std::string& name, double radius, const Vector3d& position, const Vector3d& velocity) {
  Body body;
  body.name = name;
  body.shape =
      RigidShape{CombinedEllipsoid(Ellipsoid::from_axes(Vector3d::Zero(), Vector3d::Constant(radius)))};
  body.start.position = position;
  body.start.velocity = velocity;
  return body;
}

Body disc(const std::string& name, double radius, const Vector2d& position, const Vector2d& velocity) {
  Body body = ball(name, radius, {position.x(), position.y(), 0}, {velocity.x(), velocity.y(), 0});
  body.shape = RigidShape{CombinedEllipse(Ellipse::from_axes(Vector2d::Zero(), Vector2d::Constant(radius)))};
  return body;
}

Scenario of(std::vector<Body> bodies, double duration = 6) {
  Scenario scenario;
  scenario.duration = duration;
  scenario.bodies = std::move(bodies);
  return scenario;
}

Pilot pilot(Law law) {
  Pilot result;
  result.guide.law = law;
  return result;
}

bool happened(const simulation::Run& run, EventKind kind) {
  return std::any_of(run.events.begin(), run.events.end(), [&](const Event& e) { return e.kind == kind; });
}

TEST(Guarded, DefaultsAvoidABallAtRest) {
  for (const Law law : {Law::avoidance, Law::clearance})
    for (const bool planar : {false, true})
      for (const double most : {8.0, std::numeric_limits<double>::infinity()})
        for (const bool with_goal : {false, true}) {
          Scenario scenario =
              planar ? of({disc("A", 0.3, {0, 0}, {5, 0}), disc("B", 1, {10, 0}, {0, 0})}, 20)
                     : of({ball("A", 0.3, {0, 0, 0}, {5, 0, 0}), ball("B", 1, {10, 0, 0}, {0, 0, 0})}, 20);
          scenario.bodies[0].pilot = pilot(law);
          scenario.bodies[0].pilot->guide.inversion.most = scenario.bodies[0].pilot->guide.clearance.most =
              most;
          if (with_goal) scenario.bodies[0].pilot->goals = {Goal{{20, 0, 0}, 8, "", 1, Vector3d::Zero(), ""}};
          const auto run = simulate(scenario);
          EXPECT_EQ(run.verdict(), ProofVerdict::avoided);
          EXPECT_EQ(happened(run, EventKind::reaches_goal), with_goal);
          EXPECT_FALSE(happened(run, EventKind::cannot_avoid));
          if (law == Law::clearance) {
            EXPECT_TRUE(run.proofs.at(0).kept()) << run.proofs.at(0).proof.least_distance;
          }
          EXPECT_NEAR(run.tracks[0].motion(run.end).velocity.norm(), 5, 1e-8);
          if (planar) {
            EXPECT_EQ(run.tracks[0].motion(run.end).position.z(), 0);
          }
        }
}

TEST(Guarded, HoldsStillWhereNothingThreatens) {
  Scenario scenario = of({ball("A", 0.3, {0, 0, 0}, {5, 0, 0}), ball("B", 1, {10, 3, 0}, {0, 0, 0})});
  scenario.bodies[0].pilot = pilot(Law::avoidance);
  const auto run = simulate(scenario);
  EXPECT_EQ(run.tracks[0].legs().size(), 1U);  // one straight line
}

TEST(Guarded, SaysThatItCannotAvoid) {
  // 2 m before a wall of 60 m, at 20 m/s and 1 m/s^2.
  Scenario scenario = of({ball("A", 0.3, {0, 0, 0}, {20, 0, 0}), ball("B", 30, {32.5, 0, 0}, {0, 0, 0})}, 1);
  scenario.bodies[0].pilot = pilot(Law::avoidance);
  scenario.bodies[0].pilot->guide.inversion.most = 1;
  const auto run = simulate(scenario);
  EXPECT_EQ(run.verdict(), ProofVerdict::touched);
  const auto says = find_event(scenario, run, EventKind::cannot_avoid, "A", "B");
  ASSERT_TRUE(says);
  EXPECT_LT(says->t, run.proofs.at(0).proof.from);
  EXPECT_LE(says->value, 0);
}

TEST(Guarded, TenAgentsExchangePlaces) {
  std::vector<Body> bodies;
  for (int i = 0; i < 10; ++i) {
    const double angle = 2 * std::numbers::pi * i / 10;
    const Vector3d at(20 * std::cos(angle), 20 * std::sin(angle), 0);
    bodies.push_back(ball("A" + std::to_string(i), 0.5, at, -at / 20 * 4));
    bodies.back().pilot = pilot(Law::avoidance);
    bodies.back().pilot->guide.inversion.most = 8;
    bodies.back().pilot->goals = {Goal{-at, 8, "", 1, Vector3d::Zero(), ""}};
  }
  Scenario scenario = of(bodies, 60);
  scenario.step = 0.05;
  RunOptions options;
  options.log = false;
  const auto run = simulate(scenario, options);
  EXPECT_EQ(run.verdict(), ProofVerdict::avoided);
  EXPECT_EQ(run.proofs.size(), 45U);
  EXPECT_EQ(std::count_if(run.events.begin(), run.events.end(),
                          [](const Event& e) { return e.kind == EventKind::reaches_goal; }),
            10);
}

TEST(Verdict, OfBodiesWithoutPilots) {
  // Head on at 5 m/s each, 1 m large, from 20 m: they meet at 1.8 s.
  const Body a = ball("A", 1, {0, 0, 0}, {5, 0, 0}), b = ball("B", 1, {20, 0, 0}, {-5, 0, 0});
  const auto run = simulate(of({a, b}));
  EXPECT_EQ(run.verdict(), ProofVerdict::touched);
  ASSERT_EQ(run.proofs.size(), 1U);
  EXPECT_NEAR(run.proofs[0].proof.to, 1.8, 1e-6);
  EXPECT_TRUE(happened(run, EventKind::contact));
  // Beside an agent too.
  Body agent = ball("C", 1, {0, 100, 0}, {5, 0, 0});
  agent.pilot = pilot(Law::avoidance);
  EXPECT_EQ(simulate(of({agent, a, b})).verdict(), ProofVerdict::touched);
}

TEST(Verdict, NamesThePairsThatAreOneBody) {
  // Two pieces that overlap and fly along together; a third that does not.
  Body c = ball("C", 1, {0, 9, 0}, {5, 0, 0});
  const auto run = simulate(of({ball("A", 1, {0, 0, 0}, {5, 0, 0}), ball("B", 1, {1, 0, 0}, {5, 0, 0}), c}));
  EXPECT_TRUE(run.proofs.empty());
  EXPECT_EQ(run.not_checked.size(), 3U);
  c.start.velocity.x() = 6;
  const auto other =
      simulate(of({ball("A", 1, {0, 0, 0}, {5, 0, 0}), ball("B", 1, {1, 0, 0}, {5, 0, 0}), c}));
  EXPECT_EQ(other.proofs.size(), 2U);
  EXPECT_EQ(other.not_checked.size(), 1U);
}

TEST(Verdict, OfCentresThatCoincide) {
  // Straight at each other: at 2 s one centre is in the other, at a command.
  for (const Law law : {Law::avoidance, Law::clearance, Law::cooperative_rendezvous}) {
    Scenario scenario = of({ball("A", 1, {0, 0, 0}, {5, 0, 0}), ball("B", 1, {20, 0, 0}, {-5, 0, 0})});
    scenario.bodies[0].pilot = pilot(law);
    scenario.bodies[0].pilot->manner = Manner::source;
    scenario.bodies[0].pilot->guide.inversion.cease = -std::numeric_limits<double>::infinity();
    scenario.bodies[0].pilot->guide.inversion.most = scenario.bodies[0].pilot->guide.clearance.most = 1e-9;
    if (law == Law::cooperative_rendezvous) scenario.bodies[0].pilot->guide.inversion.cease = 0;
    const auto run = simulate(scenario);
    EXPECT_EQ(run.verdict(), ProofVerdict::touched) << to_string(law);
    EXPECT_NEAR(run.proofs.at(0).proof.to, 1.8, 1e-6);
  }
}

TEST(Verdict, SaysWhatClearanceWasNotKept) {
  Scenario scenario = of({ball("A", 0.3, {0, 0, 0}, {5, 0, 0}), ball("B", 1, {10, 0.2, 0}, {0, 0, 0})});
  scenario.bodies[0].pilot = pilot(Law::clearance);
  scenario.bodies[0].pilot->manner = Manner::source;  // gain 1/s: not in time
  const auto run = simulate(scenario);
  EXPECT_EQ(run.verdict(), ProofVerdict::avoided);
  ASSERT_EQ(run.proofs.size(), 1U);
  EXPECT_EQ(run.proofs[0].required, 1);
  EXPECT_FALSE(run.proofs[0].kept());
  EXPECT_LT(run.proofs[0].proof.least_distance, 1);
}

}  // namespace
}  // namespace vericone::simulation::guarded_test
