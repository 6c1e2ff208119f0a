// SPDX-License-Identifier: BSD-3-Clause
//
// Who keeps its speed in a hall: at every step it holds a course that ends on a circle, proved for ever. And
// corridors: with all of its body an agent stays in one.
#include <gtest/gtest.h>
#include <vericone/cones/pair.h>
#include <vericone/geometry/error.h>
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

namespace vericone::guidance::circles_test {
namespace {

using Eigen::Vector3d;
using testing::campaign_size, testing::from_environment, testing::RandomBodies;

constexpr double kStep = 0.05, kFar = std::numeric_limits<double>::infinity();

BodyState ball(const Vector3d& x, const Vector3d& v, double radius) {
  BodyState state;
  state.shape = CombinedEllipsoid(Ellipsoid::from_axes(x, Vector3d::Constant(radius)));
  state.position = x;
  state.velocity = v;
  return state;
}

BodyState still(const Placed& placed) {
  BodyState state;
  state.shape = placed;
  state.position = placed.pose.position;
  return state;
}

/// The plan of a step, until long after it circles: nothing at rest is nearer than proved, by exact distances
/// at single times; and it goes round, at its speed, with no more than it may.
void check_circle(const Navigator& navigator, const NavigatorStep& said, double radius, double most,
                  const std::vector<Box>& boxes) {
  const double once = 2 * 3.15 * navigator.planned(0).velocity.norm() / most;
  for (int i = 0; i <= 60; ++i) {
    const double t = (said.circles + 1.3 * once) * i / 60;
    const PlannedMotion at = navigator.planned(t);
    EXPECT_GE(testing::distance(at.position, boxes) - radius, *said.proved - 1e-9);
    EXPECT_NEAR(at.velocity.norm(), navigator.planned(0).velocity.norm(), 1e-9);
    // The velocity is that of the places, and the acceleration within its bound.
    constexpr double h = 1e-4;
    const PlannedMotion next = navigator.planned(t + h);
    EXPECT_LE(((next.position - at.position) / h - at.velocity).norm(), most * h);
    EXPECT_LE((next.velocity - at.velocity).norm(), 1.0001 * most * h);
  }
  const PlannedMotion begin = navigator.planned(said.circles),
                      round = navigator.planned(said.circles + 0.5 * once);
  EXPECT_GT((round.position - begin.position).norm(), 0.9 * once / 3.15 * begin.velocity.norm());
}

TEST(Circles, AreInHandAtEveryStep) {
  const int count = static_cast<int>(from_environment("VERICONE_CASES", campaign_size(8, 1000)));
  int steps = 0, held = 0, arrived = 0, safe = 0;
  for (int i = 0; i < count; ++i) {
    RandomBodies random(90'000 + i);
    const std::vector<Box> boxes = testing::hall(random, 2.2);
    const double radius = 0.15, most = 4, required = 0.1;
    Vector3d x, goal;
    do x = {random.uniform(-5, -2), random.uniform(-5, 5), random.uniform(1, 3)};
    while (testing::distance(x, boxes) < 1.3);
    do goal = {random.uniform(2, 5), random.uniform(-5, 5), random.uniform(1, 3)};
    while (testing::distance(goal, boxes) < 1);
    Vector3d v =
        random.uniform(1, 1.6) * Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), 0).normalized();
    const BodyState hall = still(Placed(Body(Assembly::boxes(boxes))));
    Navigator navigator({.required = required, .beyond = 0.05, .most = most});
    bool first = true, there = false;
    for (double t = 0; t < 30 && !there; t += kStep) {
      std::vector<BodyState> others{hall};
      const NavigatorStep said =
          navigator.step(ball(x, v, radius), others, Destination{.point = goal, .most = most}, t, kStep);
      ++steps;
      const bool in_hand = said.proved && said.circles < kFar && said.until == kFar;
      held += in_hand;
      safe += said.proved.has_value();
      // Once it has one it has one for ever.
      if (first && !in_hand) break;
      first = false;
      ASSERT_TRUE(in_hand) << "hall " << i << " at " << t << ' ' << to_string(said.status);
      if (random.integer(0, 19) == 0) check_circle(navigator, said, radius, most, boxes);
      const PlannedMotion next = navigator.planned(kStep);
      // What is commanded is what is planned.
      ASSERT_LE(((next.velocity - v) / kStep - said.acceleration).norm(), 0.2 * most) << i << " at " << t;
      x = next.position;
      v = next.velocity;
      ASSERT_GE(testing::distance(x, boxes) - radius, 0.75 * required) << "hall " << i << " at " << t;
      there = (x - goal).norm() < 0.5;
    }
    arrived += there;
  }
  std::cout << "[ circles  ] " << count << " halls: " << steps << " steps, in hand at " << held << ", proved "
            << safe << ", arrived " << arrived << '\n';
  EXPECT_GT(held, 0.9 * steps);
  EXPECT_GT(arrived, 0.3 * count);
}

/// Where another crosses, the circle is judged until that has passed for ever.
TEST(Circles, KeepAwayFromWhatMoves) {
  RandomBodies random(5);
  const std::vector<Box> boxes{{{-20, -20, -1}, {20, 20, 0}}, {{-20, -20, 6}, {20, 20, 7}}};
  const BodyState hall = still(Placed(Body(Assembly::boxes(boxes))));
  int held = 0, others_met = 0;
  for (int i = 0; i < 60; ++i) {
    const Vector3d x(0, 0, 3), v(2, 0, 0);
    const Vector3d at = 6 * Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), 0).normalized() + x;
    const Vector3d u =
        random.uniform(0.3, 2) * (x + random.uniform(0, 3) * Vector3d(1, 0, 0) - at).normalized();
    Navigator navigator({.required = 0.1, .beyond = 0.05, .most = 4});
    const std::vector<BodyState> others{hall, ball(at, u, 0.4)};
    const NavigatorStep said =
        navigator.step(ball(x, v, 0.2), others, Destination{.point = {15, 0, 3}, .most = 4}, 0, kStep);
    if (!said.proved || said.circles == kFar) continue;
    ++held;
    double nearest = kFar;
    for (double t = 0; t < 60; t += 0.01)
      nearest = std::min(nearest, (navigator.planned(t).position - at - t * u).norm() - 0.6);
    EXPECT_GE(nearest, *said.proved - 1e-9) << i;
    others_met += nearest < 1;
  }
  EXPECT_GT(held, 40);
  EXPECT_GT(others_met, 5);  // or nothing would have come near
}

TEST(Corridors, AreKept) {
  const int count = static_cast<int>(from_environment("VERICONE_CASES", campaign_size(40, 2000)));
  int arrived = 0, inside = 0, steps = 0, aside = 0, safe = 0;
  for (int i = 0; i < count; ++i) {
    RandomBodies random(40'000 + i);
    const double radius = 0.2, wide = random.uniform(0.8, 1.5);
    const Vector3d from(0, 0, 0), goal = random.uniform(8, 15) * random.direction();
    std::vector<BodyState> others;
    for (int k = random.integer(1, 4); k > 0; --k)
      others.push_back(ball(random.uniform(0.3, 0.8) * goal + random.uniform(0, wide) * random.direction(),
                            Vector3d::Zero(), random.uniform(0.2, 0.5)));
    const auto fly = [&](bool kept) {
      Navigator navigator({.required = 0.1,
                           .beyond = 0.05,
                           .most = 3,
                           .longitudinal = true,
                           .fastest = random.uniform(1, 4)});
      Vector3d x = from, v = Vector3d::Zero();
      double out = -kFar;
      bool there = false;
      Destination destination{.point = goal, .most = 3};
      if (kept) destination.corridor = Corridor{from, wide};
      for (double t = 0; t < 25 && !there; t += kStep) {
        const NavigatorStep said = navigator.step(ball(x, v, radius), others, destination, t, kStep);
        if (kept) {
          ++steps;
          inside += said.inside;
          safe += said.proved.has_value();
          EXPECT_TRUE(said.rest < kFar || !said.inside) << i;
        }
        for (int n = 1; n <= 5; ++n) {
          const Vector3d at = navigator.planned(n * kStep / 5).position;
          const double part = std::clamp(at.dot(goal) / goal.squaredNorm(), 0.0, 1.0);
          out = std::max(out, (at - part * goal).norm() + radius - wide);
        }
        const PlannedMotion next = navigator.planned(kStep);
        x = next.position;
        v = next.velocity;
        there = (x - goal).norm() < 0.5;
      }
      if (kept) {
        EXPECT_LE(out, 0) << i;
        arrived += there;
      }
      return out;
    };
    fly(true);
    aside += fly(false) > 0;
  }
  std::cout << "[ corridors] " << count << ": arrived " << arrived << ", steps " << steps << " inside "
            << inside << " proved " << safe << "; without one " << aside << " leave it\n";
  EXPECT_EQ(inside, steps);
  EXPECT_EQ(safe, steps);
  EXPECT_GT(arrived, 0.5 * count);
  EXPECT_GT(aside, 0.05 * count);  // or they would be kept by chance
}

/// Too fast to stay in it: that is said, and it comes back.
TEST(Corridors, ThatCannotBeKeptAreSaidToBeLeft) {
  Navigator navigator({.required = 0, .most = 2, .longitudinal = true});
  Vector3d x(0, 0, 0), v(0, 4, 0);
  bool left = false;
  NavigatorStep said;
  for (double t = 0; t < 30; t += kStep) {
    const Destination destination{
        .point = {20, 0, 0}, .most = 2, .stay = true, .corridor = Corridor{{0, 0, 0}, 1}};
    said = navigator.step(ball(x, v, 0.2), {}, destination, t, kStep);
    left |= !said.inside;
    x = navigator.planned(kStep).position;
    v = navigator.planned(kStep).velocity;
  }
  EXPECT_TRUE(left);
  EXPECT_TRUE(said.inside);
  EXPECT_LT((x - Vector3d(20, 0, 0)).norm(), 0.5);
}

TEST(Corridors, ThatAreNoneAreRefused) {
  Navigator navigator({.longitudinal = true}), steady{NavigatorOptions{}};
  const auto field = [](Navigator& pilot, const Destination& destination) -> std::string {
    try {
      static_cast<void>(pilot.step(ball({0, 0, 0}, {1, 0, 0}, 1), {}, destination, 0, kStep));
    } catch (const InputError& e) {
      return e.field();
    }
    return "";
  };
  Destination destination{.point = {9, 0, 0}, .most = 1, .corridor = Corridor{{0, 0, 0}, 2}};
  EXPECT_EQ(field(navigator, destination), "");
  EXPECT_EQ(field(steady, destination), "destination.corridor");
  destination.velocity = {1, 0, 0};
  EXPECT_EQ(field(navigator, destination), "destination.corridor");
  destination.velocity = {0, 0, 0};
  for (const double radius : {0.0, -1.0, kFar, std::nan("")}) {
    destination.corridor->radius = radius;
    EXPECT_EQ(field(navigator, destination), "destination.corridor.radius");
  }
  destination.corridor = Corridor{{kFar, 0, 0}, 2};
  EXPECT_EQ(field(navigator, destination), "destination.corridor.from[0]");
}

/// One that may swerve is passed in a wider way than one that may not; of each its own bound.
TEST(Swerves, AreOfEachBodyItsOwn) {
  const auto kept = [](const std::vector<double>& swerves) {
    Navigator navigator({.required = 5, .beyond = 0, .most = 3, .longitudinal = true, .fastest = 3});
    const std::vector<BodyState> others{ball({4, 1.5, 0}, {0, 0, 0}, 0.5), ball({4, -3, 0}, {0, 0, 0}, 0.5)};
    return navigator.step(ball({0, 0, 0}, {2, 0, 0}, 0.2), others, std::nullopt, 0, kStep, swerves);
  };
  const NavigatorStep none = kept({}), first = kept({1, 0}), second = kept({0, 1}), both = kept({1, 1});
  EXPECT_EQ(none.until, kFar);
  EXPECT_LT(both.until, kFar);
  ASSERT_TRUE(none.proved && first.proved && second.proved && both.proved);
  EXPECT_LT(*first.proved, *none.proved);
  EXPECT_LT(*both.proved, *none.proved);
  // Each is of the course that a search found, so what could be no better may be by a little.
  EXPECT_LE(*both.proved, *first.proved * (1 + 1e-4));
  EXPECT_LE(*both.proved, *second.proved * (1 + 1e-4));
  EXPECT_THROW(kept({1}), InputError);
  EXPECT_THROW(kept({1, -1}), InputError);
}

}  // namespace
}  // namespace vericone::guidance::circles_test
