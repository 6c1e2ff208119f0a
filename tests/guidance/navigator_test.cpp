// SPDX-License-Identifier: BSD-3-Clause
//
// What a navigator foresees, against the same flight sampled; what it decides, against symmetries.
#include <gtest/gtest.h>
#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/cones/pair.h>
#include <vericone/geometry/error.h>
#include <vericone/guidance/navigator.h>
#include <vericone/testing/random_bodies.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <vector>

#include "support/allocations.h"

namespace vericone::guidance::navigator_test {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;
using testing::RandomBodies;

BodyState body(const Ellipsoid& shape, const Vector3d& velocity, Turning turning = Turning::none) {
  BodyState state;
  state.shape = CombinedEllipsoid(shape);
  state.position = shape.center();
  state.velocity = velocity;
  state.turning = turning;
  return state;
}

BodyState placed(const Placed& where, const Vector3d& velocity) {
  BodyState state;
  state.shape = where;
  state.position = where.pose.position;
  state.velocity = velocity;
  return state;
}

/// 2.5 m wide and high from x = -5 m to an end at x = 10 m.
Placed corridor() {
  std::vector<Box> boxes;
  for (int k = -50; k < 100; ++k)
    for (int j = -13; j < 13; ++j) {
      const double x = 0.1 * k, y = 0.1 * j;
      for (const double z : {-1.35, 1.25}) boxes.push_back({{x, y, z}, {x + 0.1, y + 0.1, z + 0.1}});
      for (const double side : {-1.35, 1.25}) boxes.push_back({{x, side, y}, {x + 0.1, side + 0.1, y + 0.1}});
    }
  for (const double x : {-5.1, 10.0}) boxes.push_back({{x, -1.3, -1.3}, {x + 0.1, 1.3, 1.3}});
  return Placed(vericone::Body(Assembly::boxes(std::move(boxes))));
}

struct Scene {
  BodyState agent;
  std::vector<BodyState> others;
};

Scene scene(RandomBodies& random, int count) {
  const Ellipsoid shape = random.ellipsoid({0, 0, 0}, 0.2, 1);
  Scene s{body(shape, random.uniform(2, 8) * random.direction(), Turning::with_heading), {}};
  while (int(s.others.size()) < count) {
    const Ellipsoid other = random.ellipsoid(random.uniform(5, 30) * random.direction(), 0.5, 3);
    if (separation(shape, other).distance < 1) continue;
    s.others.push_back(body(other, random.coin() ? Vector3d(Vector3d::Zero()) : Vector3d(random.in_box(5))));
  }
  return s;
}

/// Flies the steps one after the other, each command held, and everything sampled between them: the least
/// distance to each body.
double flown(Scene s, Navigator& navigator, const std::optional<Destination>& destination, double step,
             int steps) {
  constexpr int kSamples = 4;
  double least = std::numeric_limits<double>::infinity();
  auto ellipsoid = [](const BodyState& b) { return b.shape.quadric()->ellipsoid(); };
  for (int k = 0; k < steps; ++k) {
    const NavigatorStep said = navigator.step(s.agent, s.others, destination, k * step, step);
    for (int i = 0; i < kSamples; ++i) {
      // On a circle: the command turns the velocity and the body with it.
      const double speed = s.agent.velocity.norm(), dt = step / kSamples;
      const double angle = said.acceleration.norm() / speed * dt;
      Matrix3d turn = Matrix3d::Identity();
      if (angle > 0) {
        // The command stays across the velocity.
        const Vector3d axis = s.agent.velocity.cross(said.acceleration).normalized();
        turn = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
      }
      const Vector3d before = s.agent.velocity;
      s.agent.velocity = (turn * before).normalized() * speed;
      s.agent.position += 0.5 * (before + s.agent.velocity) * dt;
      const Ellipsoid old = ellipsoid(s.agent);
      Matrix3d directions = turn * old.axis_directions();
      if (directions.determinant() < 0) directions.col(2) *= -1;
      s.agent.shape = CombinedEllipsoid(Ellipsoid::from_axes(s.agent.position, old.semi_axes(), directions));
      for (BodyState& other : s.others) {
        other.position += dt * other.velocity;
        other.shape = CombinedEllipsoid(ellipsoid(other).translated(dt * other.velocity));
        least = std::min(least, separation(ellipsoid(s.agent), ellipsoid(other)).distance);
      }
    }
  }
  return least;
}

TEST(Navigator, WhatItFliesStaysClear) {
  RandomBodies random(71);
  SCOPED_TRACE(random.trace());
  int safe = 0;
  for (int i = 0; i < 40; ++i) {
    const Scene s = scene(random, random.integer(1, 6));
    std::optional<Destination> destination;
    if (random.coin()) destination = {40 * random.direction(), 8};
    const NavigatorOptions options{.required = 0.2, .beyond = 0.1, .most = 8};
    Navigator navigator(options), again(options);
    const NavigatorStep first = again.step(s.agent, s.others, destination, 0, 0.02);
    if (first.status == NavigatorStatus::too_near || first.status == NavigatorStatus::cannot_avoid) continue;
    ++safe;
    EXPECT_GE(flown(s, navigator, destination, 0.02, 500), 0.2 - 0.02) << i;
  }
  EXPECT_GT(safe, 30);
}

TEST(Navigator, KeepsStraightOnAndKeepsItsSpeed) {
  RandomBodies random(72);
  for (int i = 0; i < 50; ++i) {
    const Scene s = scene(random, 3);
    Navigator navigator({.required = 0.2, .beyond = 0.1, .most = 8});
    const NavigatorStep said = navigator.step(s.agent, s.others, std::nullopt, 0, 0.02);
    EXPECT_NEAR(said.acceleration.dot(s.agent.velocity), 0, 1e-9);
    EXPECT_LE(said.acceleration.norm(), 8 * (1 + 1e-12));
    if (said.status == NavigatorStatus::straight) {
      EXPECT_EQ(said.acceleration.norm(), 0);
    }
    // Straight exactly where the lines of motion pass far enough, by the predicate that it is made of.
    bool clear = true;
    for (const BodyState& other : s.others) {
      const Clearance pass = clearance(s.agent.shape.quadric()->ellipsoid(),
                                       other.shape.quadric()->ellipsoid(), s.agent.velocity - other.velocity);
      clear &= pass.distance >= 0.3 ||
               (s.agent.velocity - other.velocity).dot(other.position - s.agent.position) < 0;
    }
    if (clear) {
      EXPECT_EQ(said.status, NavigatorStatus::straight) << i;
    }
  }
}

TEST(Navigator, CommandsTurnWithTheScene) {
  RandomBodies random(73);
  for (int i = 0; i < 20; ++i) {
    const double angle = random.uniform(0, 6);
    const Matrix3d turn = Eigen::AngleAxisd(angle, Vector3d::UnitZ()).toRotationMatrix();
    // In the plane: directions are tried outwards from the wanted one, so a turned scene is answered turned.
    const auto at = [&](const Matrix3d& r) {
      const auto state = [&](double radius, const Vector3d& x, const Vector3d& v) {
        BodyState b;
        b.position = r * x;
        b.velocity = r * v;
        b.shape =
            CombinedEllipse(Ellipse::from_axes(b.position.head<2>(), Eigen::Vector2d::Constant(radius)));
        return b;
      };
      const std::vector<BodyState> others{state(1, {10, 0.3, 0}, {0, 0, 0}),
                                          state(2, {20, 5, 0}, {-1, -1, 0})};
      Navigator navigator({.required = 0.2, .beyond = 0.1, .most = 8});
      return navigator.step(state(0.4, {0, 0, 0}, {5, 0, 0}), others, Destination{r * Vector3d(40, 1, 0), 8},
                            0, 0.02);
    };
    const NavigatorStep one = at(Matrix3d::Identity()), two = at(turn);
    EXPECT_EQ(one.status, two.status);
    EXPECT_LT((turn * one.acceleration - two.acceleration).norm(), 1e-9 * (1 + one.acceleration.norm()));
  }
}

TEST(Navigator, AllocatesNothingOnceItHasSearched) {
  RandomBodies random(74);
  for (int i = 0; i < 10; ++i) {
    const Scene s = scene(random, 6);
    Navigator navigator({.required = 50, .beyond = 0.1, .most = 8});  // nothing is safe: it searches
    navigator.step(s.agent, s.others, std::nullopt, 0, 0.02);
    const std::size_t before = testing::allocations();
    navigator.step(s.agent, s.others, std::nullopt, 1, 0.02);
    EXPECT_EQ(testing::allocations(), before);
  }
}

TEST(Navigator, AllocatesNothingAmongAHundred) {
  RandomBodies random(79);
  for (const bool longitudinal : {false, true}) {
    Scene s = scene(random, 100);
    Navigator navigator({.required = 0.2, .beyond = 0.1, .most = 8, .longitudinal = longitudinal});
    const Destination destination{40 * random.direction(), 8};
    std::size_t before = 0;
    for (int k = 0; k < 40; ++k) {
      if (k == 1) before = testing::allocations();
      navigator.step(s.agent, s.others, destination, 0.05 * k, 0.05);
    }
    EXPECT_EQ(testing::allocations(), before) << longitudinal;
  }
}

TEST(Navigator, AllocatesNothingInAMapEither) {
  Navigator navigator({.required = 5, .beyond = 0.1, .most = 8});  // nothing is safe: it searches
  const BodyState agent = body(Ellipsoid::from_axes({0, 0, 0}, {0.3, 0.3, 0.1}), {3, 0, 0});
  const std::vector<BodyState> others{placed(corridor(), {0, 0, 0})};
  navigator.step(agent, others, std::nullopt, 0, 0.02);
  const std::size_t before = testing::allocations();
  navigator.step(agent, others, std::nullopt, 1, 0.02);
  EXPECT_EQ(testing::allocations(), before);
}

/// Near bodies, most of which cannot all be kept away from.
Scene crowd(RandomBodies& random) {
  Scene s{body(random.ellipsoid({0, 0, 0}, 0.2, 0.6), random.uniform(4, 10) * random.direction(),
               random.coin() ? Turning::with_heading : Turning::none),
          {}};
  const int count = random.integer(1, 4);
  while (int(s.others.size()) < count) {
    const Vector3d there = random.uniform(1, 4) * (s.agent.velocity.normalized() + 0.5 * random.direction());
    const Ellipsoid other = random.ellipsoid(there, 0.3, 3);
    if (separation(s.agent.shape.quadric()->ellipsoid(), other).distance < 0.3) continue;
    s.others.push_back(body(other, random.coin() ? Vector3d(Vector3d::Zero()) : Vector3d(random.in_box(3))));
  }
  return s;
}

// The same courses for every margin, and of them the one that keeps most of it.
TEST(Navigator, AsksForMoreAndKeepsNoLess) {
  RandomBodies random(75);
  int hits = 0, near = 0;
  for (int i = 0; i < 25; ++i) {
    const Scene s = crowd(random);
    double kept = -std::numeric_limits<double>::infinity();
    for (const double required : {0.0, 0.01, 0.1, 0.3, 0.5}) {
      Navigator navigator({.required = required, .beyond = 0.02, .most = 4});
      const NavigatorStep said = navigator.step(s.agent, s.others, std::nullopt, 0, 0.02);
      hits += said.status == NavigatorStatus::cannot_avoid;
      near += said.status == NavigatorStatus::too_near;
      if (said.status == NavigatorStatus::cannot_avoid) {
        EXPECT_LE(said.least, 0) << i;
      } else {
        EXPECT_GT(said.least, 0) << i;
      }
      if (said.status == NavigatorStatus::straight || said.status == NavigatorStatus::avoiding) {
        EXPECT_GE(said.least, required * (1 - 1e-3) - 1e-9) << i;
      }
      // What a smaller margin keeps, as far as it is asked for.
      EXPECT_FALSE(kept > 0 && said.status == NavigatorStatus::cannot_avoid) << i;
      if (kept > 0) {
        EXPECT_GE(said.least, 0.98 * std::min(kept, required)) << i << ' ' << required;
      }
      kept = said.least;
    }
  }
  EXPECT_GT(hits, 5);
  EXPECT_GT(near, 5);
}

// 6 m before a wall of 100 m, at 20 m/s and 3 m/s^2.
TEST(Navigator, SaysThatItCannotAvoidWhateverIsRequired) {
  const BodyState agent = body(Ellipsoid::from_axes({0, 0, 0}, {0.3, 0.3, 0.1}), {20, 0, 0});
  const std::vector<BodyState> wall{body(Ellipsoid::from_axes({6, 0, 0}, {0.2, 50, 50}), {0, 0, 0})};
  for (const double required : {0.0, 0.01, 0.3, 3.0}) {
    Navigator navigator({.required = required, .beyond = {}, .most = 3});
    const NavigatorStep said = navigator.step(agent, wall, std::nullopt, 0, 0.02);
    EXPECT_EQ(said.status, NavigatorStatus::cannot_avoid);
    EXPECT_LT(said.least, -1);
  }
}

// A thick slab below: the ellipsoid about it holds the agent.
TEST(Navigator, AHullIsJudgedAsItIs) {
  std::vector<Vector3d> corners;
  for (const double x : {-200.0, 200.0})
    for (const double y : {-200.0, 200.0})
      for (const double z : {-100.0, -3.0}) corners.emplace_back(x, y, z);
  const BodyState agent = body(Ellipsoid::from_axes({0, 0, 0}, {1, 1, 1}), {10, 0, -2});
  BodyState plain = placed(Placed(vericone::Body()), {0, 0, 0}), part = plain;
  plain.shape = HullBody(corners);
  part.shape = Placed(vericone::Body(Assembly::polyhedra({HullBody(corners)})));
  const auto said = [&](const BodyState& other) {
    Navigator navigator({.required = 0.5, .most = 15});
    return navigator.step(agent, {&other, 1}, std::nullopt, 0, 0.02);
  };
  const NavigatorStep of_hull = said(plain), of_part = said(part);
  EXPECT_EQ(of_hull.status, NavigatorStatus::avoiding);
  EXPECT_EQ(of_hull.status, of_part.status);
  EXPECT_GE(of_hull.least, 0.5 - 1e-6);
  EXPECT_NEAR(of_hull.least, of_part.least, 1e-6);
}

// On a straight course: the miss distance of the pair as it is; on a circle the least distance there.
TEST(Navigator, LeastIsTheMissOfMeshesMapsAndUnions) {
  RandomBodies random(76);
  int compared = 0, circled = 0;
  for (int i = 0; i < 60; ++i) {
    const Ellipsoid shape = random.ellipsoid({0, 0, 0}, 0.1, 0.5);
    const BodyState agent = body(shape, random.uniform(1, 8) * random.direction());
    std::vector<Vector3d> points;
    std::vector<Assembly::Triangle> triangles;
    std::vector<Box> boxes;
    std::vector<CombinedEllipsoid> pieces;
    for (std::uint32_t k = 0; k < 30; ++k) {
      const Vector3d at = random.uniform(3, 9) * random.direction();
      for (int corner = 0; corner < 3; ++corner) points.push_back(at + random.in_box(0.5));
      triangles.push_back({3 * k, 3 * k + 1, 3 * k + 2});
      boxes.push_back({at, at + Vector3d(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1))});
      if (k % 5 == 0) pieces.emplace_back(random.ellipsoid(at, 0.2, 1));
    }
    const std::vector<vericone::Body> kinds{
        Assembly::mesh(points, triangles), Assembly::boxes(boxes), Assembly::cloud(points, 0.1),
        HullBody({points[0], points[1], points[2], points[5]}), vericone::Body::pieces(pieces)};
    for (const vericone::Body& kind : kinds) {
      // Turned, so that it is in no frame but its own.
      Placed where(kind, {random.in_box(0.5), random.rotation()});
      BodyState other =
          placed(where, random.coin() ? Vector3d(Vector3d::Zero()) : Vector3d(random.in_box(2)));
      Navigator navigator({.required = 0.01, .beyond = 0.01, .most = 8});
      const NavigatorStep said = navigator.step(agent, {&other, 1}, std::nullopt, 0, 0.02);
      if (said.status != NavigatorStatus::straight) continue;
      const Pair pair(vericone::Body(shape), where);
      if (!pair.relation() || *pair.relation() != Relation::disjoint) continue;
      if (said.circles < std::numeric_limits<double>::infinity()) {
        // Straight on for a step, then round: by distances at single times.
        const double speed = agent.velocity.norm(), round = 2 * std::numbers::pi * speed / 8;
        const int count = 100;
        const double span = (said.circles + round) / count;
        double nearest = std::numeric_limits<double>::infinity();
        for (int k = 0; k <= count; ++k) {
          Placed there = where;
          there.pose.position += k * span * other.velocity - navigator.planned(k * span).position;
          nearest = std::min(
              nearest, Pair(vericone::Body(shape), there).miss(Vector3d::Zero(), Vector3d::Zero()).most);
        }
        EXPECT_LE(said.least, 1.011 * nearest + 1e-3) << i << ' ' << to_string(kind.kind());
        if (other.velocity.isZero(0)) {
          EXPECT_GE(said.least, 0.989 * nearest - 0.5 * span * speed - 1e-3)
              << i << ' ' << to_string(kind.kind());
        }
        ++circled;
        continue;
      }
      const Miss miss = pair.miss(agent.velocity, other.velocity);
      // Within the bounds of a body no course is judged for longer than it takes to turn round.
      const double matters = 0.5 + std::numbers::pi * agent.velocity.norm() / 8;
      const std::optional<Contact> contact = pair.contact(agent.velocity, other.velocity);
      if ((contact ? contact->earliest : miss.time) > matters &&
          kind.bounds().contains(where.pose.to_body({0, 0, 0})))
        continue;
      ++compared;
      EXPECT_NEAR(said.least, miss.distance, 0.011 * miss.distance + 1e-3)
          << i << ' ' << to_string(kind.kind());
    }
  }
  EXPECT_GT(compared, 20);
  EXPECT_GT(circled, 20);
}

// Straight ahead the corridor is free for 10 m; then its end. A farther goal is no reason to turn now.
TEST(Navigator, InACorridorTheEndMattersWhenItIsNear) {
  const BodyState agent = body(Ellipsoid::from_axes({0, 0, 0}, {0.3, 0.3, 0.1}), {1, 0, 0});
  const std::vector<BodyState> others{placed(corridor(), {0, 0, 0})};
  for (const double goal : {5.0, 9.0, 20.0, 200.0}) {
    Navigator navigator({.required = 0.3, .beyond = 0.1, .most = 8});
    const NavigatorStep said = navigator.step(agent, others, Destination{{goal, 0, 0}, 8}, 0, 0.02);
    EXPECT_EQ(said.status, NavigatorStatus::homing) << goal;
    EXPECT_EQ(said.acceleration.norm(), 0) << goal;
  }
}

TEST(Navigator, AtRestWithoutSpeedToChangeItSaysWhatComes) {
  const BodyState still = body(Ellipsoid::from_axes({0, 0, 0}, {1, 1, 1}), {0, 0, 0});
  Navigator navigator({});
  EXPECT_EQ(navigator.step(still, {}, std::nullopt, 0, 0.02).status, NavigatorStatus::no_course);
  const std::vector<BodyState> beside{body(Ellipsoid::from_axes({9, 4, 0}, {1, 1, 1}), {-3, 0, 0})},
      at_it{body(Ellipsoid::from_axes({9, 1, 0}, {1, 1, 1}), {-3, 0, 0})};
  const NavigatorStep passes = navigator.step(still, beside, std::nullopt, 0, 0.02);
  EXPECT_EQ(passes.status, NavigatorStatus::no_course);
  EXPECT_NEAR(passes.least, 2, 1e-2);
  const NavigatorStep hits = navigator.step(still, at_it, std::nullopt, 0, 0.02);
  EXPECT_EQ(hits.status, NavigatorStatus::cannot_avoid);
  EXPECT_NEAR(hits.least, -1, 1e-2);
  EXPECT_EQ(hits.acceleration.norm(), 0);
}

TEST(Navigator, WhoMayChangeItsSpeedStartsBrakesAndStops) {
  const Ellipsoid ball = Ellipsoid::from_axes({0, 0, 0}, {0.25, 0.25, 0.1});
  for (const double speed : {0.0, 0.1, 4.0})
    for (const bool goal : {false, true}) {
      Scene s{body(ball, {speed, 0, 0}),
              {body(Ellipsoid::from_axes({15, 0.05, 0}, {0.3, 0.3, 0.3}), {-5, 0, 0})}};
      Navigator navigator({.required = 0.4, .beyond = 0.1, .most = 3, .longitudinal = true});
      std::optional<Destination> destination;
      if (goal) destination = {{0, 20, 0}, 3};
      double least = std::numeric_limits<double>::infinity(), to_goal = 20;
      for (int k = 0; k < 800; ++k) {
        const NavigatorStep said = navigator.step(s.agent, s.others, destination, 0.02 * k, 0.02);
        EXPECT_LE(said.acceleration.norm(), 3 * (1 + 1e-12));
        s.agent.position += 0.02 * s.agent.velocity + 0.0002 * said.acceleration;
        s.agent.velocity += 0.02 * said.acceleration;
        s.agent.shape = CombinedEllipsoid(ball.translated(s.agent.position));
        BodyState& other = s.others[0];
        other.position += 0.02 * other.velocity;
        other.shape = CombinedEllipsoid(other.shape.quadric()->ellipsoid().translated(0.02 * other.velocity));
        least = std::min(
            least,
            separation(s.agent.shape.quadric()->ellipsoid(), other.shape.quadric()->ellipsoid()).distance);
        to_goal = std::min(to_goal, (s.agent.position - Vector3d(0, 20, 0)).norm());
      }
      EXPECT_GE(least, 0.4 - 0.01) << speed << goal;
      if (goal && speed != 0.1) {
        EXPECT_LT(to_goal, 0.5) << speed;
      } else if (!goal) {
        EXPECT_NEAR(s.agent.velocity.norm(), speed, 1e-6) << "back to its speed";
      }
    }
}

TEST(Navigator, NamesWhatItIsNotGivenRight) {
  const auto refused = [](const NavigatorOptions& options, const Destination& destination) {
    try {
      Navigator navigator(options);
      static_cast<void>(navigator.step(body(Ellipsoid::from_axes({0, 0, 0}, {1, 1, 1}), {1, 0, 0}), {},
                                       destination, 0, 0.1));
    } catch (const InputError& error) {
      return error.field();
    }
    return std::string("nothing");
  };
  EXPECT_EQ(refused({.required = 0, .beyond = 0, .fastest = 0}, {}), "fastest");
  EXPECT_EQ(refused({.required = 0, .beyond = 0, .range = NAN}, {}), "range");
  EXPECT_EQ(refused({}, {.most = 1, .velocity = {0, NAN, 0}}), "destination.velocity[1]");
  EXPECT_EQ(refused({}, {.most = 1}), "nothing");
  const auto flown = [](const Vector3d& position, double speed) {
    try {
      BodyState agent = body(Ellipsoid::from_axes({0, 0, 0}, {1, 1, 1}), {speed, 0, 0});
      agent.position = position;
      static_cast<void>(Navigator(NavigatorOptions{}).step(agent, {}, std::nullopt, 0, 0.1));
    } catch (const InputError& error) {
      return error.field();
    }
    return std::string("nothing");
  };
  EXPECT_EQ(flown({0, 0, 0}, 1e155), "agent.velocity");
  EXPECT_EQ(flown({0, 1e155, 0}, 1), "agent.position");
}

}  // namespace
}  // namespace vericone::guidance::navigator_test
