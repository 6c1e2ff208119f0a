// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/geometry/assembly.h>
#include <vericone/geometry/combined.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/random_engagement.h>
#include <vericone/swarm/swarm.h>
#include <vericone/testing/random_bodies.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace vericone::swarm {
namespace {

using Eigen::Vector3d;
using Pairs = std::set<std::pair<std::size_t, std::size_t>>;

Pairs pairs_of(const std::vector<TouchedPair>& touched) {
  Pairs pairs;
  for (const TouchedPair& pair : touched) pairs.insert({pair.a, pair.b});
  return pairs;
}

/// m: so much a sampled distance may be above the least one. Two balls of 1.5 m at 2 m/s each, that touch at
/// most half of the time between two samples, 1/512 s, off: v^2 t^2 / (2 r).
constexpr double kBetween = 16.0 / 6 / 512 / 512;

struct Sampled {
  Pairs touched;
  double least = std::numeric_limits<double>::infinity();  // m, of pairs that were not
  std::vector<std::vector<double>> each;                   // m, [a][b], a < b
};

/// Balls at 32 times a step, by what they flew.
Sampled sampled(Swarm swarm, double end) {
  const std::size_t count = swarm.agents().size();
  std::vector<std::vector<double>> least(count, std::vector<double>(count, 1e9));
  while (swarm.time() < end - 1e-9) {
    swarm.step();
    for (int k = 0; k <= 32; ++k) {
      std::vector<Vector3d> places;
      for (const Flown& way : swarm.flown()) {
        const double s = std::min(swarm.options().step * k / 32, way.seconds);
        places.push_back(way.position + s * way.velocity + 0.5 * s * s * way.acceleration);
      }
      for (std::size_t b = 0; b < count; ++b)
        for (std::size_t a = 0; a < b; ++a)
          least[a][b] = std::min(least[a][b], (places[a] - places[b]).norm() - 3);
    }
  }
  Sampled found;
  for (std::size_t b = 0; b < count; ++b)
    for (std::size_t a = 0; a < b; ++a) {
      if (least[a][b] < 0) found.touched.insert({a, b});
      if (least[a][b] > kBetween) found.least = std::min(found.least, least[a][b]);
    }
  found.each = std::move(least);
  return found;
}

TEST(SwarmFlight, SaysOfOrcaWhatSamplesSay) {
  const Start start = start_of("circle", 30, 5);
  Swarm swarm(start.agents, {}, SwarmOptions::published());
  FlightOptions options;
  options.duration = 120;
  const SwarmFlight flight = fly(swarm, options);
  const Sampled truth = sampled(Swarm(start.agents, {}, SwarmOptions::published()), flight.end);
  const Pairs touched = pairs_of(flight.touched);
  ASSERT_GT(truth.touched.size(), 0u);
  EXPECT_TRUE(std::includes(touched.begin(), touched.end(), truth.touched.begin(), truth.touched.end()));
  for (const auto& [a, b] : touched) EXPECT_LT(truth.each[a][b], kBetween) << a << ' ' << b;
  // ORCA holds agents at no distance at all: such pairs may be undecided.
  for (const auto& [a, b] : pairs_of(flight.undecided))
    EXPECT_LT(std::abs(truth.each[a][b]), kBetween) << a << ' ' << b;
  EXPECT_LE(flight.least_distance, truth.least + 1e-9);
  for (const TouchedPair& pair : flight.touched) EXPECT_LE(pair.from, pair.to);
}

TEST(SwarmFlight, LeastDistanceIsThatOfSamples) {
  for (const std::uint64_t seed : {1, 2}) {
    const Start start = start_of("sphere", 30, seed);
    Swarm swarm(start.agents, {}, {});
    const SwarmFlight flight = fly(swarm, {});
    const Sampled truth = sampled(Swarm(start.agents, {}, {}), flight.end);
    EXPECT_TRUE(flight.touched.empty());
    EXPECT_TRUE(flight.undecided.empty());
    EXPECT_LE(flight.least_distance, truth.least + 1e-9);
    EXPECT_GE(flight.least_distance, 0.98 * truth.least - 1e-6);
  }
}

TEST(SwarmFlight, EveryStartIsFlownWithoutTouching) {
  for (const std::string& name : start_names()) {
    const Start start = start_of(name, 27, 4);
    Swarm swarm(start.agents, start.obstacles, {});
    FlightOptions options;
    options.duration = 300;
    const SwarmFlight flight = fly(swarm, options);
    EXPECT_TRUE(flight.touched.empty()) << name;
    EXPECT_TRUE(flight.undecided.empty()) << name;
    EXPECT_GT(flight.least_distance, 0) << name;
    for (std::size_t i = 0; i < 27; ++i) {
      EXPECT_LT(flight.arrived[i], 300) << name << i;
      EXPECT_GE(flight.path[i], flight.straight[i] - swarm.agents()[i].body.reach()) << name << i;
    }
  }
}

simulation::Body body_of(const std::string& name, const Vector3d& semi_axes, const Vector3d& position) {
  simulation::Body body;
  body.name = name;
  body.shape =
      simulation::RigidShape{WorldBody(CombinedEllipsoid(Ellipsoid::from_axes(Vector3d::Zero(), semi_axes)))};
  body.start.position = position;
  return body;
}

TEST(SwarmFlight, OfAScenarioHasItsAgentsAndWhatRests) {
  simulation::Scenario scenario;
  scenario.bodies.push_back(body_of("agent", Vector3d(2, 1, 0.5), Vector3d(0, 0.1, 0)));
  simulation::Pilot pilot;
  pilot.guide.inversion.most = 1.5;
  pilot.fastest = 1.25;
  pilot.goals.push_back({Vector3d(30, 0, 0)});
  scenario.bodies[0].pilot = pilot;
  scenario.bodies.push_back(body_of("rock", Vector3d(2, 3, 1), Vector3d(15, 0, 0)));
  scenario.bodies.push_back(body_of("building", Vector3d(1, 1, 1), Vector3d(0, 20, 0)));
  scenario.bodies[2].shape = simulation::RigidShape{WorldBody(Placed(
      Assembly::boxes({{Vector3d(0, 0, 0), Vector3d(1, 2, 4)}, {Vector3d(-1, -1, -1), Vector3d(0, 0, 0)}})))};
  const Start start = start_of(scenario);
  ASSERT_EQ(start.agents.size(), 1u);
  EXPECT_EQ(start.agents[0].body.half, Vector3d(2, 1, 0.5));
  EXPECT_EQ(start.agents[0].most, 1.5);
  EXPECT_EQ(start.agents[0].fastest, 1.25);
  EXPECT_EQ(start.agents[0].turning, 1);
  ASSERT_EQ(start.obstacles.size(), 3u);
  std::vector<Vector3d> middles, halves;
  for (const Obstacle& one : start.obstacles) {
    middles.push_back(one.position);
    halves.push_back(one.body.half);
  }
  const auto has = [&](const Vector3d& middle, const Vector3d& half) {
    for (std::size_t k = 0; k < 3; ++k)
      if (middles[k] == middle && halves[k] == half) return true;
    return false;
  };
  EXPECT_TRUE(has(Vector3d(15, 0, 0), Vector3d(2, 3, 1)));
  EXPECT_TRUE(has(Vector3d(0.5, 21, 2), Vector3d(0.5, 1, 2)));
  EXPECT_TRUE(has(Vector3d(-0.5, 19.5, -0.5), Vector3d(0.5, 0.5, 0.5)));
  Swarm swarm(start.agents, start.obstacles, {});
  const SwarmFlight flight = fly(swarm, {});
  EXPECT_TRUE(flight.touched.empty());
  EXPECT_TRUE(flight.undecided.empty());
  EXPECT_LT(flight.arrived[0], 60);
  const auto refused = [&](auto&& change) {
    simulation::Scenario bad = scenario;
    change(bad);
    try {
      (void)start_of(bad);
    } catch (const InputError& error) {
      return error.field();
    }
    return std::string("nothing");
  };
  EXPECT_EQ(refused([](simulation::Scenario& bad) { bad.bodies[1].start.velocity.x() = 1; }),
            "bodies[1].velocity");
  EXPECT_EQ(refused([](simulation::Scenario& bad) { bad.bodies[0].pilot->goals.clear(); }),
            "bodies[0].pilot.goals");
  EXPECT_EQ(refused([](simulation::Scenario& bad) { bad.bodies[0].appears = 1; }), "bodies[0].appears");
  EXPECT_EQ(refused([](simulation::Scenario& bad) { bad.bodies[0].pilot->goals[0].stay = 1; }),
            "bodies[0].pilot.goals[0]");
  EXPECT_EQ(refused([](simulation::Scenario& bad) { bad.bodies[0].shape = bad.bodies[2].shape; }),
            "bodies[0].shape");
}

TEST(SwarmFlight, AmidBodiesHasStraightWaysThatAreFree) {
  std::vector<Obstacle> room;
  const auto wall = [&](const Vector3d& at, const Vector3d& half) {
    Obstacle one;
    one.body.box = true;
    one.body.half = half;
    one.position = at;
    room.push_back(one);
  };
  for (const double side : {-1.0, 1.0})
    for (int k = 0; k < 3; ++k) {
      Vector3d half = Vector3d::Constant(6);
      half(k) = 0.1;
      wall(side * 6 * Vector3d::Unit(k), half);
    }
  wall(Vector3d(0, 0, 0), Vector3d(0.5, 0.5, 6));
  const Start start = start_amid(room, 12, 2);
  ASSERT_EQ(start.agents.size(), 12u);
  for (const Agent& agent : start.agents) {
    EXPECT_GE((agent.goals[0] - agent.position).norm(), 3);
    for (int k = 0; k <= 100; ++k) {
      const Vector3d x = agent.position + 0.01 * k * (agent.goals[0] - agent.position);
      EXPECT_LE(x.lpNorm<Eigen::Infinity>(), 5.4);
      EXPECT_GE(x.head<2>().lpNorm<Eigen::Infinity>(), 0.85);
    }
  }
  Swarm swarm(start.agents, start.obstacles, {});
  FlightOptions options;
  options.duration = 60;
  const SwarmFlight flight = fly(swarm, options);
  EXPECT_TRUE(flight.touched.empty());
  EXPECT_TRUE(flight.undecided.empty());
  EXPECT_GT(std::count_if(flight.arrived.begin(), flight.arrived.end(), [](double t) { return t < 60; }), 9);
  EXPECT_THROW((void)start_amid(room, 10000, 2), InputError);
}

TEST(SwarmFlight, OfOneBodyPastAnotherIsInClosedForm) {
  // A ball of 1.5 m that goes straight past one at rest, 5 m beside its way: no plane ever matters.
  std::vector<Agent> agents(1);
  agents[0].body = Solid::ball(1.5);
  agents[0].goals = {Vector3d(40, 0, 0)};
  Obstacle ball;
  ball.body = Solid::ball(2);
  ball.position = Vector3d(20, 5, 0);
  Swarm swarm(agents, {ball}, {});
  const SwarmFlight flight = fly(swarm, {});
  EXPECT_NEAR(flight.least_distance, 1.5, 0.015);
  EXPECT_LE(flight.least_distance, 1.5);
  // 0.25 m and 0.5 s to 1 m/s, then 38.25 m; the steps are of 0.125 s.
  EXPECT_NEAR(flight.arrived[0], 38.75, 0.13);
  EXPECT_NEAR(flight.path[0], 38.5, 0.13);
  EXPECT_DOUBLE_EQ(flight.straight[0], 38.5);
}

TEST(SwarmFlight, IsTheSameOnAnyNumberOfThreads) {
  const Start start = start_of("sphere", 60, 2);
  std::vector<SwarmFlight> flights;
  for (const int threads : {1, 2, 4}) {
    SwarmOptions options = SwarmOptions::published();
    options.threads = threads;
    Swarm swarm(start.agents, {}, options);
    FlightOptions flown;
    flown.duration = 60;
    flights.push_back(fly(swarm, flown));
    EXPECT_EQ(flights.back().least_distance, flights[0].least_distance);
    ASSERT_EQ(flights.back().touched.size(), flights[0].touched.size());
    for (std::size_t k = 0; k < flights[0].touched.size(); ++k) {
      EXPECT_EQ(flights.back().touched[k].a, flights[0].touched[k].a);
      EXPECT_EQ(flights.back().touched[k].to, flights[0].touched[k].to);
    }
  }
  EXPECT_GT(flights[0].touched.size(), 0u);
}

/// What is said of the least distance is said of all pairs: of such, too, as sweep far in a block of time.
TEST(SwarmFlight, LeastDistancesAreOfPairsThatFlyApart) {
  std::vector<Agent> agents(2);
  for (std::size_t i = 0; i < 2; ++i) {
    const double side = i == 0 ? -1 : 1;
    agents[i].body = Solid::ball(0.2);
    agents[i].position = Vector3d(6.6 + 0.25 * side, 0, 0);
    agents[i].velocity = Vector3d(side, 0, 0);
    agents[i].wished = 1;
    agents[i].fastest = 2;
    agents[i].goals = {Vector3d(100 * side, 0, 0)};
  }
  FlightOptions options;
  options.duration = 20;
  for (const double along : {0.0, 500.0}) {  // with a third one far away
    std::vector<Agent> all = agents;
    if (along > 0) {
      all.push_back(agents[0]);
      all.back().position.y() += along;
      all.back().goals[0].y() += along;
    }
    Swarm swarm(all, {}, {});
    const SwarmFlight flight = fly(swarm, options);
    EXPECT_TRUE(flight.touched.empty());
    EXPECT_LE(flight.least_distance, 0.1);
    EXPECT_GT(flight.least_distance, 0.09);
  }
  // Nobody is proved of where roundings are more than what is counted.
  agents[1].fastest = 1e5;
  agents[1].wished = 1e5;
  agents[1].most = 1e5;
  agents[1].goals = {Vector3d(9.9e4, 0, 0)};
  agents[1].velocity = Vector3d(9e4, 0, 0);
  agents[1].position.x() = 9.99e4;
  EXPECT_THROW(
      {
        Swarm swarm(agents, {}, {});
        fly(swarm, options);
      },
      InputError);
}

// Two balls at rest, whose distance a square root tells.
TEST(SwarmFlight, LeastDistancesAreNoMoreThanTheyAre) {
  testing::RandomBodies random(12);
  for (int i = 0; i < 20; ++i) {
    std::vector<Agent> agents(2);
    agents[0].body = Solid::ball(0.3);
    agents[1].body = Solid::ball(random.uniform(0.2, 0.4));
    agents[1].position = random.uniform(4, 6) * random.direction();
    for (Agent& agent : agents) agent.goals = {agent.position};
    const long double x = agents[1].position.x(), y = agents[1].position.y(), z = agents[1].position.z();
    const long double apart =
        std::sqrt(x * x + y * y + z * z) - agents[0].body.half.x() - agents[1].body.half.x();
    Swarm swarm(agents, {}, {});
    FlightOptions options;
    options.duration = 1;
    const SwarmFlight flight = fly(swarm, options);
    EXPECT_LE(flight.least_distance, apart);
    EXPECT_GE(flight.least_distance, apart - 1e-6L);
  }
}

// A step that is no binary fraction: after 5,000 s the time is known to 1e-12 s, and 10 m/s is fast.
TEST(SwarmFlight, IsProvedHoweverLateItPassesTheOrigin) {
  std::vector<Agent> agents(1);
  agents[0].body = Solid::ball(0.3);
  agents[0].position = {-50000, 0.01, 0};
  agents[0].goals = {Vector3d(100, 0, 0)};
  agents[0].wished = agents[0].fastest = 10;
  agents[0].most = 5;
  Obstacle ball;
  ball.body = Solid::ball(0.5);
  ball.position = {0, 2.5, 0};
  SwarmOptions fine;
  fine.step = 0.1;
  Swarm swarm(agents, {ball}, fine);
  FlightOptions options;
  options.duration = 6000;
  options.sample = 1000;
  const SwarmFlight flight = fly(swarm, options);
  EXPECT_TRUE(flight.touched.empty() && flight.undecided.empty());
  EXPECT_NEAR(flight.least_distance, 1.7, 0.1);
}

TEST(SwarmFlight, LastsNoLongerThanItMay) {
  const Start start = start_of("circle", 5, 1);
  SwarmOptions coarse;
  coarse.step = 0.4;
  Swarm swarm(start.agents, {}, coarse);
  FlightOptions options;
  options.duration = 1;
  EXPECT_NEAR(fly(swarm, options).end, 0.8, 1e-9);
}

TEST(SwarmFlight, RefusesTimesThatAreNone) {
  Swarm swarm(start_of("circle", 3, 1).agents, {}, {});
  FlightOptions options;
  for (const double duration : {0.0, 0.1}) {  // shorter than a step
    options.duration = duration;
    EXPECT_THROW(fly(swarm, options), InputError);
  }
  EXPECT_THROW(start_of("square", 3, 1), InputError);
  EXPECT_THROW(start_of("circle", 0, 1), InputError);
}

}  // namespace
}  // namespace vericone::swarm
