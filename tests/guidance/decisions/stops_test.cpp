// SPDX-License-Identifier: BSD-3-Clause
//
// A pilot that may change its speed has a stop in hand at every step: in buildings, among walls and traffic,
// with hardly any time to decide. Distances of a ball to boxes and balls, in closed form.
#include <gtest/gtest.h>
#include <vericone/guidance/navigator.h>
#include <vericone/testing/random_bodies.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <optional>
#include <vector>

#include "support/campaign.h"
#include "support/hall.h"

namespace vericone::guidance::stops_test {
namespace {

using Eigen::Vector3d;
using testing::campaign_size, testing::from_environment, testing::RandomBodies;

constexpr double kMost = 3, kStep = 0.05, kRadius = 0.3, kRequired = 0.1;

struct Ball {
  Vector3d center, velocity;
  double radius;
};

struct World {
  std::vector<Box> boxes;
  std::vector<Ball> balls;
  Vector3d start, velocity, goal;

  double apart(const Vector3d& x, double t) const {
    double least = testing::distance(x, boxes);
    for (const Ball& ball : balls)
      least = std::min(least, (ball.center + t * ball.velocity - x).norm() - ball.radius);
    return least - kRadius;
  }
};

World in_a_hall(RandomBodies& random, bool traffic) {
  World world;
  world.boxes = testing::hall(random, 1.3);
  const auto free = [&] {
    while (true) {
      const Vector3d x(random.uniform(-5.5, 5.5), random.uniform(-5.5, 5.5), random.uniform(0.6, 3.4));
      if (world.apart(x, 0) > 0.4) return x;
    }
  };
  world.start = free();
  world.goal = free();
  world.velocity = Vector3d::Zero();
  if (random.coin()) {
    // Slow enough to stop.
    const Vector3d v = random.uniform(0, 1.2) * random.direction();
    bool clear = true;
    for (double t = 0; t < 0.5; t += 0.02) clear &= world.apart(world.start + t * v, 0) > 0.3;
    if (clear) world.velocity = v;
  }
  if (traffic)
    for (int i = random.integer(1, 3); i > 0; --i) {
      const Vector3d v = random.uniform(0.3, 3) * random.direction();
      world.balls.push_back(
          {world.start + random.uniform(4, 15) * random.direction(), v, random.uniform(0.1, 0.4)});
    }
  return world;
}

struct Flown {
  double least = std::numeric_limits<double>::infinity();  // m
  double arrived = -1;                                     // s
  double hit = -1, said = -1;                              // s: touched; that it cannot avoid
  double fast = 0;                                         // m/s
};

Flown fly(const World& world, const Navigator& fresh, double until) {
  Navigator navigator = fresh;
  Flown flown;
  Vector3d x = world.start, v = world.velocity;
  BodyState building;
  building.shape = Placed(vericone::Body(Assembly::boxes(world.boxes)));
  std::vector<BodyState> others{building};
  for (const Ball& ball : world.balls) {
    BodyState other;
    other.shape = CombinedEllipsoid(Ellipsoid::from_axes(ball.center, Vector3d::Constant(ball.radius)));
    other.position = ball.center;
    other.velocity = ball.velocity;
    others.push_back(other);
  }
  for (double t = 0; t < until; t += kStep) {
    BodyState agent;
    agent.shape = CombinedEllipsoid(Ellipsoid::from_axes(x, Vector3d::Constant(kRadius)));
    agent.position = x;
    agent.velocity = v;
    for (std::size_t i = 0; i < world.balls.size(); ++i) {
      others[i + 1].position = world.balls[i].center + t * world.balls[i].velocity;
      others[i + 1].shape = CombinedEllipsoid(
          Ellipsoid::from_axes(others[i + 1].position, Vector3d::Constant(world.balls[i].radius)));
    }
    const NavigatorStep said =
        navigator.step(agent, others, Destination{.point = world.goal, .most = kMost}, t, kStep);
    EXPECT_LE(said.acceleration.norm(), kMost * (1 + 1e-5));
    if (said.status == NavigatorStatus::cannot_avoid && flown.said < 0) flown.said = t;
    for (int k = 1; k <= 5; ++k) {
      const double s = kStep * k / 5;
      const double apart = world.apart(x + s * v + 0.5 * s * s * said.acceleration, t + s);
      flown.least = std::min(flown.least, apart);
      if (apart <= 0 && flown.hit < 0) flown.hit = t + s;
    }
    x += kStep * v + 0.5 * kStep * kStep * said.acceleration;
    v += kStep * said.acceleration;
    flown.fast = std::max(flown.fast, v.norm());
    if (flown.arrived < 0 && (x - world.goal).norm() < 0.5) flown.arrived = t;
    if (flown.arrived >= 0 || flown.hit >= 0) break;
  }
  return flown;
}

Navigator pilot(std::size_t looks = 0) {
  return Navigator({.required = kRequired,
                    .beyond = 0.05,
                    .most = kMost,
                    .longitudinal = true,
                    .fastest = 3,
                    .range = 30,
                    .looks = looks});
}

TEST(Stops, InHallsNothingIsEverTouched) {
  const int count = static_cast<int>(from_environment("VERICONE_CASES", campaign_size(20, 2'000)));
  int arrived = 0;
  for (int i = 0; i < count; ++i) {
    RandomBodies random(1000 + i);
    const World world = in_a_hall(random, false);
    const Flown flown = fly(world, pilot(), 40);
    EXPECT_GT(flown.least, 0) << i;
    EXPECT_LT(flown.said, 0) << i;
    EXPECT_LE(flown.fast, 3 * (1 + 1e-9));
    arrived += flown.arrived >= 0;
  }
  std::cout << "[ halls    ] " << count << ": arrived " << arrived << '\n';
}

TEST(Stops, WithHardlyAnyTimeToDecideEither) {
  const int count = static_cast<int>(from_environment("VERICONE_CASES", campaign_size(20, 2'000)));
  int arrived = 0;
  for (int i = 0; i < count; ++i) {
    RandomBodies random(1000 + i);
    const World world = in_a_hall(random, false);
    const Flown flown = fly(world, pilot(1 + i % 30), 40);
    EXPECT_GT(flown.least, 0) << i;
    EXPECT_LT(flown.said, 0) << i;
    arrived += flown.arrived >= 0;
  }
  std::cout << "[ no time  ] " << count << ": arrived " << arrived << '\n';
}

/// Traffic keeps its velocity: what is hit was said to be so before.
TEST(Stops, AmongTrafficWhatHitsIsSaidBefore) {
  const int count = static_cast<int>(from_environment("VERICONE_CASES", campaign_size(20, 2'000)));
  int arrived = 0, hit = 0, said = 0;
  for (int i = 0; i < count; ++i) {
    RandomBodies random(1000 + i);
    const World world = in_a_hall(random, true);
    const Flown flown = fly(world, pilot(), 40);
    arrived += flown.arrived >= 0;
    hit += flown.hit >= 0;
    said += flown.said >= 0;
    if (flown.hit >= 0) {
      EXPECT_TRUE(flown.said >= 0 && flown.said < flown.hit) << i;
    }
  }
  std::cout << "[ traffic  ] " << count << ": arrived " << arrived << ", hit " << hit << ", said " << said
            << '\n';
}

}  // namespace
}  // namespace vericone::guidance::stops_test
