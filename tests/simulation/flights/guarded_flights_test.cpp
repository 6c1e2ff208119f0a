// SPDX-License-Identifier: BSD-3-Clause
//
// Agents with a goal among moving ellipsoids, by the pilot's defaults: none may touch, nearly all must
// arrive.
#include <gtest/gtest.h>
#include <vericone/simulation/run.h>
#include <vericone/testing/random_bodies.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iostream>

#include "support/campaign.h"

namespace vericone::simulation::guarded_flights_test {
namespace {

using Eigen::Vector3d;
using guidance::Law;
using testing::campaign_size, testing::from_environment, testing::RandomBodies;

constexpr double kMost = 8;  // m/s^2

/// Directions and bodies of the plane or of space.
struct World {
  RandomBodies& random;
  bool planar;

  Vector3d direction() const {
    if (!planar) return random.direction();
    const Eigen::Vector2d d = random.direction_2d();
    return {d.x(), d.y(), 0};
  }
  Body body(const std::string& name, double least, double most) const {
    Body body;
    body.name = name;
    const Vector3d axes(random.uniform(least, most), random.uniform(least, most),
                        random.uniform(least, most));
    body.orientation = Orientation::fixed;
    if (planar) {
      body.shape = RigidShape{CombinedEllipse(Ellipse::from_axes(Eigen::Vector2d::Zero(), axes.head<2>()))};
      body.start.rotation.topLeftCorner<2, 2>() = rotation_2d(random.uniform(-3, 3));
    } else {
      body.shape = RigidShape{CombinedEllipsoid(Ellipsoid::from_axes(Vector3d::Zero(), axes))};
      body.start.rotation = random.rotation();
    }
    return body;
  }
};

/// One to six bodies, most of them in the way to the goal, at rest or moving. A way round them is there by
/// construction: each body that comes within half a metre of a witness is drawn again. The witness turns
/// aside, flies straight, and turns to the goal, within the limits of the agent.
Scenario flight(std::uint64_t seed) {
  RandomBodies random(seed);
  Scenario scenario;
  scenario.step = 0.02;
  scenario.duration = 90;
  const World world{random, seed % 3 == 0};
  const double largest = seed % 2 == 0 ? 0.5 : 1.5;  // long ones turn with their heading
  Body agent = world.body("agent", 0.2, largest);
  agent.orientation = Orientation::heading;
  const double speed = random.uniform(2, 8), distance = random.uniform(30, 80);
  agent.start.velocity = speed * world.direction();
  const Vector3d to_goal = (agent.start.velocity / speed + 0.7 * world.direction()).normalized();
  Pilot& pilot = agent.pilot.emplace();
  pilot.guide.law = Law::avoidance;
  pilot.guide.inversion.most = pilot.guide.clearance.most = kMost;
  pilot.goals = {Goal{distance * to_goal, kMost, "", 1, Vector3d::Zero(), ""}};

  Body ghost = agent;
  ghost.pilot->manner = Manner::source;
  ghost.pilot->goals[0].point =
      0.5 * distance * to_goal + random.uniform(0, 0.4) * distance * world.direction();
  Scenario alone = scenario;
  alone.bodies = {ghost};
  RunOptions quick;
  quick.prove = quick.log = false;
  const Run aside = simulate(alone, quick);
  alone.bodies[0].start = aside.tracks[0].motion(aside.end);
  alone.bodies[0].pilot->goals[0].point = pilot.goals[0].point;
  const Run home = simulate(alone, quick);
  std::vector<Vector3d> witness;
  for (double t = 0; t < aside.end; t += 0.05) witness.push_back(aside.tracks[0].motion(t).position);
  for (double t = 0; t < home.end; t += 0.05) witness.push_back(home.tracks[0].motion(t).position);

  scenario.bodies = {agent};
  const int count = random.integer(1, 6);
  for (int i = 0, tries = 0; i < count && tries < 1000; ++tries) {
    Body body = world.body("b" + std::to_string(i), 0.5, 3);
    if (random.coin()) body.start.velocity = random.uniform(0, 6) * world.direction();
    // Where the straight way to the goal would be at some time, more or less.
    const double when = random.uniform(0.15, 0.9) * distance / speed;
    const Vector3d there = speed * when * to_goal + random.uniform(0, 4) * world.direction();
    body.start.position = there - when * body.start.velocity;
    bool free = (body.start.position - agent.start.position).norm() > 3 + largest + 2;
    for (std::size_t k = 0; k < witness.size() && free; ++k)
      free = (body.start.position + 0.05 * double(k) * body.start.velocity - witness[k]).norm() >
             3 + largest + 0.5;
    if (!free) continue;
    scenario.bodies.push_back(body);
    ++i;
  }
  return scenario;
}

/// Most changes of the command's direction by more than a right angle within any second.
int sign_changes(const Track& track) {
  std::vector<double> times;
  Vector3d last = Vector3d::Zero();
  for (const auto& leg : track.legs()) {
    const Vector3d a = leg->acceleration(leg->from());
    if (!(a.norm() > 1e-9)) continue;
    if (last.dot(a) < 0) times.push_back(leg->from());
    last = a;
  }
  std::size_t most = 0;
  for (std::size_t i = 0, first = 0; i < times.size(); ++i) {
    while (times[i] - times[first] > 1) ++first;
    most = std::max(most, i - first + 1);
  }
  return static_cast<int>(most);
}

struct Tally {
  int touched = 0, undecided = 0, arrived = 0, restless = 0, helpless = 0, flown = 0;
};

void fly(const Scenario& scenario, Tally& tally, std::uint64_t seed, bool report) {
  RunOptions options;
  options.log = false;
  const auto run = simulate(scenario, options);
  ++tally.flown;
  // Of the agent: other bodies may well meet each other.
  bool touched = false;
  for (const PairOutcome& pair : run.proofs)
    if (pair.a == 0) {
      touched |= pair.proof.verdict == ProofVerdict::touched;
      tally.undecided += pair.proof.verdict == ProofVerdict::undecided;
    }
  tally.touched += touched;
  const bool arrived = std::any_of(run.events.begin(), run.events.end(),
                                   [](const Event& e) { return e.kind == EventKind::reaches_goal; });
  tally.arrived += arrived;
  const bool restless = sign_changes(run.tracks[0]) > 10;
  tally.restless += restless;
  tally.helpless += std::any_of(run.events.begin(), run.events.end(),
                                [](const Event& e) { return e.kind == EventKind::cannot_avoid; });
  if (report && (touched || !arrived || restless))
    std::cout << "[ flight   ] seed " << seed << (touched ? " touched" : "")
              << (arrived ? "" : " not arrived") << (restless ? " restless" : "") << '\n';
}

TEST(GuardedFlights, ArriveAndTouchNothing) {
  const int count = static_cast<int>(from_environment("VERICONE_CASES", campaign_size(20, 10'000)));
  Tally guarded, source;
  const std::uint64_t first = from_environment("VERICONE_SEED", 1);
  for (std::uint64_t seed = first; seed < first + std::uint64_t(count); ++seed) {
    Scenario scenario = flight(seed);
    fly(scenario, guarded, seed, true);
    if (seed % 5 != 0) continue;
    scenario.bodies[0].pilot->manner = Manner::source;
    fly(scenario, source, seed, false);
  }
  std::cout << "[ flights  ] " << guarded.flown << " guarded: touched " << guarded.touched << ", undecided "
            << guarded.undecided << ", arrived " << guarded.arrived << ", restless " << guarded.restless
            << ", said to be without a course " << guarded.helpless << "; " << source.flown
            << " of them as the source flies: touched " << source.touched << ", arrived " << source.arrived
            << ", restless " << source.restless << '\n';
  EXPECT_EQ(guarded.touched, 0);
  EXPECT_EQ(guarded.undecided, 0);
  EXPECT_GE(guarded.arrived, 0.99 * guarded.flown);
  EXPECT_EQ(guarded.restless, 0);
  EXPECT_GT(source.touched, 0);  // or the flights would be too easy
}

}  // namespace
}  // namespace vericone::simulation::guarded_flights_test
