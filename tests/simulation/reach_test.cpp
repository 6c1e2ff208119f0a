// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/geometry/error.h>
#include <vericone/simulation/reach.h>
#include <Eigen/Geometry>

#include <cmath>
#include <iostream>

#include "simulation/moving_pairs.h"
#include "simulation/passes.h"
#include "support/campaign.h"

namespace vericone::simulation::reach_test {
namespace {

using namespace passes;

constexpr double kNever = std::numeric_limits<double>::infinity();

MovingOrifice ring(const Vector3d& position, const Vector3d& velocity, double radius) {
  MovingOrifice orifice;
  orifice.name = "ring";
  orifice.opening = Opening::circle(radius);
  orifice.position = position;
  orifice.velocity = velocity;
  return orifice;
}

TEST(Reach, FirstOrificeOfTheFishIsNotReachedBefore) {
  // (2.4): at 0.13 m/s its centre not before |c + v t| = 0.13 t, which is a quadratic equation.
  MovingOrifice orifice = ring({4, 0.2, -0.5}, {0.005, -0.05, 0.01}, 1.725);
  orifice.rotation = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), Vector3d::UnitX()).matrix();
  ReachLimits limits;
  limits.speed = 0.13;
  const auto reach = earliest_passages({}, limits, {&orifice}, 120);
  const Vector3d c = orifice.position, v = orifice.velocity;
  const double a = v.squaredNorm() - 0.13 * 0.13, b = c.dot(v),
               root = (-b - std::sqrt(b * b - a * c.squaredNorm())) / a;
  EXPECT_NEAR(root, 34.13, 0.005);
  EXPECT_LE(reach[0].center.not_before, root);
  EXPECT_NEAR(reach[0].center.not_before, root, 1e-6);
  EXPECT_EQ(reach[0].center.by, ReachLimit::speed);
  // The rim's nearest point by samples.
  double edge = 120;
  for (const Vector2d& x : rim_points(orifice.opening, 3600)) {
    const Vector3d q = c + orifice.rotation.leftCols<2>() * x;
    const double half = q.dot(v);
    edge = std::min(edge, (-half - std::sqrt(half * half - a * q.squaredNorm())) / a);
  }
  // The opening's inside is nearer than its rim: straight ahead.
  EXPECT_LE(reach[0].edge.not_before, edge);
  EXPECT_LT(reach[0].edge.not_before, reach[0].center.not_before - 1);
}

TEST(Reach, EveryLimitAloneInClosedForm) {
  const MovingOrifice ahead = ring({0, 0, 10}, {0, 0, 0}, 1);  // level, 10 m above
  const auto first = [&](const ReachLimits& limits, const ReachStart& start, const MovingOrifice& orifice) {
    return earliest_passages(start, limits, {&orifice}, 1000)[0].edge;
  };
  ReachLimits limits;
  EXPECT_EQ(first(limits, {}, ahead).not_before, 0);
  limits.climb = 0.5;
  EXPECT_NEAR(first(limits, {}, ahead).not_before, 20, 1e-6);
  EXPECT_EQ(first(limits, {}, ahead).by, ReachLimit::climb);
  limits = {};
  limits.climb_jerk = 0.6;  // 10 = 0.1 t^3
  EXPECT_NEAR(first(limits, {}, ahead).not_before, std::cbrt(100), 1e-6);
  limits = {};
  limits.acceleration = 0.2;  // from rest 10 = 0.1 t^2
  EXPECT_NEAR(first(limits, {}, ahead).not_before, 10, 1e-6);
  limits = {};
  limits.top = 9;
  EXPECT_EQ(first(limits, {}, ahead).not_before, kNever);
  EXPECT_EQ(first(limits, {}, ahead).by, ReachLimit::height);
  MovingOrifice sinking = ahead;
  sinking.velocity = {0, 0, -0.1};
  EXPECT_NEAR(first(limits, {}, sinking).not_before, 10, 1e-6);
  // Behind the agent: it turns half round first. At the rate w the farthest back in the time t is
  // V (t - (pi + 2 - 2) / w ...): the integral of the cosine from pi down, its part forward.
  limits = {};
  limits.speed = 1;
  limits.turn_rate = 0.5;
  ReachStart start;
  start.velocity = {1, 0, 0};
  MovingOrifice behind = ring({-10, 0, 0}, {0, 0, 0}, 0.001);
  behind.rotation = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), Vector3d::UnitX()).matrix();
  // From pi / 2 / w on it may gain sin / w = 2 m until pi / w, then 1 m/s.
  const double turned = std::numbers::pi / 0.5;
  EXPECT_NEAR(first(limits, start, behind).not_before, turned + 8, 2e-3);
  EXPECT_EQ(first(limits, start, behind).by, ReachLimit::turning);
  limits.course_rate = std::exchange(limits.turn_rate, kNever);
  EXPECT_NEAR(first(limits, start, behind).not_before, turned + 8, 2e-3);
}

TEST(Reach, SecondOpeningsAreReachedFromTheFirst) {
  MovingOrifice first = ring({10, 0, 0}, {0, 0, 0}, 1), second = ring({-10, 0, 0}, {0, 0, 0}, 1);
  for (MovingOrifice* orifice : {&first, &second})
    orifice->rotation = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), Vector3d::UnitX()).matrix();
  ReachLimits limits;
  limits.speed = 2;
  const auto reach = earliest_passages({}, limits, {&first, &second}, 1000);
  EXPECT_NEAR(reach[0].edge.not_before, 5, 1e-6);
  EXPECT_NEAR(reach[1].edge.not_before, 15, 1e-6);
  // The first runs towards the second, faster than the agent: carries nothing, but may be passed later.
  first.velocity = {-4, 0, 0};
  const auto carried = earliest_passages({}, limits, {&first, &second}, 1000);
  EXPECT_NEAR(carried[0].edge.not_before, 10 / 6.0, 1e-6);
  EXPECT_LE(carried[1].edge.not_before, 5 + 1e-6) << "met at the second's place";
  first.appears = 6;  // 10 m away then, and 12 m within reach
  EXPECT_EQ(earliest_passages({}, limits, {&first}, 1000)[0].edge.not_before, 6);
  EXPECT_EQ(earliest_passages({}, limits, {&first}, 1000)[0].edge.by, ReachLimit::appearance);
  first.appears = 0;
  const auto never = earliest_passages({}, limits, {&first, &second}, 1);
  EXPECT_EQ(never[0].edge.not_before, kNever);
  EXPECT_EQ(never[1].edge.not_before, kNever);
}

/// Tracks that keep limits, taken from themselves: none passes before.
TEST(Reach, NoTrackPassesBefore) {
  const auto seed = static_cast<unsigned>(testing::from_environment("VERICONE_SEED", 1920));
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  const int cases = testing::campaign_size(500, 10'000);
  int passed = 0;
  double nearest = 1e9;
  for (int i = 0; i < cases; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    const Pass pass = random_pass(random, random_kind(random));
    const PassageProof proof = prove_passage(pass.agent, pass.orifice, 0, pass.end);
    if (proof.verdict != PassageVerdict::passed) continue;
    ++passed;
    ReachLimits limits;
    const Track::Bounds bounds = pass.agent.bounds(0, pass.end);
    double speed = 0, climb = 0, top = -1e9, bottom = 1e9;
    for (int j = 0; j <= 1000; ++j) {
      const Motion m = pass.agent.motion(pass.end * j / 1000);
      speed = std::max(speed, m.velocity.norm());
      climb = std::max(climb, std::abs(m.velocity.z()));
      top = std::max(top, m.position.z());
      bottom = std::min(bottom, m.position.z());
    }
    const double between = bounds.acceleration * pass.end / 1000;  // what the samples do not see
    if (i % 2 == 0) limits.speed = speed + between;
    if (i % 3 == 0) limits.climb = climb + between;
    if (i % 5 == 0 && !pass.kind.tumbles) limits.acceleration = bounds.acceleration;
    if (i % 7 == 0) {
      limits.top = top + climb * pass.end / 1000 + between;
      limits.bottom = bottom - climb * pass.end / 1000 - between;
    }
    if (pass.kind.turns) limits.turn_rate = bounds.turn_rate;
    const Motion start = pass.agent.motion(0);
    Vector3d middle = Vector3d::Zero();
    for (const Vector3d& x : pass.points) middle += x / static_cast<double>(pass.points.size());
    const auto reach = earliest_passages({0, start.position, start.velocity, 0, middle.norm()}, limits,
                                         {&pass.orifice}, pass.end);
    EXPECT_LE(reach[0].edge.not_before, proof.time);
    EXPECT_LE(reach[0].edge.not_before, reach[0].center.not_before);
    nearest = std::min(nearest, proof.time - reach[0].edge.not_before);
  }
  EXPECT_GT(passed, cases / 4);
  EXPECT_LT(nearest, 0.1);
  std::cout << "[ reach    ] " << passed << " passages of " << cases << " tracks, the nearest " << nearest
            << " s after its bound\n";
}

/// Scenarios flown by the passage law: through one or two rings, in their order.
TEST(Reach, NoRunPassesBefore) {
  const auto seed = static_cast<unsigned>(testing::from_environment("VERICONE_SEED", 1921));
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  const int cases = testing::campaign_size(200, 10'000);
  int passed = 0, unreachable = 0;
  double tightest = 0;
  for (int i = 0; i < cases; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Scenario scenario;
    scenario.duration = 30;
    scenario.step = 0.1;
    scenario.stop_when_passed = true;
    Body body;
    body.name = "A";
    body.shape = ellipsoid({0.3, 0.2, 0.2});
    body.start = {random.vector(1), random.vector(1.5), random.rotation()};
    body.appears = random.uniform(0, 1) < 0.2 ? 1 : 0;
    body.pilot.emplace().through.emplace();
    Through& through = *body.pilot->through;
    through.law = random.uniform(0, 1) < 0.8 ? Through::Law::passage : Through::Law::orifice;
    through.passage.most = through.source.most = random.uniform(0.2, 2);
    through.passage.longitudinal = random.uniform(0, 1) < 0.3;
    const int count = random.uniform(0, 1) < 0.5 ? 1 : 2;
    for (int k = 0; k < count; ++k) {
      MovingOrifice orifice = ring(random.vector(8), random.vector(0.3), random.uniform(0.8, 2));
      orifice.name = k == 0 ? "first" : "second";
      orifice.rotation = random.rotation();
      if (random.uniform(0, 1) < 0.5) orifice.spin = random.vector(0.3);
      orifice.wall = false;
      through.orifices.push_back(orifice.name);
      scenario.orifices.push_back(orifice);
    }
    scenario.bodies.push_back(body);
    const std::vector<AgentReach> reached = reach(scenario);
    ASSERT_EQ(reached.size(), 1u);
    RunOptions options;
    options.prove = options.log = false;
    const simulation::Run run = simulate(scenario, options);
    for (const Reach& one : reached[0].reach)
      if (std::isinf(one.edge.not_before)) ++unreachable;
    // In their order: events of orifices not yet due do not happen.
    for (const Event& event : run.events) {
      if (event.kind != EventKind::goes_through) continue;
      ++passed;
      const double bound = reached[0].reach[event.obstacle].edge.not_before;
      EXPECT_LE(bound, event.t + 1e-9) << event.obstacle;
      tightest = std::max(tightest, (bound - body.appears) / (event.t - body.appears));
    }
  }
  std::cout << "[ reach    ] " << passed << " passages of " << cases << " runs, bounds up to " << tightest
            << " of their times; " << unreachable << " openings proved out of reach\n";
  EXPECT_GT(passed, cases / 2);
}

TEST(Reach, LimitsThatAreNoneAreRefused) {
  const MovingOrifice orifice = ring({1, 0, 0}, {0, 0, 0}, 1);
  ReachLimits limits;
  limits.speed = -1;
  EXPECT_THROW(earliest_passages({}, limits, {&orifice}, 10), InputError);
  limits = {};
  limits.bottom = 2;
  limits.top = 1;
  EXPECT_THROW(earliest_passages({}, limits, {&orifice}, 10), InputError);
  Scenario scenario;
  scenario.bodies.emplace_back();
  EXPECT_THROW(reach(scenario), InputError);
}

}  // namespace
}  // namespace vericone::simulation::reach_test
