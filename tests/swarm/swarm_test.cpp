// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/random_engagement.h>
#include <vericone/swarm/swarm.h>
#include <Eigen/Geometry>
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

TEST(Swarm, TurnsBodiesTowardsTheirVelocityAsFastAsTheyMay) {
  std::vector<Agent> agents(1);
  agents[0].body.half = Vector3d(3, 0.75, 0.5);
  agents[0].goals = {Vector3d(-5, 30, 4)};
  agents[0].turning = 0.8;
  Swarm swarm(agents, {}, {});
  double most = 0;
  while (swarm.time() < 10) {
    const Eigen::Matrix3d before = swarm.agents()[0].body.rotation;
    swarm.step();
    const Eigen::Matrix3d after = swarm.agents()[0].body.rotation;
    const Eigen::AngleAxisd turn(Eigen::Matrix3d(after * before.transpose()));
    most = std::max(most, turn.angle());
    EXPECT_LT((swarm.flown()[0].turn - turn.angle() * turn.axis()).norm(), 1e-7);
  }
  EXPECT_NEAR(most, 0.8 * 0.125, 1e-9);
  const Agent& agent = swarm.agents()[0];
  EXPECT_LT((agent.body.rotation.col(0) - agent.velocity.normalized()).norm(), 1e-5);
}

TEST(Swarm, LeavesOutNoPlaneThatBinds) {
  // Of agents that reach any velocity in a step: the one nearest to the wish in the planes of all others.
  using engagements::Random;
  int bound = 0, compared = 0;
  for (std::uint64_t world = 0; world < 12; ++world) {
    Random random(451, world);
    std::vector<Agent> agents;
    while (agents.size() < 25) {
      Agent agent;
      agent.body.half = Vector3d(1.5, 0.5, 0.4);
      agent.body.rotation = random.rotation();
      agent.position = random.uniform(0, 14) * random.direction();
      agent.velocity = random.uniform(0, 1.5) * random.direction();
      agent.goals = {30 * random.direction()};
      agent.most = 1000;
      if (std::all_of(agents.begin(), agents.end(),
                      [&](const Agent& other) { return (other.position - agent.position).norm() > 4; }))
        agents.push_back(agent);
    }
    SwarmOptions options;
    options.neighbours = 100;
    options.sight = 60;
    Swarm swarm(agents, {}, options);
    swarm.step();
    for (std::size_t i = 0; i < agents.size(); ++i) {
      const auto roomy = [](Solid body) {
        body.half *= 1.1;
        return body;
      };
      std::vector<VelocityHalfSpace> planes;
      for (std::size_t j = 0; j < agents.size(); ++j) {
        if (j == i) continue;
        const ReciprocalPlane plane = reciprocal_plane(
            roomy(agents[i].body), roomy(agents[j].body), agents[j].position - agents[i].position,
            agents[i].velocity - agents[j].velocity, options.horizon, Nearest::in_speed);
        planes.push_back({plane.normal, plane.normal.dot(agents[i].velocity + 0.5 * plane.change)});
      }
      const Vector3d wish = (agents[i].goals[0] - agents[i].position).normalized();
      const VelocityFound found = nearest_velocity(planes, 2, wish);
      if (found.violation > 0) continue;
      ++compared;
      bound += (found.velocity - wish).norm() > 0.05;
      EXPECT_LT((swarm.agents()[i].velocity - found.velocity).norm(), 1e-9) << world << ' ' << i;
    }
  }
  EXPECT_GT(compared, 200);
  EXPECT_GT(bound, 60);
}

TEST(Swarm, AnOwnLawFliesAmongOthersAndTouchesNobody) {
  // It heads for its goal as hard as it can and looks at nobody.
  Start start = start_of("circle", 24, 3);
  for (Agent& agent : start.agents) agent.most = 1;
  std::size_t most_seen = 0;
  start.agents[0].share = 0;
  start.agents[0].steering = [&, goal = start.agents[0].goals[0]](
                                 double, const guidance::BodyState& self,
                                 const std::vector<guidance::BodyState>& others) -> Vector3d {
    most_seen = std::max(most_seen, others.size());
    for (const guidance::BodyState& other : others) EXPECT_GT((other.position - self.position).norm(), 3);
    return 10 * (goal - self.position);
  };
  Swarm swarm(start.agents, {}, {});
  double fastest = 0;
  while (swarm.time() < 30) {
    swarm.step();
    fastest = std::max(fastest, swarm.agents()[0].velocity.norm());
    ASSERT_GT(least_of_stops(swarm.agents()), 0) << swarm.time();
  }
  EXPECT_NEAR(fastest, 2, 1e-9);
  EXPECT_GT(most_seen, 5u);
  start.agents[0].steering = [](double, const guidance::BodyState&, const std::vector<guidance::BodyState>&) {
    return Vector3d(std::nan(""), 0, 0);
  };
  Swarm broken(start.agents, {}, {});
  EXPECT_THROW(broken.step(), InputError);
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
  bad[1].turning = -1;
  EXPECT_EQ(refused(bad), "agents[1].turning");
  bad = good;
  bad[1].body.rotation.col(0) *= -1;
  EXPECT_EQ(refused(bad), "agents[1].body.rotation");
  bad = good;
  bad[0].most = 5e-324;
  EXPECT_EQ(refused(bad), "agents[0].most");
  bad = good;
  bad[0].body.half.x() = 1e6;
  EXPECT_EQ(refused(bad), "agents[0].body.half[0]");
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
