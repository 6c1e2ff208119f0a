// SPDX-License-Identifier: BSD-3-Clause
//
// What a step says is proved, held against the plan itself: flown open-loop on dense chords, each asked of
// the exact predicates, among bodies that keep their velocities, or swerve as far as they may.
#include <gtest/gtest.h>
#include <vericone/cones/pair.h>
#include <vericone/geometry/error.h>
#include <vericone/guidance/navigator.h>
#include <vericone/testing/random_bodies.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iostream>
#include <limits>
#include <optional>
#include <vector>

#include "support/campaign.h"
#include "support/hall.h"

namespace vericone::guidance::proved_plans_test {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;
using testing::campaign_size, testing::from_environment, testing::RandomBodies;

constexpr double kStep = 0.05, kMost = 3, kFar = std::numeric_limits<double>::infinity();

struct Other {
  Placed body;  // where it is at the start
  Vector3d velocity;
};

struct World {
  Vector3d axes, start, velocity, goal;
  bool turns = false;  // the agent, with its heading
  std::vector<Other> others;
  NavigatorOptions options;

  [[nodiscard]] Matrix3d heading(const Vector3d& v) const {
    if (!turns || !(v.norm() > 0)) return Matrix3d::Identity();
    return Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitX(), v).toRotationMatrix();
  }
  [[nodiscard]] BodyState agent(const Vector3d& x, const Vector3d& v) const {
    BodyState state;
    state.shape = CombinedEllipsoid(Ellipsoid::from_axes(x, axes, heading(v)));
    state.position = x;
    state.velocity = v;
    if (turns) state.turning = Turning::with_heading;
    return state;
  }
  [[nodiscard]] std::vector<BodyState> states(double t) const {
    std::vector<BodyState> all;
    for (const Other& other : others) {
      BodyState& state = all.emplace_back();
      Placed placed = other.body;
      placed.pose.position += t * other.velocity;
      if (const auto* quadric = placed.body.quadric())
        state.shape = in_world(*quadric, placed.pose);
      else
        state.shape = placed;
      state.position = placed.pose.position;
      state.velocity = other.velocity;
    }
    return all;
  }
};

World world_of(RandomBodies& random, bool swerves) {
  World world;
  const bool hall = random.coin();
  // Where much is required all that is proved is how near they come.
  const double required[] = {0, 0.1, 5, 5};
  world.options = {.required = required[random.integer(0, 3)],
                   .beyond = 0.05,
                   .most = kMost,
                   .longitudinal = swerves || random.coin(),
                   .others_most = swerves ? random.uniform(0.1, 2) : 0};
  if (world.options.longitudinal) world.options.fastest = random.uniform(1, 4);
  if (random.coin() && world.options.longitudinal) world.options.range = 30;
  world.turns = !world.options.longitudinal && random.coin();
  world.axes = world.turns ? Vector3d(0.5, 0.2, 0.1)
                           : Vector3d(random.uniform(0.1, 0.4), random.uniform(0.1, 0.4), 0.2);
  world.start = {0, 0, 2};
  if (hall) {
    const std::vector<Box> boxes = testing::hall(random, 1.3);
    do world.start = {random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(0.8, 3.2)};
    while (testing::distance(world.start, boxes) < 0.8);
    world.others.push_back({Placed(vericone::Body(Assembly::boxes(boxes))), Vector3d::Zero()});
    world.goal = {random.uniform(-5, 5), random.uniform(-5, 5), 2};
  } else {
    world.goal = world.start + 20 * random.direction();
  }
  const bool slow = world.options.longitudinal;
  world.velocity = random.uniform(slow ? 0 : 1, slow ? 1 : 4) * random.direction();
  for (int i = random.integer(1, hall ? 3 : 6); i > 0; --i) {
    const Vector3d at = world.start + random.uniform(2.5, 10) * random.direction();
    const Vector3d axes(random.uniform(0.2, 1), random.uniform(0.2, 1), random.uniform(0.2, 1));
    Other other{Placed(Ellipsoid::from_axes({0, 0, 0}, axes, random.rotation()), Pose{at}), Vector3d::Zero()};
    if (random.integer(0, 3) == 0)
      other.body = Placed(HullBody({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}), Pose{at});
    if (random.coin()) other.velocity = random.uniform(0, 3) * random.direction();
    world.others.push_back(other);
  }
  return world;
}

/// How a body is displaced at a time beside going straight on.
using Swerve = std::function<Vector3d(double)>;
Vector3d straight_on(double) { return Vector3d::Zero(); }

struct Checked {
  long chords = 0;
  int touched = 0, nearer = 0;
};

/// The plan of the navigator's last step, which began at `now`.
void check_plan(const World& world, const Navigator& navigator, const NavigatorStep& said, double now,
                const std::vector<Swerve>& swerves, Checked& checked) {
  ASSERT_TRUE(said.proved.has_value());
  const double until = std::min({said.until, 15.0, said.rest < kFar ? said.rest + 3 : kFar});
  // A course that follows another begins at a whole number of steps.
  const double fine = kStep / 4;
  const int count = static_cast<int>(until / fine), stride = std::max(1, count / 60);
  Vector3d heading = navigator.planned(0).velocity;
  Matrix3d rotation = world.heading(heading);
  for (int i = 0; i + stride <= count; ++i) {
    const double t = i * fine, next = (i + stride) * fine, span = next - t;
    const PlannedMotion from = navigator.planned(t), to = navigator.planned(next);
    // Without roll.
    if (world.turns) rotation = Eigen::Quaterniond::FromTwoVectors(heading, from.velocity) * rotation;
    heading = from.velocity;
    if (i % stride != 0) continue;
    const Placed agent(Ellipsoid::from_axes({0, 0, 0}, world.axes, rotation), Pose{from.position});
    for (std::size_t k = 0; k < world.others.size(); ++k) {
      Placed body = world.others[k].body;
      const Vector3d u = world.others[k].velocity;
      const Vector3d start = (now + t) * u + swerves[k](t), end = (now + next) * u + swerves[k](next);
      body.pose.position += start;
      const Pair pair(agent, body);
      ++checked.chords;
      // Here, and on the chord, from which the way differs by less than what is kept.
      checked.nearer += pair.miss(Vector3d::Zero(), Vector3d::Zero()).most < *said.proved - 1e-9;
      if (world.turns) continue;
      const double beside = (kMost + world.options.others_most) * span * span / 8;
      if (beside > 0.5 * *said.proved) continue;
      checked.touched +=
          pair.verdict((to.position - from.position) / span, (end - start) / span, {0, span}) != Verdict::out;
    }
  }
}

Checked fly(int count, bool swerving, int& plans) {
  Checked checked;
  int safe = 0, proved = 0, steps = 0;
  for (int i = 0; i < count; ++i) {
    RandomBodies random(70'000 + i);
    const World world = world_of(random, swerving);
    Navigator navigator(world.options);
    Vector3d x = world.start, v = world.velocity;
    const double flown = kStep * random.integer(0, 40);
    NavigatorStep said;
    double t = 0;
    for (;; t += kStep) {
      said = navigator.step(world.agent(x, v), world.states(t),
                            Destination{.point = world.goal, .most = kMost}, t, kStep);
      ++steps;
      const bool says_safe = said.status == NavigatorStatus::straight ||
                             said.status == NavigatorStatus::homing ||
                             said.status == NavigatorStatus::avoiding;
      safe += says_safe;
      EXPECT_TRUE(!says_safe || said.proved) << i << " at " << t;
      if (said.proved) {
        EXPECT_LE(*said.proved, *world.options.required);
      }
      if (t >= flown) break;
      const PlannedMotion next = navigator.planned(kStep);
      x = next.position;
      v = next.velocity;
    }
    if (!said.proved) continue;
    ++proved;
    std::vector<Swerve> swerves;
    for (const Other& other : world.others) {
      const bool still = !other.body.body.quadric() && other.velocity.isZero(0);
      if (!swerving || still) {
        swerves.emplace_back(straight_on);
        continue;
      }
      // As hard as it may, one way, or to one side and then to the other, or after the agent.
      const double a = world.options.others_most, turns = random.uniform(0, 3);
      Vector3d d = random.direction();
      // Or to where that brings it nearest.
      if (random.integer(0, 3) > 0) {
        double least = kFar;
        for (double s = 0; s < std::min(said.until, 10.0); s += 0.05) {
          const Vector3d apart =
              navigator.planned(s).position - other.body.pose.position - (t + s) * other.velocity;
          if (apart.norm() - 0.5 * a * s * s >= least) continue;
          least = apart.norm() - 0.5 * a * s * s;
          d = apart.normalized();
        }
      }
      const bool back = random.integer(0, 3) == 0;
      swerves.emplace_back([a, d, turns, back](double s) {
        if (!back || s <= turns) return Vector3d(0.5 * a * s * s * d);
        const double more = s - turns;
        return Vector3d((0.5 * a * turns * turns + a * turns * more - 0.5 * a * more * more) * d);
      });
    }
    check_plan(world, navigator, said, t, swerves, checked);
  }
  std::cout << "[ plans    ] " << count << ": proved " << proved << ", chords " << checked.chords
            << ", touched " << checked.touched << ", nearer " << checked.nearer << "; of " << steps
            << " steps safe " << safe << '\n';
  plans = proved;
  return checked;
}

void nothing_is_touched(bool swerving) {
  const int count = static_cast<int>(from_environment("VERICONE_CASES", campaign_size(150, 10'000)));
  int plans = 0;
  const Checked checked = fly(count, swerving, plans);
  EXPECT_EQ(checked.touched, 0);
  EXPECT_EQ(checked.nearer, 0);
  EXPECT_GT(plans, 0.85 * count);
}

TEST(ProvedPlans, TouchNothingThatKeepsItsVelocity) { nothing_is_touched(false); }
TEST(ProvedPlans, TouchNothingThatSwervesWithinItsBound) { nothing_is_touched(true); }

}  // namespace
}  // namespace vericone::guidance::proved_plans_test
