// SPDX-License-Identifier: BSD-3-Clause
//
// Random flights of pilots that may change their speed, from rest or slowly, through halls with doors and
// pillars and across traffic, by a sensor that errs and fails; a quarter of them quadrotors in gusts. What
// became of each is proved.
#include <gtest/gtest.h>
#include <vericone/simulation/run.h>
#include <vericone/testing/random_bodies.h>
#include <vericone/vehicles/quadrotor.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>

#include "support/campaign.h"
#include "support/hall.h"

namespace vericone::simulation::stopping_flights_test {
namespace {

using Eigen::Vector3d;
using testing::campaign_size, testing::from_environment, testing::RandomBodies;

Body ellipsoid(const std::string& name, const Vector3d& axes, const Vector3d& position,
               const Vector3d& velocity) {
  Body body;
  body.name = name;
  body.shape = RigidShape{CombinedEllipsoid(Ellipsoid::from_axes(Vector3d::Zero(), axes))};
  body.start.position = position;
  body.start.velocity = velocity;
  body.orientation = Orientation::fixed;
  return body;
}

Scenario flight(std::uint64_t seed) {
  RandomBodies random(seed);
  Scenario scenario;
  scenario.step = 0.05;
  scenario.duration = 40;
  scenario.seed = seed;
  const std::vector<Box> boxes = testing::hall(random, 1.6);
  const auto free = [&](double room) {
    while (true) {
      const Vector3d x(random.uniform(-5.2, 5.2), random.uniform(-5.2, 5.2), random.uniform(0.8, 3.2));
      if (testing::distance(x, boxes) > room) return x;
    }
  };
  const bool quadrotor = seed % 4 == 0;
  Body agent = ellipsoid("drone", {0.3, 0.3, 0.1}, free(quadrotor ? 1 : 0.8), Vector3d::Zero());
  Pilot& pilot = agent.pilot.emplace();
  pilot.guide.law = guidance::Law::clearance;
  pilot.guide.clearance.required = quadrotor ? 0.25 : 0.2;
  pilot.guide.clearance.beyond = 0.05;
  pilot.guide.clearance.most = quadrotor ? 2 : 3;
  pilot.guide.clearance.longitudinal = true;
  pilot.fastest = quadrotor ? 1 : 2.5;
  for (int i = random.integer(1, 2); i > 0; --i)
    pilot.goals.push_back(Goal{.point = free(0.8), .most = pilot.guide.clearance.most, .reached = 0.4});
  Sensor& sensor = pilot.sensor.emplace();
  sensor.noise = Noise::bounded;
  sensor.position = 0.03;
  sensor.velocity = 0.02;
  sensor.dropout = 0.05;
  sensor.range = 30;
  if (quadrotor) {
    agent.vehicle = vehicles::quadrotor({.drag = Vector3d::Constant(0.3)});
    scenario.water = Current(Vector3d(0.3, 0, 0), {}, Gusts{.most = 0.3, .seed = seed});
  }
  scenario.bodies.push_back(agent);
  Body building;
  building.name = "hall";
  building.shape = RigidShape{Placed(vericone::Body(Assembly::boxes(boxes)))};
  building.orientation = Orientation::fixed;
  scenario.bodies.push_back(building);
  for (int i = random.integer(0, 2); i > 0; --i) {
    const Vector3d from = agent.start.position + random.uniform(4, 12) * random.direction();
    scenario.bodies.push_back(ellipsoid("bird" + std::to_string(i),
                                        {random.uniform(0.1, 0.4), random.uniform(0.1, 0.3), 0.1}, from,
                                        random.uniform(0.3, 2) * random.direction()));
  }
  return scenario;
}

TEST(StoppingFlights, TouchNothingThatWasNotSaid) {
  const int count = static_cast<int>(from_environment("VERICONE_CASES", campaign_size(24, 10'000)));
  int touched = 0, undecided = 0, unsaid = 0, said = 0, arrived = 0;
  const std::uint64_t start = from_environment("VERICONE_SEED", 1);
  for (std::uint64_t seed = start; seed < start + std::uint64_t(count); ++seed) {
    const Scenario scenario = flight(seed);
    RunOptions options;
    options.log = false;
    const auto run = simulate(scenario, options);
    const auto first = [&](EventKind kind) {
      for (const Event& event : run.events)
        if (event.kind == kind && event.agent == 0) return event.t;
      return std::numeric_limits<double>::infinity();
    };
    bool hit = false;
    for (const PairOutcome& pair : run.proofs) {
      if (pair.a != 0) continue;  // birds fly through walls
      hit |= pair.proof.verdict == ProofVerdict::touched;
      undecided += pair.proof.verdict == ProofVerdict::undecided;
    }
    const bool there = std::count_if(run.events.begin(), run.events.end(), [](const Event& event) {
                         return event.kind == EventKind::reaches_goal;
                       }) == std::ptrdiff_t(scenario.bodies[0].pilot->goals.size());
    touched += hit;
    said += std::isfinite(first(EventKind::cannot_avoid));
    unsaid += hit && !(first(EventKind::cannot_avoid) < first(EventKind::contact));
    arrived += there;
    if (hit || !there)
      std::cout << "[ flight   ] seed " << seed << (hit ? " touched" : "") << (there ? "" : " not arrived")
                << '\n';
  }
  std::cout << "[ flights  ] " << count << ": touched " << touched << ", without having said so " << unsaid
            << ", undecided " << undecided << ", said that it cannot avoid " << said << ", arrived "
            << arrived << '\n';
  EXPECT_EQ(unsaid, 0);
  EXPECT_EQ(undecided, 0);
  EXPECT_GE(arrived, 0.9 * count);
}

}  // namespace
}  // namespace vericone::simulation::stopping_flights_test
