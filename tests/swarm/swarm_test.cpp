// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/geometry/error.h>
#include <vericone/swarm/swarm.h>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace vericone::swarm {
namespace {

using Eigen::Vector3d;

/// m: the least distance of balls that brake now, at 200 times until all are at rest.
double least_of_stops(const std::vector<Agent>& agents) {
  double least = std::numeric_limits<double>::infinity();
  const auto place = [](const Agent& agent, double t) -> Vector3d {
    const double speed = agent.velocity.norm(), s = std::min(t, speed / agent.most);
    return speed > 0 ? Vector3d(agent.position + (s - 0.5 * agent.most / speed * s * s) * agent.velocity)
                     : agent.position;
  };
  for (std::size_t i = 0; i < agents.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (int k = 0; k <= 200; ++k)
        least = std::min(least, (place(agents[i], 0.005 * k) - place(agents[j], 0.005 * k)).norm() -
                                    agents[i].body.reach() - agents[j].body.reach());
  return least;
}

void expect_stops_apart(double lost, double horizon, bool fall_back) {
  Start start = start_of("circle", 24, 3);
  for (Agent& agent : start.agents) agent.most = 1;  // m/s^2: what brakes in 0.5 m and more
  SwarmOptions options;
  options.lost = lost;
  options.horizon = horizon;
  Swarm swarm(start.agents, {}, options);
  while (swarm.time() < 25) {
    swarm.step();
    ASSERT_GT(least_of_stops(swarm.agents()), 0) << swarm.time();
  }
  EXPECT_EQ(swarm.counts().fallbacks > 0, fall_back);
}

TEST(Swarm, EveryAgentHoldsAStopApartFromAllOthersWhateverMessagesAreLost) {
  expect_stops_apart(0, 20, false);
  expect_stops_apart(0.3, 20, true);
  expect_stops_apart(0.9, 20, true);
}

TEST(Swarm, NothingTouchesWhereNoPlaneHelps) {
  // Planes that foresee a tenth of a second: what keeps agents apart is proofs alone.
  expect_stops_apart(0, 0.1, true);
  expect_stops_apart(0.3, 0.1, true);
}

/// Two who want to swap, so near that both cannot have what they want.
std::vector<Agent> two(double apart) {
  std::vector<Agent> agents(2);
  for (const int k : {0, 1}) {
    agents[k].position = Vector3d(k ? apart : -apart, 0.02 * k, 0);
    agents[k].goals = {-agents[k].position};
  }
  return agents;
}

TEST(Swarm, NobodyMovesWhereNothingIsHeardNearby) {
  SwarmOptions options;
  options.lost = 1;
  Swarm swarm(two(1.02), {}, options);
  for (int k = 0; k < 40; ++k) swarm.step();
  EXPECT_EQ(swarm.agents()[0].position, two(1.02)[0].position);
  EXPECT_EQ(swarm.agents()[1].position, two(1.02)[1].position);
}

TEST(Swarm, WhoTakesNoShareKeepsItsWayAndTheOtherLeavesIt) {
  std::vector<Agent> agents = two(12);
  agents[0].share = 0;
  Swarm swarm(agents, {}, {});
  double aside[2]{};
  while (swarm.time() < 30) {
    swarm.step();
    for (const int k : {0, 1}) aside[k] = std::max(aside[k], swarm.agents()[k].position.tail<2>().norm());
  }
  EXPECT_LT(aside[0], 0.1);
  EXPECT_GT(aside[1], 1.9);
  EXPECT_EQ(swarm.heading(), (std::vector<std::size_t>{1, 1}));
}

TEST(Swarm, IsTheSameOnAnyNumberOfThreads) {
  std::vector<Vector3d> first;
  for (const int threads : {1, 2, 4}) {
    SwarmOptions options;
    options.threads = threads;
    options.lost = 0.1;
    Start start = start_of("slender", 60, 2);
    Swarm swarm(start.agents, start.obstacles, options);
    for (int k = 0; k < 200; ++k) swarm.step();
    std::vector<Vector3d> here;
    for (const Agent& agent : swarm.agents()) here.push_back(agent.position);
    if (first.empty()) first = here;
    EXPECT_EQ(std::memcmp(first.data(), here.data(), here.size() * sizeof(Vector3d)), 0);
  }
}

TEST(Swarm, StaysWithinItsLimits) {
  Start start = start_of("sphere", 60, 1);
  Swarm swarm(start.agents, {}, {});
  while (swarm.time() < 60) {
    const std::vector<Agent> before = swarm.agents();
    swarm.step();
    for (std::size_t i = 0; i < before.size(); ++i) {
      ASSERT_LE((swarm.agents()[i].velocity - before[i].velocity).norm(), 2 * 0.125 * (1 + 1e-9));
      ASSERT_LE(swarm.agents()[i].velocity.norm(), 2 * (1 + 1e-9));
    }
  }
}

TEST(Swarm, FindsDeadlocksAndTurnsOutOfThem) {
  // A wall straight before the goal, 8 m wide: around it, to the right as seen from above.
  std::vector<Agent> agents(1);
  agents[0].body = Solid::ball(0.5);
  agents[0].goals = {Vector3d(20, 0, 0)};
  Obstacle wall;
  wall.body.box = true;
  wall.body.half = Vector3d(0.5, 4, 4);
  wall.position = Vector3d(10, 0, 0);
  Swarm swarm(agents, {wall}, {});
  double right = 0;
  while (swarm.time() < 200 && swarm.heading()[0] == 0) {
    swarm.step();
    right = std::min(right, swarm.agents()[0].position.y());
  }
  EXPECT_EQ(swarm.heading()[0], 1);
  EXPECT_GT(swarm.counts().deadlocks, 0);
  EXPECT_LT(right, -4);
}

std::string refused(std::vector<Agent> agents, const SwarmOptions& options = {},
                    std::vector<Obstacle> obstacles = {}) {
  try {
    const Swarm swarm(std::move(agents), std::move(obstacles), options);
  } catch (const InputError& error) {
    return error.field();
  }
  return "nothing";
}

TEST(Swarm, RefusesWhatItCannotFly) {
  std::vector<Agent> good = two(5);
  EXPECT_EQ(refused(good), "nothing");
  EXPECT_EQ(refused(two(0.9)), "agents[0]");
  std::vector<Agent> fast = two(1.5);  // 1 m of room, and 1 m each to brake from 2 m/s
  fast[0].velocity = Vector3d(2, 0, 0);
  fast[1].velocity = Vector3d(-2, 0, 0);
  EXPECT_EQ(refused(fast), "agents[0]");
  Obstacle ball;
  ball.position = good[1].position + Vector3d(0, 1.5, 0);
  EXPECT_EQ(refused(good, {}, {ball}), "agents[1]");
  ball.body.half.z() = 0;
  EXPECT_EQ(refused(good, {}, {ball}), "obstacles[0].body.half[2]");
  std::vector<Agent> bad = good;
  bad[1].goals.clear();
  EXPECT_EQ(refused(bad), "agents[1].goals");
  bad = good;
  bad[0].body.box = true;
  EXPECT_EQ(refused(bad), "agents[0].body.box");
  bad = good;
  bad[0].wished = 3;
  EXPECT_EQ(refused(bad), "agents[0].wished");
  bad = good;
  bad[0].position.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refused(bad), "agents[0].position");
  SwarmOptions options;
  options.step = 0;
  EXPECT_EQ(refused(good, options), "step");
}

}  // namespace
}  // namespace vericone::swarm
