// SPDX-License-Identifier: BSD-3-Clause
//
// Several goals, one after the other, that stand still, move, or follow a body.
#include <gtest/gtest.h>
#include <vericone/geometry/convex.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/simulation/flying_pilot.h>
#include <vericone/simulation/run.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace vericone::simulation::goals_test {
namespace {

using Eigen::Vector3d;

constexpr double kEver = std::numeric_limits<double>::infinity();

/// Flies straight on, and notes which goal it is told.
class Straight : public PilotModel {
 public:
  std::unique_ptr<FlyingPilot> launch(const Scenario&, std::size_t, const RunOptions&) const override {
    return std::make_unique<Flying>(*this);
  }
  struct Told {
    double t;
    std::optional<Goal> goal;
  };
  mutable std::vector<Told> told;

 private:
  struct Flying : FlyingPilot {
    explicit Flying(const Straight& model) : straight(model) {}
    void command(const Instant& now, std::span<VehicleCommand>, Run&) override {
      straight.told.push_back({now.t, now.goal ? std::optional(*now.goal) : std::nullopt});
    }
    const Straight& straight;
  };
};

Body ball(const std::string& name, const Vector3d& position, const Vector3d& velocity) {
  Body body;
  body.name = name;
  body.shape = RigidShape{CombinedEllipsoid(Ellipsoid::from_axes(Vector3d::Zero(), Vector3d::Ones()))};
  body.start.position = position;
  body.start.velocity = velocity;
  return body;
}

Goal goal(const Vector3d& point, double stay = 0) {
  Goal goal;
  goal.point = point;
  goal.most = 1;
  goal.stay = stay;
  return goal;
}

/// A flies along x at 5 m/s, far beside B.
struct Flight {
  std::shared_ptr<Straight> pilot = std::make_shared<Straight>();
  Scenario scenario;

  explicit Flight(std::vector<Goal> goals) {
    scenario.duration = 20;
    scenario.bodies = {ball("A", {0, 0, 0}, {5, 0, 0}), ball("B", {10, 50, 0}, {2, 0, 0})};
    scenario.bodies[0].pilot.emplace().own = pilot;
    scenario.bodies[0].pilot->goals = std::move(goals);
  }
  [[nodiscard]] Run run() const {
    RunOptions options;
    options.prove = false;
    return simulate(scenario, options);
  }
};

std::vector<Event> reached(const Run& run) {
  std::vector<Event> events;
  for (const Event& event : run.events)
    if (event.kind == EventKind::reaches_goal) events.push_back(event);
  return events;
}

TEST(Goals, AreReachedInOrderAndTheRunEndsAtTheLast) {
  const Flight flight({goal({20, 0, 0}), goal({40, 0, 0})});
  const auto run = flight.run();
  const auto events = reached(run);
  ASSERT_EQ(events.size(), 2u);
  EXPECT_NEAR(events[0].t, 19 / 5.0, 1e-9);
  EXPECT_NEAR(events[1].t, 39 / 5.0, 1e-9);
  EXPECT_EQ(events[0].value, 1);  // which of them
  EXPECT_EQ(events[1].value, 2);
  EXPECT_GE(run.end, events[1].t);
  EXPECT_LE(run.end, events[1].t + flight.scenario.step);
  for (const auto& told : flight.pilot->told)
    EXPECT_EQ(told.goal.value().point.x(), told.t < events[0].t ? 20 : 40) << told.t;
}

TEST(Goals, StayBeforeTheNextAndBeforeTheEnd) {
  const Flight flight({goal({20, 0, 0}, 1.5), goal({40, 0, 0}, 2)});
  const auto run = flight.run();
  const auto events = reached(run);
  ASSERT_EQ(events.size(), 2u);
  EXPECT_NEAR(events[0].t, 3.8, 1e-9);
  EXPECT_NEAR(events[1].t, 7.8, 1e-9);
  EXPECT_NEAR(run.end, 9.8, flight.scenario.step + 1e-9);
  for (const auto& told : flight.pilot->told) {
    if (std::abs(told.t - 5.3) <= flight.scenario.step) continue;
    EXPECT_EQ(told.goal.value().point.x(), told.t < 5.3 ? 20 : 40) << told.t;
  }
}

TEST(Goals, OneThatItIsAtAlreadyIsReachedAtOnce) {
  Goal wide = goal({11, 0, 0});
  wide.reached = 4;
  const auto events = reached(Flight({goal({10, 0, 0}), wide, goal({30, 0, 0})}).run());
  ASSERT_EQ(events.size(), 3u);
  EXPECT_NEAR(events[0].t, 1.8, 1e-9);
  EXPECT_NEAR(events[1].t, 1.8, 0.01 + 1e-9);
  EXPECT_NEAR(events[2].t, 5.8, 1e-9);
  // The only one, which would end the run before it began, is not.
  const Flight only({goal({0.5, 0, 0})});
  EXPECT_TRUE(reached(only.run()).empty());
  EXPECT_EQ(only.run().end, 20);
}

TEST(Goals, MoveAndFollow) {
  Goal ahead = goal({10, 0, 0}), escort = goal({0, -50, 0});
  ahead.velocity = {2, 0, 0};
  escort.follows = "B";
  for (const Goal& one : {ahead, escort}) {
    const Flight flight({one});
    const auto run = flight.run();
    // 10 + 2 t - 5 t = 1.
    ASSERT_EQ(reached(run).size(), 1u);
    EXPECT_NEAR(reached(run)[0].t, 3, 1e-9);
    for (const auto& told : flight.pilot->told) {
      EXPECT_LT((told.goal.value().point - Vector3d(10 + 2 * told.t, 0, 0)).norm(), 1e-12);
      EXPECT_EQ(told.goal->velocity, Vector3d(2, 0, 0));
    }
  }
  escort.velocity = {0, 0, 1};
  const Flight drifting({escort});
  EXPECT_TRUE(reached(drifting.run()).empty());
  for (const auto& told : drifting.pilot->told) {
    EXPECT_LT((told.goal.value().point - Vector3d(10 + 2 * told.t, 0, told.t)).norm(), 1e-12);
    EXPECT_EQ(told.goal->velocity, Vector3d(2, 0, 1));
  }
}

TEST(Goals, ThereIsNoneBeforeTheBodyThatItFollowsAppears) {
  Goal escort = goal({0, -50, 0});
  escort.follows = "B";
  Flight flight({escort});
  flight.scenario.bodies[1].appears = 1.005;
  static_cast<void>(flight.run());
  for (const auto& told : flight.pilot->told) EXPECT_EQ(told.goal.has_value(), told.t >= 1.005) << told.t;
}

TEST(Goals, AllAgentsGoToAllOfTheirs) {
  Flight flight({goal({10, 0, 0})});
  Pilot& other = flight.scenario.bodies[1].pilot.emplace();
  other.own = std::make_shared<Straight>();
  other.goals = {goal({20, 50, 0}), goal({30, 50, 0})};
  const auto run = flight.run();
  EXPECT_EQ(reached(run).size(), 3u);
  EXPECT_NEAR(run.end, 19 / 2.0, flight.scenario.step + 1e-9);
}

/// Of a guarded pilot that may change its speed: it is there as long as it is to be.
TEST(Goals, AGuardedPilotStays) {
  Scenario scenario;
  scenario.duration = 60;
  scenario.bodies = {ball("A", {0, 0, 0}, {0, 0, 0})};
  Pilot& pilot = scenario.bodies[0].pilot.emplace();
  pilot.guide.law = guidance::Law::clearance;
  pilot.guide.clearance.most = 2;
  pilot.guide.clearance.longitudinal = true;
  for (const Vector3d& point : {Vector3d(20, 0, 0), Vector3d(20, 15, 0)}) {
    pilot.goals.push_back(goal(point, 5));
    pilot.goals.back().most = 2;
  }
  const auto run = simulate(scenario);
  const auto events = reached(run);
  ASSERT_EQ(events.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i)
    for (double t = events[i].t + 1e-9; t < events[i].t + 5; t += 0.1)
      EXPECT_LT((run.tracks[0].motion(t).position - pilot.goals[i].point).norm(), 1) << t;
  EXPECT_NEAR(run.end, events[1].t + 5, scenario.step + 1e-9);
  ASSERT_EQ(run.plans.size(), 1u);
  EXPECT_EQ(run.plans[0].commands, run.times.decisions);
  EXPECT_EQ(run.plans[0].proved, run.plans[0].commands);
}

/// Round a corner, past a ball on the second leg: both legs are kept to, each until its goal is reached.
Scenario cornered() {
  Scenario scenario;
  scenario.duration = 40;
  scenario.bodies = {ball("A", {0, 0, 0}, {0, 0, 0}), ball("B", {30, 16, 0}, {0, 0, 0})};
  Pilot& pilot = scenario.bodies[0].pilot.emplace();
  pilot.guide.law = guidance::Law::clearance;
  pilot.guide.clearance.required = 0.1;
  pilot.guide.clearance.beyond = 0.1;
  pilot.guide.clearance.most = 2;
  pilot.guide.clearance.longitudinal = true;
  pilot.fastest = 3;
  pilot.goals = {goal({30, 0, 0}, 1), goal({30, 30, 0})};
  for (Goal& each : pilot.goals) each.most = 2;
  pilot.goals[0].reached = pilot.goals[1].reached = 0.5;
  pilot.goals[0].corridor = 1.5;
  pilot.goals[1].corridor = 4;
  return scenario;
}

TEST(Goals, CorridorsAreKeptTo) {
  const Scenario scenario = cornered();
  const auto run = simulate(scenario);
  std::vector<double> reached;
  for (const Event& e : run.events)
    if (e.kind == EventKind::reaches_goal) reached.push_back(e.t);
  ASSERT_EQ(reached.size(), 2U);
  double aside = 0;
  for (double t = 0; t < run.end; t += 0.01) {
    const Vector3d at = run.tracks[0].motion(t).position;
    const double first = (at - Vector3d(std::clamp(at.x(), 0.0, 30.0), 0, 0)).norm(),
                 second = (at - Vector3d(30, std::clamp(at.y(), 0.0, 30.0), 0)).norm();
    if (t < reached[0]) {
      EXPECT_LE(first + 1, 1.5) << t;
    } else if (t > reached[0] + 1) {
      EXPECT_LE(second + 1, 4) << t;
      aside = std::max(aside, second);
    }
  }
  EXPECT_GT(aside, 1);  // round the ball
  ASSERT_EQ(run.plans.size(), 1U);
  EXPECT_EQ(run.plans[0].proved, run.plans[0].commands);
}

/// m, what a ball of 1 m about A leaves of a corridor, looked at 1,000 times a second.
double room_seen(const Run& run, const CorridorOutcome& flown, const Vector3d& from, const Vector3d& to,
                 double radius) {
  double least = kEver;
  for (double t = flown.from; t <= flown.to; t += 1e-3) {
    const Vector3d c = run.tracks[0].motion(t).position - from, leg = to - from;
    const double part = std::clamp(c.dot(leg) / leg.squaredNorm(), 0.0, 1.0);
    least = std::min(least, radius - 1 - (c - part * leg).norm());
  }
  return least;
}

TEST(Goals, CorridorsAreProvedOfTheFlownTrack) {
  const auto run = simulate(cornered());
  ASSERT_EQ(run.corridors.size(), 2U);
  const Vector3d corners[] = {{0, 0, 0}, {30, 0, 0}, {30, 30, 0}};
  const double radii[] = {1.5, 4};
  for (std::size_t i = 0; i < 2; ++i) {
    const CorridorOutcome& flown = run.corridors[i];
    EXPECT_EQ(flown.goal, i);
    EXPECT_EQ(flown.from, i == 0 ? 0 : run.corridors[0].to);
    EXPECT_GE(flown.room, 0);
    EXPECT_FALSE(flown.left);
    const double seen = room_seen(run, flown, corners[i], corners[i + 1], radii[i]);
    EXPECT_LE(flown.room, seen);
    EXPECT_GE(flown.room, seen - 2e-3 * radii[i]);
  }
  EXPECT_EQ(run.corridors[1].to, run.end);
  // Too fast for the turn that it would take: out with its side, then with its middle.
  for (const double speed : {1.8, 6.0}) {
    Scenario scenario = cornered();
    scenario.bodies[0].start.velocity = {0, speed, 0};
    const auto fast = simulate(scenario);
    ASSERT_GE(fast.corridors.size(), 1U);
    const CorridorOutcome& flown = fast.corridors[0];
    const double seen = room_seen(fast, flown, corners[0], corners[1], radii[0]);
    EXPECT_LT(flown.room, 0) << speed;
    EXPECT_LE(flown.room, seen);
    EXPECT_GE(flown.room, seen - 2e-3 * radii[0]);
    EXPECT_EQ(flown.left, seen + 1 < 0) << speed;
  }
}

TEST(Goals, CorridorsThatCannotBeKeptAreRefused) {
  const auto refused = [](void (*spoil)(Pilot&)) -> std::string {
    Scenario scenario = cornered();
    spoil(*scenario.bodies[0].pilot);
    try {
      static_cast<void>(simulate(scenario));
      return "nothing";
    } catch (const InputError& e) {
      return e.field();
    }
  };
  const std::string pilot = "bodies[0].pilot.";
  EXPECT_EQ(refused([](Pilot& p) { p.goals[1].velocity = {1, 0, 0}; }), pilot + "goals[1].corridor");
  EXPECT_EQ(refused([](Pilot& p) { p.goals[0].corridor = kEver, p.goals[0].follows = "B"; }),
            pilot + "goals[1].corridor");
  EXPECT_EQ(refused([](Pilot& p) { p.goals[1].from = {kEver, 0, 0}; }), pilot + "goals[1].from");
  EXPECT_EQ(refused([](Pilot& p) { p.guide.clearance.longitudinal = false, p.fastest = kEver; }),
            pilot + "goals[0].corridor");
  // Of each body its own bound of accelerations, by name.
  EXPECT_EQ(refused([](Pilot& p) { p.others_most_of = {{"C", 1}}; }), pilot + "others_most");
  EXPECT_EQ(refused([](Pilot& p) { p.others_most_of = {{"B", -1}}; }), pilot + "others_most.B");
}

/// Cylinders, margins and unions of them are minded as others are.
TEST(Goals, GuardedPilotsMindRoundParts) {
  for (const vericone::Body& other :
       {vericone::Body(Convex::cylinder(1, 2)),
        vericone::Body(Assembly::convexes({Convex::capsule(1, 2), Convex::disc(3)}))}) {
    Scenario scenario = cornered();
    scenario.bodies[1].shape = RigidShape{Placed(other)};
    EXPECT_NO_THROW(check(scenario));
  }
}

TEST(Goals, WhatCannotBeIsRefusedByName) {
  const auto refused = [](void (*spoil)(Goal&)) -> std::string {
    Flight flight({goal({20, 0, 0}), goal({40, 0, 0})});
    spoil(flight.scenario.bodies[0].pilot->goals[1]);
    try {
      static_cast<void>(flight.run());
      return "nothing";
    } catch (const InputError& e) {
      return e.field();
    }
  };
  const std::string path = "bodies[0].pilot.goals[1].";
  EXPECT_EQ(refused([](Goal& g) { g.follows = "A"; }), path + "follows");
  EXPECT_EQ(refused([](Goal& g) { g.follows = "C"; }), path + "follows");
  EXPECT_EQ(refused([](Goal& g) { g.stay = -1; }), path + "stay");
  EXPECT_EQ(refused([](Goal& g) { g.velocity.y() = std::numeric_limits<double>::infinity(); }),
            path + "velocity");
  EXPECT_EQ(refused([](Goal& g) { g.reached = 0; }), path + "reached");
  EXPECT_EQ(refused([](Goal& g) { g.corridor = 0; }), path + "corridor");
  EXPECT_EQ(refused([](Goal& g) { g.corridor = 3; }), path + "corridor");  // its own pilot knows none
  EXPECT_EQ(refused([](Goal& g) { g.follows = "B"; }), "nothing");
}

}  // namespace
}  // namespace vericone::simulation::goals_test
