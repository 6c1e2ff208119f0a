// SPDX-License-Identifier: BSD-3-Clause
//
// What a navigator foresees, against the same flight sampled; what it decides, against symmetries.
#include <gtest/gtest.h>
#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/guidance/navigator.h>
#include <vericone/testing/random_bodies.h>

#include <Eigen/Geometry>
#include <cmath>
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

TEST(Navigator, AtRestThereIsNoCourse) {
  Navigator navigator({});
  const BodyState still = body(Ellipsoid::from_axes({0, 0, 0}, {1, 1, 1}), {0, 0, 0});
  EXPECT_EQ(navigator.step(still, {}, std::nullopt, 0, 0.02).status, NavigatorStatus::no_course);
}

}  // namespace
}  // namespace vericone::guidance::navigator_test
