// SPDX-License-Identifier: BSD-3-Clause
//
// The nearest safe velocity: against single verdicts of what was chosen and of samples nearer by, against a
// closed form, and what it says where nothing is safe.
#include <vericone/guidance/avoid.h>

#include <gtest/gtest.h>
#include <vericone/cones/pair.h>
#include <vericone/geometry/error.h>
#include <vericone/guidance/velocity_map.h>
#include <vericone/testing/random_bodies.h>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <iostream>
#include <numbers>

#include "guidance/decisions/balls.h"
#include "guidance/decisions/round_pieces.h"
#include "support/campaign.h"

namespace vericone::guidance {
namespace {

using Eigen::Vector3d;
using testing::any_body;
using testing::any_pose;
using testing::campaign_size;
using testing::RandomBodies;

struct Encounter {
  Placed agent{Body()};
  Vector3d velocity, wanted;
  std::vector<Intruder> others;
  AvoidOptions options;
  mutable std::vector<Pair> pairs = {};  // with each, once they are asked about

  Avoidance answer() const { return avoid(agent, velocity, wanted, others, options); }
  /// Whether a velocity, flown at once, keeps them all away; of meshes and the like as they are.
  bool is_safe(const Vector3d& v) const {
    for (std::size_t i = pairs.size(); i < others.size(); ++i) pairs.emplace_back(agent, others[i].body);
    return std::all_of(others.begin(), others.end(), [&](const Intruder& other) {
      const Pair& pair = pairs[std::size_t(&other - others.data())];
      if (pair.verdict(v + options.wind, other.velocity, {0, options.until}) != Verdict::out) return false;
      if (options.margin == 0) return true;
      const Miss miss = pair.miss(v + options.wind, other.velocity);
      if (miss.least >= options.margin) return true;
      // How near by then: of meshes and the like several times, perhaps.
      double least = std::numeric_limits<double>::infinity();
      for (int k = 0; k <= 400; ++k) {
        Placed then = agent;
        then.pose.position += options.until * k / 400 * (v + options.wind - other.velocity);
        least = std::min(least, Pair(then, other.body).distance());
      }
      return least >= options.margin * (1 - 1e-9);
    });
  }
  bool can_fly(const Vector3d& v) const {
    const double speed = v.norm(), slack = 1e-12 * speed;
    return speed >= options.speed.from - slack && speed <= options.speed.to + slack &&
           v.z() >= options.climb.from - slack && v.z() <= options.climb.to + slack;
  }
};

Vector3d in_ball(RandomBodies& random, double radius) {
  return radius * std::cbrt(random.uniform(0, 1)) * random.direction();
}

TEST(Avoid, ChoosesWhatIsSafeAndNothingSafeIsNearer) {
  RandomBodies random(3831);
  SCOPED_TRACE(random.trace());
  int changed = 0, close = 0, samples = 0;
  using enum BodyKind;
  for (int i = 0; i < campaign_size(84, 10'000); ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Encounter e;
    e.agent = Placed(i % 3 == 0   ? any_body(random, BodyKind::hull)
                     : i % 7 == 1 ? any_body(random, BodyKind::convex)
                                  : Body(Ellipsoid::from_axes({0, 0, 0}, {0.5, 0.8, 0.3})));
    const int count = i % 50 == 49 ? 10 * (1 + random.integer(0, 9)) : 3 + i % 8;
    // Pieces: here of flat, round and straight parts.
    const BodyKind kind = std::array{ellipsoid, hull, mesh, cloud, boxes, convex, pieces}[i / 3 % 7];
    while (static_cast<int>(e.others.size()) < count) {
      const Placed body(kind == pieces ? round_pieces(random) : any_body(random, kind),
                        any_pose(random, random.uniform(7, count > 10 ? 80 : 40)));
      if (Pair(e.agent, body).relation() == Relation::disjoint)
        e.others.push_back({body, random.uniform(0, 3) * random.direction()});
    }
    e.velocity = random.uniform(1, 5) * random.direction();
    // Towards one of them as a rule.
    e.wanted = i % 4 == 0
                   ? e.velocity
                   : Vector3d(e.others[0].body.pose.position / random.uniform(5, 12) + e.others[0].velocity);
    e.options.until = random.uniform(4, 15);
    e.options.speed = {0, 9};
    e.options.wind = i % 5 == 0 ? Vector3d(0.5 * random.direction()) : Vector3d(Vector3d::Zero());
    if (i % 6 == 1) e.options.margin = 0.3;
    if (i % 6 == 2) e.options.climb = {-1, 1};
    if (i % 6 == 3) e.options.speed = {1, 4};
    const Avoidance found = e.answer();
    ASSERT_EQ(found.status, AvoidStatus::free);
    ASSERT_TRUE(e.is_safe(found.velocity));
    ASSERT_TRUE(e.can_fly(found.velocity));
    ASSERT_NEAR((found.velocity - e.wanted).norm(), found.distance, 1e-12);
    ASSERT_LE(found.lower, found.distance);
    ASSERT_EQ(found.distance == 0, e.can_fly(e.wanted) && e.is_safe(e.wanted));
    if (found.distance == 0) continue;
    ++changed;
    close += found.distance <= 1.0101 * found.lower;
    for (int k = 0; k < 300; ++k, ++samples) {
      const Vector3d v = e.wanted + in_ball(random, found.lower);
      ASSERT_FALSE(e.can_fly(v) && e.is_safe(v)) << v.transpose();
    }
  }
  std::cout << "[ avoid    ] " << changed << " changed, " << close << " of them within 1 % of the bound\n";
  EXPECT_GT(changed, 20);
  EXPECT_GE(close, 0.95 * changed);
}

TEST(Avoid, OfOneBallIsAsFarAsItsConeOrItsCap) {
  // The velocity aims at the middle: out through the side of the cone, or slower, whichever is nearer.
  for (const double until : {3.0, 30.0}) {
    Encounter e;
    e.agent = ball(Vector3d::Zero(), 1);
    e.others = {{ball({10, 0, 0}, 1), Vector3d::Zero()}};
    e.velocity = e.wanted = {4, 0, 0};
    e.options.until = until;
    e.options.speed = {0, 20};
    const double sine = 2.0 / 10, side = 4 * sine, cap = 4 - 8 / until;
    const Avoidance found = e.answer();
    ASSERT_EQ(found.status, AvoidStatus::free);
    const double expected = std::min(side, cap);
    EXPECT_GE(found.distance, expected * (1 - 1e-12));
    EXPECT_LE(found.distance, expected * 1.0101);
    EXPECT_LE(found.lower, expected * (1 + 1e-12));
  }
}

TEST(Avoid, AmongManyOnlyThoseInTheWayCost) {
  // A wall of some 560 boxes with a door; beside it nothing is in the way, before it the door or its edge is.
  std::vector<Box> boxes;
  for (int i = -12; i < 12; ++i)
    for (int j = -12; j < 12; ++j)
      if (i < 1 || i > 4 || j > 3)
        boxes.push_back({{5, 0.3 * i, 0.3 * j}, {5.1, 0.3 * i + 0.3, 0.3 * j + 0.3}});
  RandomBodies random(3835);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < campaign_size(6, 200); ++i) {
    Encounter e;
    e.agent = Placed(Ellipsoid::from_axes({0, 0, 0}, {0.3, 0.2, 0.1}));
    e.others = {{Placed(Body(Assembly::boxes(boxes))), {random.uniform(-0.5, 0.5), 0, 0}}};
    e.velocity = e.wanted = {random.uniform(-1, 3), random.uniform(-1, 1), random.uniform(-0.5, 0.5)};
    e.options.until = random.uniform(2, 6);
    e.options.speed = {0, 4};
    const Avoidance found = e.answer();
    ASSERT_EQ(found.status, AvoidStatus::free);
    ASSERT_TRUE(e.is_safe(found.velocity));
    ASSERT_EQ(found.distance == 0, e.is_safe(e.wanted));
    for (int k = 0; k < 200 && found.lower > 0; ++k)
      ASSERT_FALSE(e.is_safe(e.wanted + in_ball(random, found.lower)));
  }
}

TEST(Avoid, FindsWhatBoundingBallsHaveNot) {
  // Two long bodies side by side with room between them for a slender agent.
  Encounter e;
  e.agent = Placed(Ellipsoid::from_axes({0, 0, 0}, {2, 0.2, 0.2}));
  for (const double side : {-1.0, 1.0})
    e.others.push_back(
        {Placed(Ellipsoid::from_axes({0, 0, 0}, {6, 0.5, 6}), Pose{{15, side * 0.9, 0}}), Vector3d::Zero()});
  e.velocity = e.wanted = {2, 0, 0};
  e.options.until = 20;
  e.options.speed = {1.9, 2.1};
  EXPECT_EQ(e.answer().distance, 0);
}

TEST(Avoid, FindsTheWayOutOfADent) {
  // The ellipsoid is all about the agent.
  RandomBodies random(3837);
  SCOPED_TRACE(random.trace());
  int close = 0;
  const int count = campaign_size(3, 20);
  for (int i = 0; i < count; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Encounter e;
    e.agent = {Ellipsoid::from_axes(Vector3d::Zero(), {0.3, 0.25, 0.2}), any_pose(random, 0)};
    e.agent.pose.position = {random.uniform(2.8, 3.3), random.uniform(-0.2, 0.2), 0};
    std::vector<Delimiter<3>> dents{hyperboloid(2, {1, 1, 1.2})};
    if (i % 2 == 1)
      dents.push_back(
          hyperboloid(2, {1.1, 1, 1}, Eigen::AngleAxisd(std::numbers::pi / 2, Vector3d::UnitZ()).matrix()));
    e.others = {{Placed(CombinedEllipsoid(Ellipsoid::from_axes(Vector3d::Zero(), {5, 5, 6}), dents)),
                 0.2 * random.direction()}};
    e.velocity = e.wanted = {-random.uniform(0.6, 1), random.uniform(-0.2, 0.2), 0};
    e.options.until = random.uniform(3, 6);
    e.options.speed = {0, 3};
    if (i % 4 == 2) e.options.margin = 0.05;
    const Avoidance found = e.answer();
    ASSERT_EQ(found.status, AvoidStatus::free);
    // Points as far about the agent as the margin, step by step, against the inequalities of the body.
    const Vector3d semi(0.3, 0.25, 0.2), w = found.velocity - e.others[0].velocity;
    for (int k = 0; k < 400; ++k) {
      const Vector3d n = random.direction();
      const Vector3d own = (semi.array().square() * n.array()).matrix() / semi.cwiseProduct(n).norm();
      for (int step = 0; step <= 200; ++step) {
        const Vector3d x =
            e.agent.pose.to_world(own + e.options.margin * n) + e.options.until * step / 200 * w;
        const bool inside = x.cwiseQuotient(Vector3d(5, 5, 6)).squaredNorm() < 1 &&
                            std::all_of(dents.begin(), dents.end(),
                                        [&](const Delimiter<3>& dent) { return dent.value(x) < 0; });
        ASSERT_FALSE(inside);
      }
    }
    // Distances of such bodies are estimates, so not of margins.
    ASSERT_TRUE(e.options.margin > 0 || e.is_safe(found.velocity));
    ASSERT_GT(found.distance, 0);
    close += found.distance < 1.1 * found.lower;
    for (int k = 0; k < (e.options.margin > 0 ? 0 : 100); ++k)
      ASSERT_FALSE(e.is_safe(e.wanted + in_ball(random, found.lower)));
  }
  std::cout << "[ dents    ] " << close << " of " << count << " within 10 % of the bound\n";
}

TEST(Avoid, ProvesThatNothingIsSafe) {
  RandomBodies random(3832);
  SCOPED_TRACE(random.trace());
  int proved = 0;
  for (int i = 0; i < campaign_size(6, 60); ++i) {
    // Six walls close in from all sides.
    Encounter e;
    e.agent = ball(Vector3d::Zero(), 0.5);
    const double far = random.uniform(4, 6), speed = random.uniform(1.5, 2.5);
    for (int k = 0; k < 6; ++k) {
      Vector3d half = Vector3d::Constant(2 * far);
      const Vector3d out = Vector3d::Unit(k / 2) * (k % 2 == 0 ? 1 : -1);
      half(k / 2) = 1;
      e.others.push_back({Placed(HullBody::box(-half, half), Pose{(far + 1) * out}), -speed * out});
    }
    e.velocity = e.wanted = random.direction();
    e.options.until = 1.5 * far / speed;
    e.options.speed = {0, random.uniform(0.5, 3)};
    const Avoidance found = e.answer();
    ASSERT_NE(found.status, AvoidStatus::free);
    proved += found.status == AvoidStatus::nothing_safe;
    ASSERT_TRUE(found.first);
    // To stand still is best: the walls are equally far and equally fast.
    const double longest = (far - 0.5) / speed;
    EXPECT_LE(found.safe_until, longest * (1 + 1e-12));
    EXPECT_GE(found.latest, longest * (1 - 1e-12));
    if (found.status == AvoidStatus::nothing_safe) {
      EXPECT_LE(found.latest, 1.0101 * found.safe_until);
    }
    EXPECT_GT(found.first->time, 0);
    EXPECT_LE(found.first->time, e.options.until);
    for (int k = 0; k < campaign_size(1000, 1'000'000); ++k)
      ASSERT_FALSE(e.is_safe(in_ball(random, e.options.speed.to)));
  }
  EXPECT_GE(proved, 5 * campaign_size(6, 60) / 6);
}

TEST(Avoid, SaysForHowLongSomethingIsSafe) {
  // Bodies all around come nearer, some sooner: against the first contacts of many velocities.
  RandomBodies random(3836);
  SCOPED_TRACE(random.trace());
  int proved = 0, none = 0;
  for (int i = 0; i < campaign_size(5, 100); ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Encounter e;
    e.agent = Placed(any_body(random, i % 2 == 0 ? BodyKind::ellipsoid : BodyKind::hull));
    const double far = random.uniform(14, 20);
    for (int k = 0; k < 40; ++k) {
      // Evenly about, from a spiral.
      const double z = -1 + (2 * k + 1) / 40.0, around = 2.399963 * k, level = std::sqrt(1 - z * z);
      const Vector3d out(level * std::cos(around), level * std::sin(around), z);
      const double size = random.uniform(4.5, 5.5);
      e.others.push_back(
          {Placed(Ellipsoid::from_axes({0, 0, 0}, {size, 1.1 * size, size})), -random.uniform(1, 2) * out});
      e.others.back().body.pose = any_pose(random, 0.1);
      e.others.back().body.pose.position += far * out;
    }
    e.velocity = e.wanted = random.direction();
    e.options.until = 30;
    e.options.speed = {0, random.uniform(0.5, 2)};
    e.options.margin = i % 8 == 7 ? 0.2 : 0;
    if (i % 4 == 1) e.options.wind = 0.3 * random.direction();
    const Avoidance found = e.answer();
    ASSERT_NE(found.status, AvoidStatus::free);
    ASSERT_GT(found.safe_until, 0);
    ASSERT_LE(found.safe_until, found.latest);
    ASSERT_TRUE(e.can_fly(found.velocity));
    proved += found.status == AvoidStatus::nothing_safe;
    none += found.status == AvoidStatus::nothing_safe && found.latest <= 1.0101 * found.safe_until;
    e.options.until = found.safe_until * (1 - 1e-12);
    ASSERT_TRUE(e.is_safe(found.velocity));
    if (std::isinf(found.latest)) continue;
    e.options.until = found.latest;
    const bool costly = e.options.margin > 0;
    for (int k = 0; k < (costly ? 50 : campaign_size(1000, 100'000)); ++k)
      ASSERT_FALSE(e.is_safe(in_ball(random, e.options.speed.to)));
    // Near the best ones too.
    for (int k = 0; k < (costly ? 20 : 200); ++k) {
      const Vector3d v = found.velocity + in_ball(random, 0.05);
      ASSERT_FALSE(e.can_fly(v) && e.is_safe(v));
    }
  }
  std::cout << "[ latest   ] " << proved << " proved, " << none << " of them within 1 %\n";
  EXPECT_GE(none, 9 * campaign_size(5, 100) / 10);
  // Between two that close in: best is to fly along them, at any speed and to any side.
  Encounter walls;
  walls.agent = ball(Vector3d::Zero(), 1);
  for (const double side : {-1.0, 1.0})
    walls.others.push_back(
        {Placed(Ellipsoid::from_axes({0, 0, 0}, {3, 20, 20}), Pose{{6 * side, 0, 0}}), {-2 * side, 0, 0}});
  walls.velocity = walls.wanted = {3, 0, 0};
  walls.options.until = 5;
  walls.options.speed = {0, 4};
  const Avoidance between = walls.answer();
  EXPECT_EQ(between.status, AvoidStatus::nothing_safe);
  EXPECT_LE(between.latest, 1.0101 * between.safe_until);
  // Flying along them at 4 m/s: what one contact says.
  const auto along =
      Pair(walls.agent, walls.others[0].body).contact({0, 4, 0}, walls.others[0].velocity)->earliest;
  EXPECT_GE(between.latest, along * (1 - 1e-9));
  EXPECT_GE(between.safe_until, along / 1.0101);
  // Too near already: no time at all.
  Encounter e;
  e.agent = ball(Vector3d::Zero(), 1);
  e.others = {{ball({1.5, 0, 0}, 1), Vector3d::Zero()}};
  e.velocity = e.wanted = {1, 0, 0};
  const Avoidance found = e.answer();
  EXPECT_EQ(found.status, AvoidStatus::nothing_safe);
  EXPECT_EQ(found.safe_until, 0);
  EXPECT_EQ(found.latest, 0);
}

TEST(Avoid, ProvesTheWayThereToo) {
  RandomBodies random(3833);
  SCOPED_TRACE(random.trace());
  int changed = 0;
  for (int i = 0; i < campaign_size(30, 300); ++i) {
    Encounter e;
    e.agent = ball(Vector3d::Zero(), 0.5);
    for (int k = 0; k < 4; ++k)
      e.others.push_back(
          {Placed(any_body(random, BodyKind::ellipsoid), any_pose(random, random.uniform(10, 30))),
           2 * random.direction()});
    e.velocity = e.wanted = e.others[0].body.pose.position / random.uniform(5, 12) + e.others[0].velocity;
    e.options.until = random.uniform(6, 15);
    e.options.speed = {0, 9};
    e.options.lateral = 2;
    e.options.longitudinal = 1;
    const Avoidance found = e.answer();
    if (found.status != AvoidStatus::free || found.distance == 0) continue;
    ++changed;
    // Flown in small steps: a constant acceleration, then straight on.
    const Vector3d change = found.velocity - e.velocity, ahead = e.velocity.normalized();
    const double along = std::abs(change.dot(ahead)), across = (change - change.dot(ahead) * ahead).norm();
    const double duration = std::max(along / e.options.longitudinal, across / e.options.lateral);
    for (int step = 0; step <= 400; ++step) {
      const double t = e.options.until * step / 400, r = std::min(t, duration);
      const Vector3d x = t < duration
                             ? Vector3d(e.velocity * t + 0.5 * t * t / duration * change)
                             : Vector3d(e.velocity * r + 0.5 * r * change + (t - r) * found.velocity);
      for (const Intruder& other : e.others) {
        Placed moved = e.agent;
        moved.pose.position += x - t * other.velocity;
        ASSERT_EQ(relation_of(WorldBody(moved), WorldBody(other.body), 1e-6), Relation::disjoint)
            << "case " << i;
      }
    }
  }
  EXPECT_GT(changed, 8);
}

TEST(Avoid, KeepsToOneSpeedOrToALevel) {
  RandomBodies random(3834);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < campaign_size(10, 100); ++i) {
    Encounter e;
    e.agent = ball(Vector3d::Zero(), 0.5);
    e.others = {{ball({12, 0.3, 0.2}, 2), {-1, 0, 0}}};
    e.velocity = e.wanted =
        i % 2 ? Vector3d(3, 0, 0) : Vector3d(0.1 * random.direction() + Vector3d(3, 0, 0));
    e.options.until = 20;
    if (i % 3 == 0) {
      e.options.climb = {0, 0};
    } else {
      e.options.speed = {3, 3};
    }
    const Avoidance found = e.answer();
    ASSERT_EQ(found.status, AvoidStatus::free) << "case " << i;
    ASSERT_TRUE(e.is_safe(found.velocity));
    if (i % 3 == 0) {
      ASSERT_NEAR(found.velocity.z(), 0, 1e-11);
    } else {
      ASSERT_NEAR(found.velocity.norm(), 3, 1e-11);
    }
  }
}

TEST(Avoid, RefusesWhatIsNone) {
  const auto refused = [](auto&& set) {
    Encounter e;
    e.velocity = e.wanted = {1, 0, 0};
    set(e);
    try {
      static_cast<void>(e.answer());
    } catch (const InputError& error) {
      return error.field();
    }
    return std::string("nothing");
  };
  EXPECT_EQ(refused([](Encounter& e) { e.wanted.x() = NAN; }), "wanted[0]");
  EXPECT_EQ(refused([](Encounter& e) { e.options.until = 0; }), "until");
  EXPECT_EQ(refused([](Encounter& e) { e.options.margin = -1; }), "margin");
  EXPECT_EQ(refused([](Encounter& e) { e.options.speed = {3, 2}; }), "speed");
  EXPECT_EQ(refused([](Encounter& e) { e.options.climb = {3, 2}; }), "climb");
  EXPECT_EQ(refused([](Encounter& e) { e.options.lateral = 1; }), "longitudinal");
  EXPECT_EQ(refused([](Encounter&) {}), "nothing");
  // Of bodies that are out of reach too.
  const auto far = [](const Eigen::Matrix3d& rotation) {
    return Intruder{Placed(Ellipsoid(), Pose{{0, 500, 0}, rotation}), Vector3d::Zero()};
  };
  Eigen::Matrix3d sheared = Eigen::Matrix3d::Identity();
  sheared(0, 1) = 0.5;
  for (const Eigen::Matrix3d& none : {Eigen::Matrix3d(600 * Eigen::Matrix3d::Identity()), sheared}) {
    EXPECT_EQ(refused([&](Encounter& e) { e.others = {far(none)}; }), "pose.rotation");
    EXPECT_EQ(refused([&](Encounter& e) { e.agent.pose.rotation = none; }), "pose.rotation");
    const Intruder other = far(none);
    EXPECT_THROW(static_cast<void>(velocity_map(Placed(Ellipsoid()), {&other, 1}, {})), InputError);
  }
}

}  // namespace
}  // namespace vericone::guidance
