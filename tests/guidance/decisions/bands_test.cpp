// SPDX-License-Identifier: BSD-3-Clause
//
// Bands: their ends against closed forms of discs, needles, laws, single velocities of all kinds of bodies,
// and manoeuvres flown step by step.
#include <vericone/guidance/bands.h>

#include <gtest/gtest.h>
#include <vericone/cones/pair.h>
#include <vericone/geometry/error.h>
#include <vericone/testing/random_bodies.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <numbers>

#include "guidance/decisions/balls.h"
#include "guidance/decisions/round_pieces.h"
#include "support/campaign.h"

namespace vericone::guidance {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::any_body;
using testing::any_pose;
using testing::campaign_size;
using testing::RandomBodies;
using testing::share;

constexpr double kPi = std::numbers::pi, kTurn = 2 * kPi, kEver = std::numeric_limits<double>::infinity();
constexpr double kDegree = kPi / 180;

Vector3d on(double heading, double speed) {
  return {speed * std::sin(heading), speed * std::cos(heading), 0};
}

/// Two discs as seen from the agent.
struct Discs {
  Vector2d c, u;
  double radius, speed, until;

  /// Whether they touch within the horizon: the least distance of a point to a segment.
  bool meet(double heading) const {
    const Vector2d w = speed * Vector2d(std::sin(heading), std::cos(heading)) - u;
    const double t = std::clamp(c.dot(w) / w.squaredNorm(), 0.0, until);
    return (c - t * w).norm() < radius;
  }
  /// Headings at which that may change: the circle of velocities crosses a tangent from the apex u, or the
  /// arc about u + c / T.
  std::vector<double> ends() const {
    std::vector<double> all;
    const auto add = [&](const Vector2d& v) {
      double heading = std::atan2(v.x(), v.y());
      all.push_back(heading < 0 ? heading + kTurn : heading);
    };
    const double along = std::asin(radius / c.norm()), line = std::atan2(c.y(), c.x());
    for (const double angle : {line + along, line - along}) {
      const Vector2d e(std::cos(angle), std::sin(angle));
      const double b = u.dot(e), root = b * b - u.squaredNorm() + speed * speed;
      if (root < 0) continue;
      for (const double sign : {-1.0, 1.0})
        if (const double k = -b + sign * std::sqrt(root); k > 0) add(u + k * e);
    }
    if (std::isfinite(until)) {
      const Vector2d m = u + c / until;
      const double r = radius / until, d = m.norm(), a = (d * d + speed * speed - r * r) / (2 * d);
      if (speed > std::abs(a)) {
        const double h = std::sqrt(speed * speed - a * a);
        const Vector2d x = m / d, y(-x.y(), x.x());
        add(a * x + h * y);
        add(a * x - h * y);
      }
    }
    std::sort(all.begin(), all.end());
    return all;
  }
  /// Those at which it does.
  std::vector<double> true_ends() const {
    const std::vector<double> all = ends();
    std::vector<double> real;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const double before = i > 0 ? all[i - 1] : all.back() - kTurn,
                   after = i + 1 < all.size() ? all[i + 1] : all[0] + kTurn;
      if (meet(0.5 * (before + all[i])) != meet(0.5 * (all[i] + after))) real.push_back(all[i]);
    }
    return real;
  }
};

std::vector<double> ends_of(const Band& band) {
  std::vector<double> ends;
  for (const Range& range : band.free)
    for (const double end : {range.from, range.to})
      if (end > 0 && end < kTurn) ends.push_back(end);
  std::sort(ends.begin(), ends.end());
  return ends;
}

Band headings(const Discs& d) {
  const Intruder other{ball({d.c.x(), d.c.y(), 0}, 0.75 * d.radius), {d.u.x(), d.u.y(), 0}};
  return bands(ball(Vector3d::Zero(), 0.25 * d.radius), on(0.3, d.speed), {&other, 1},
               {.horizon = {0, d.until}})
      .heading;
}

TEST(BandsOfDiscs, EndWhereTheClosedFormSays) {
  RandomBodies random(3821);
  SCOPED_TRACE(random.trace());
  int some = 0, two = 0, frees = 0, conflicts = 0;
  double worst = 0;
  for (int i = 0; i < share(4000); ++i) {
    const double far = random.uniform(3, 30), side = random.uniform(0, kTurn);
    const Discs d{far * Vector2d(std::cos(side), std::sin(side)),
                  Vector2d(random.uniform(-4, 4), random.uniform(-4, 4)), random.uniform(0.5, 2.5),
                  random.uniform(0.5, 5), i % 4 == 0 ? kEver : random.uniform(1, 20)};
    const Band band = headings(d);
    const std::vector<double> expected = d.true_ends(), found = ends_of(band);
    ASSERT_EQ(found.size(), expected.size()) << "case " << i;
    for (const Range& range : band.free)
      for (int k = 1; k < 50; ++k, ++frees)
        ASSERT_FALSE(d.meet(range.from + (range.to - range.from) * k / 50)) << "case " << i;
    for (const Range& range : band.conflict)
      for (int k = 1; k < 50; ++k, ++conflicts)
        ASSERT_TRUE(d.meet(range.from + (range.to - range.from) * k / 50)) << "case " << i;
    for (std::size_t k = 0; k < found.size(); ++k) worst = std::max(worst, std::abs(found[k] - expected[k]));
    some += !expected.empty();
    two += expected.size() > 2;
  }
  std::cout << "[ samples  ] " << frees << " free, " << conflicts << " in conflict\n";
  EXPECT_LT(worst, 1e-9 * kDegree);
  EXPECT_GT(some, share(4000) / 4);
  EXPECT_GT(two, 0);
  EXPECT_GE(frees, share(100'000));
  EXPECT_GE(conflicts, share(100'000));
}

TEST(BandsOfDiscs, LoseNoNeedle) {
  RandomBodies random(3822);
  SCOPED_TRACE(random.trace());
  constexpr double kMile = 1852;
  for (int i = 0; i < share(2000); ++i) {
    const double side = random.uniform(0, kTurn), own = random.uniform(60, 200);
    Discs d{random.uniform(9, 14) * kMile * Vector2d(std::cos(side), std::sin(side)), Vector2d::Zero(),
            random.log_uniform(0.15, 152), own, kEver};
    // On a collision with some heading, at a speed of the other's own.
    const double heading = random.uniform(0, kTurn), time = random.uniform(60, 300);
    d.u = own * Vector2d(std::sin(heading), std::cos(heading)) - d.c / time;
    const Band band = headings(d);
    ASSERT_FALSE(band.conflict.empty()) << "needle " << i;
    const auto holds = [&](const Range& range) { return range.from <= heading && heading <= range.to; };
    ASSERT_TRUE(std::any_of(band.conflict.begin(), band.conflict.end(), holds)) << "needle " << i;
  }
}

/// By another way: bearing and time of a tangent, in plane geometry.
TEST(BandsOfDiscs, TurnWithTheWorldAndShrinkWithTheHorizon) {
  RandomBodies random(3823);
  SCOPED_TRACE(random.trace());
  const auto free = [](const Band& band) {
    double sum = 0;
    for (const Range& range : band.free) sum += range.to - range.from;
    return sum;
  };
  for (int i = 0; i < share(400); ++i) {
    const double turn = random.uniform(0.5, 3);
    Discs d{Vector2d(random.uniform(3, 20), random.uniform(-5, 5)),
            Vector2d(random.uniform(-3, 3), random.uniform(-3, 3)), random.uniform(0.5, 2),
            random.uniform(1, 5), random.uniform(1, 10)};
    const Band here = headings(d);
    Discs turned = d;
    // Headings go clockwise.
    const Eigen::Rotation2Dd by(-turn);
    turned.c = by * d.c;
    turned.u = by * d.u;
    ASSERT_NEAR(free(headings(turned)), free(here), 1e-9);
    Discs longer = d, wider = d;
    longer.until *= 1.5;
    wider.radius *= 1.2;
    ASSERT_LE(free(headings(longer)), free(here) + 1e-9);
    if (wider.radius < d.c.norm()) {
      ASSERT_LE(free(headings(wider)), free(here) + 1e-9);
    }
  }
}

/// Free and conflict hold what single verdicts say, for every kind; ends leave little between.
TEST(Bands, HoldForBodiesOfEveryKind) {
  RandomBodies random(3824);
  SCOPED_TRACE(random.trace());
  int frees = 0, conflicts = 0;
  for (int i = 0; i < campaign_size(90, 900); ++i) {
    // The last: a union of bodies of flat, round and straight parts.
    const std::size_t which = static_cast<std::size_t>(i) % (kBodyKinds.size() + 1);
    const BodyKind kind = which < kBodyKinds.size() ? kBodyKinds[which] : BodyKind::pieces;
    const Placed agent(
        any_body(random, std::array{BodyKind::hull, BodyKind::ellipsoid, BodyKind::convex}[i / 2 % 3]),
        any_pose(random, 0.5));
    std::vector<Intruder> others;
    for (int k = 0; k <= i % 3; ++k)
      others.push_back({Placed(which < kBodyKinds.size() ? any_body(random, kind) : round_pieces(random),
                               any_pose(random, random.uniform(8, 15))),
                        random.uniform(0, 2) * random.direction()});
    const Vector3d v = random.uniform(0.5, 4) * random.direction();
    BandOptions options;
    options.horizon = {i % 5 == 0 ? 0.5 : 0, i % 4 == 0 ? kEver : random.uniform(2, 15)};
    options.wind = 0.5 * random.direction();
    options.altitude = {-9, 9};
    const Bands found = bands(agent, v, others, options);
    const double speed = std::hypot(v.x(), v.y());
    const auto meets = [&](const Vector3d& velocity, double height) {
      Placed moved = agent;
      moved.pose.position.z() += height;
      Verdict worst = Verdict::out;
      for (const Intruder& other : others)
        if (const Verdict one =
                Pair(moved, other.body).verdict(velocity + options.wind, other.velocity, options.horizon);
            one != Verdict::out)
          worst = one;
      return worst;
    };
    const auto check = [&](const Band& band, const char* what, auto&& ask) {
      SCOPED_TRACE(std::string(what) + " of case " + std::to_string(i) + ", " + to_string(kind));
      for (const Range& range : band.free)
        for (int k = 1; k < 8; ++k, ++frees)
          ASSERT_EQ(ask(range.from + (range.to - range.from) * k / 8), Verdict::out);
      for (const Range& range : band.conflict)
        for (int k = 1; k < 8; ++k, ++conflicts)
          ASSERT_NE(ask(range.from + (range.to - range.from) * k / 8), Verdict::out);
    };
    check(found.heading, "heading",
          [&](double q) { return meets(on(q, speed) + v.z() * Vector3d::UnitZ(), 0); });
    check(found.speed, "speed", [&](double q) {
      return meets({q * v.x() / speed, q * v.y() / speed, v.z()}, 0);
    });
    check(found.climb, "climb", [&](double q) { return meets({v.x(), v.y(), q}, 0); });
    check(found.altitude, "altitude", [&](double q) { return meets({v.x(), v.y(), 0}, q); });
  }
  EXPECT_GT(frees, 1000);
  EXPECT_GT(conflicts, 50);
}

/// Ends of two bodies that are neither round nor in the plane, from verdicts beside them.
TEST(Bands, LeaveNothingBetweenOfConvexBodies) {
  RandomBodies random(3825);
  SCOPED_TRACE(random.trace());
  double between = 0;
  for (int i = 0; i < share(400); ++i) {
    using enum BodyKind;
    const Placed agent(any_body(random, std::array{ellipsoid, hull, convex}[i % 3]), any_pose(random, 0.5));
    const Intruder other{
        Placed(any_body(random, i % 4 == 3 ? convex : ellipsoid), any_pose(random, random.uniform(9, 15))),
        2 * random.direction()};
    const Vector3d v = random.uniform(1, 4) * random.direction();
    const Bands found = bands(agent, v, {&other, 1}, {.horizon = {0, random.uniform(2, 15)}});
    double sum = kTurn;
    for (const auto* list : {&found.heading.free, &found.heading.conflict})
      for (const Range& range : *list) sum -= range.to - range.from;
    between = std::max(between, sum);
  }
  EXPECT_LT(between, 1e-9);
}

/// Points about a centre, evenly.
std::vector<Vector3d> on_sphere(int count) {
  std::vector<Vector3d> points;
  for (int k = 0; k < count; ++k) {
    const double z = -1 + (2 * k + 1.0) / count, level = std::sqrt(1 - z * z);
    points.emplace_back(level * std::cos(2.399963 * k), level * std::sin(2.399963 * k), z);
  }
  return points;
}

/// In a dent, where ellipsoids overlap and the bodies do not: against points of the agent and the
/// inequalities of the body, step by step.
TEST(Bands, InADentAreThoseOfTheBodyAsItIs) {
  RandomBodies random(3827);
  SCOPED_TRACE(random.trace());
  const std::vector<Vector3d> points = on_sphere(300);
  double between = 0;
  int freed = 0, altitudes = 0;
  for (int i = 0; i < campaign_size(6, 100); ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    const Vector3d semi(random.uniform(0.8, 1.2), random.uniform(0.8, 1.2), random.uniform(0.8, 1.2));
    const Ellipsoid outer = Ellipsoid::from_axes(Vector3d::Zero(), {5, 6, 5.5});
    const Delimiter<3> delimiter = hyperboloid(2, semi);
    const Intruder other{Placed(CombinedEllipsoid(outer, {delimiter})),
                         random.uniform(0, 0.5) * random.direction()};
    const Vector3d at(random.uniform(2.8, 3.4), random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3));
    constexpr double kRadius = 0.3;
    const double until = i % 3 == 0 ? kEver : random.uniform(2, 6);
    const Vector3d v = random.uniform(0.5, 2) * random.direction();
    const auto touches = [&](const Vector3d& velocity, double higher = 0) {
      const Vector3d w = velocity - other.velocity;
      const double longest = std::min(until, 20 / w.norm());
      for (int step = 0; step <= 400; ++step)
        for (const Vector3d& p : points) {
          const Vector3d x = at + higher * Vector3d::UnitZ() + longest * step / 400 * w + kRadius * p;
          if (x.cwiseQuotient(Vector3d(5, 6, 5.5)).squaredNorm() < 1 && delimiter.value(x) < 0) return true;
        }
      return false;
    };
    const Bands found =
        bands(ball(at, kRadius), v, {&other, 1}, {.horizon = {0, until}, .altitude = {-8, 8}});
    const double level = std::hypot(v.x(), v.y());
    const auto check = [&](const Band& band, double all, auto&& touches_at) {
      for (const Range& range : band.free) {
        ++freed;
        all -= range.to - range.from;
        for (int k = 1; k < 12; ++k) ASSERT_FALSE(touches_at(range.from + (range.to - range.from) * k / 12));
      }
      for (const Range& range : band.conflict) {
        all -= range.to - range.from;
        for (int k = 2; k < 11 && range.to - range.from > 0.2; ++k)
          ASSERT_TRUE(touches_at(range.from + (range.to - range.from) * k / 12));
      }
      between = std::max(between, all);
    };
    check(found.heading, kTurn, [&](double q) { return touches(on(q, level) + v.z() * Vector3d::UnitZ()); });
    check(found.climb, 2 * v.norm(), [&](double q) { return touches({v.x(), v.y(), q}); });
    check(found.altitude, 16, [&](double q) { return touches({v.x(), v.y(), 0}, q); });
    altitudes += !found.altitude.free.empty() && !found.altitude.conflict.empty();
  }
  EXPECT_GT(freed, campaign_size(6, 100));
  EXPECT_GT(altitudes, 0);
  EXPECT_LT(between, 0.02);
}

/// A room of 3,600 boxes and more: each heading is decided, and what single verdicts say.
TEST(Bands, AmongTheBoxesOfAMap) {
  std::vector<Box> boxes;
  for (int i = -30; i < 30; ++i)
    for (int j = -15; j < 15; ++j)
      for (const double side : {-3.1, 3.0}) {
        const double along = 0.1 * i, up = 0.1 * j;
        if (i >= 5 && i < 12 && side > 0) continue;  // a door
        boxes.push_back({{along, side, up}, {along + 0.1, side + 0.1, up + 0.1}});
        boxes.push_back({{side, along, up}, {side + 0.1, along + 0.1, up + 0.1}});
      }
  const Placed map(Body(Assembly::boxes(boxes))), agent(Ellipsoid::from_axes({0.2, 0.4, 0}, {0.3, 0.2, 0.1}));
  const Intruder room{map, {0, 0.1, 0}};
  const Pair pair(agent, map);
  for (const double lateral : {0.0, 2.0}) {
    const Bands found = bands(agent, {1, 0.7, 0}, {&room, 1}, {.horizon = {0, 4}, .lateral = lateral});
    double decided = 0;
    for (const auto* list : {&found.heading.free, &found.heading.conflict})
      for (const Range& range : *list) {
        decided += range.to - range.from;
        for (int k = 1; k < 40 && lateral == 0; ++k) {
          const double heading = range.from + (range.to - range.from) * k / 40;
          const Verdict verdict = pair.verdict(on(heading, std::hypot(1, 0.7)), room.velocity, {0, 4});
          ASSERT_EQ(verdict == Verdict::out, list == &found.heading.free) << heading;
        }
      }
    EXPECT_GE(found.heading.free.size(), 1);
    if (lateral == 0) {
      EXPECT_GT(decided, kTurn - 1e-6);
    }
  }
}

/// Manoeuvres that take time, flown in small steps.
TEST(Bands, OfManoeuvresAreFreeWhenFlown) {
  RandomBodies random(3826);
  SCOPED_TRACE(random.trace());
  int flown = 0, missed = 0, free = 0, conflicts = 0, grazed = 0;
  std::vector<double> between;  // neither free nor conflict, of the whole range
  for (int i = 0; i < campaign_size(24, 240); ++i) {
    const Placed agent(any_body(random, BodyKind::ellipsoid), any_pose(random, 0.5));
    using enum BodyKind;
    const BodyKind kind = std::array{ellipsoid, hull, boxes, convex}[i % 4];
    const Intruder other{Placed(any_body(random, kind), any_pose(random, random.uniform(10, 20))),
                         random.direction()};
    const double until = random.uniform(6, 15);
    const Vector3d v =
        (other.body.pose.position - agent.pose.position) / random.uniform(4, 9) + other.velocity;
    BandOptions options;
    options.horizon = {0, until};
    options.lateral = random.uniform(0.3, 3);
    options.vertical = random.uniform(0.3, 1);
    options.longitudinal = random.uniform(0.3, 1);
    options.last = i % 4 == 0;
    const Bands found = bands(agent, v, {&other, 1}, options);
    const double speed = std::hypot(v.x(), v.y()), now = std::atan2(v.x(), v.y());
    if (Pair(agent, other.body).relation() != Relation::disjoint) continue;
    // Whether the agent, after `wait`, changes by a constant rate to q, and then goes on.
    const auto hits = [&](auto&& velocity_at, double wait) {
      constexpr int kSteps = 400;
      Vector3d x = Vector3d::Zero();
      for (int step = 0; step < kSteps; ++step) {
        const double t = until * step / kSteps, dt = until / kSteps;
        Placed moved = agent;
        moved.pose.position += x - t * other.velocity;
        if (relation_of(WorldBody(moved), WorldBody(other.body), 1e-6) == Relation::overlapping) return true;
        x += dt * velocity_at(t + 0.5 * dt - wait);
      }
      return false;
    };
    const auto turned = [&](double q) {
      const double by = std::remainder(q - now, kTurn), duration = std::abs(by) * speed / options.lateral;
      return [=](double t) {
        return Vector3d(on(now + by * std::clamp(t / duration, 0.0, 1.0), speed) + v.z() * Vector3d::UnitZ());
      };
    };
    const auto climbing = [&](double q) {
      const double duration = std::abs(q - v.z()) / options.vertical;
      return [=](double t) {
        return Vector3d(v.x(), v.y(), v.z() + (q - v.z()) * std::clamp(t / duration, 0.0, 1.0));
      };
    };
    const auto check = [&](const Band& band, double low, double high, auto&& flight) {
      for (int k = 0; k < 16; ++k, ++flown) {
        const double q = low + (high - low) * (k + 0.5) / 16;
        const bool said = std::any_of(band.free.begin(), band.free.end(),
                                      [&](const Range& r) { return r.from <= q && q <= r.to; });
        const bool hit = hits(flight(q), 0);
        ASSERT_FALSE(said && hit) << "case " << i << ", " << q;
        free += !hit;
        missed += !hit && !said;
      }
      // What conflicts hits, unless it only grazes between two steps.
      double left = high - low;
      for (const Range& range : band.free) left -= range.to - range.from;
      for (const Range& range : band.conflict) {
        left -= range.to - range.from;
        for (int k = 1; k < 6; ++k, ++conflicts)
          grazed += !hits(flight(range.from + (range.to - range.from) * k / 6), 0);
      }
      if (!band.conflict.empty()) between.push_back(left / (high - low));
    };
    check(found.heading, 0, kTurn, turned);
    check(found.climb, -v.norm(), v.norm(), climbing);
    if (!options.last || !(found.heading.last >= 0) || std::isinf(found.heading.last)) continue;
    // Well before the last moment some heading is free; it is not after the first contact.
    ASSERT_LE(found.heading.last, until);
    ASSERT_TRUE(found.time_to_violation);
    ASSERT_LE(found.heading.last, *found.time_to_violation * (1 + 1e-9));
    const double wait = 0.9 * found.heading.last;
    bool some = false;
    for (int k = 0; k < 720 && !some; ++k) some = !hits(turned(kTurn * k / 720), wait);
    ASSERT_TRUE(some) << "case " << i;
  }
  EXPECT_GT(free, flown / 4);
  EXPECT_LT(missed, flown / 50);
  EXPECT_GT(conflicts, campaign_size(24, 240));
  EXPECT_LE(grazed, conflicts / 50);
  std::sort(between.begin(), between.end());
  std::cout << "[ neither  ] median " << between[between.size() / 2] << ", at most " << between.back() << "; "
            << grazed << " of " << conflicts << " only graze\n";
  EXPECT_LT(between[between.size() / 2], 1e-3);
}

/// Margins: against the distances at many times, by a method of their own.
TEST(Bands, KeepTheMargin) {
  RandomBodies random(3828);
  SCOPED_TRACE(random.trace());
  int frees = 0, conflicts = 0;
  double between = 0;
  for (int i = 0; i < campaign_size(12, 120); ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    using enum BodyKind;
    const BodyKind kind = std::array{ellipsoid, hull, boxes, convex}[i % 4];
    const Placed agent(any_body(random, std::array{ellipsoid, hull, convex}[i / 4 % 3]),
                       any_pose(random, 0.5));
    const Intruder other{Placed(any_body(random, kind), any_pose(random, random.uniform(12, 18))),
                         random.direction()};
    BandOptions options;
    options.margin = random.uniform(0.2, 1);
    options.horizon = {i % 4 == 0 ? 1.0 : 0, random.uniform(6, 12)};
    options.altitude = {-5, 5};
    const Vector3d v =
        (other.body.pose.position - agent.pose.position) / random.uniform(4, 7) + other.velocity;
    if (Pair(agent, other.body).distance() < 1) continue;
    // The distance is 1-Lipschitz: between two times the least is known to within a step's way.
    const auto least = [&](const Vector3d& velocity, double height) {
      constexpr int kSteps = 400;
      const double span = options.horizon.until - options.horizon.from;
      double result = kEver;
      for (int step = 0; step <= kSteps; ++step) {
        Placed moved = agent;
        moved.pose.position += (options.horizon.from + span * step / kSteps) * (velocity - other.velocity);
        moved.pose.position.z() += height;
        result = std::min(result, Pair(moved, other.body).distance());
      }
      return std::pair(result, result - 0.5 * span / kSteps * (velocity - other.velocity).norm());
    };
    const Bands found = bands(agent, v, {&other, 1}, options);
    const double speed = std::hypot(v.x(), v.y());
    const auto check = [&](const Band& band, double all, auto&& velocity, bool heights) {
      for (const auto* list : {&band.free, &band.conflict})
        for (const Range& range : *list) {
          all -= range.to - range.from;
          for (int k = 1; k < 5; ++k) {
            const double q = range.from + (range.to - range.from) * k / 5;
            const auto [most, lower] = least(velocity(q), heights ? q : 0);
            if (list == &band.free) {
              ASSERT_GE(most, options.margin * (1 - 1e-9));
              ++frees;
            } else {
              ASSERT_LE(lower, options.margin);
              ++conflicts;
            }
          }
        }
      if (kind != BodyKind::boxes) between = std::max(between, all);
    };
    check(
        found.heading, kTurn, [&](double q) { return Vector3d(on(q, speed) + v.z() * Vector3d::UnitZ()); },
        false);
    check(
        found.altitude, 10, [&](double) { return Vector3d(v.x(), v.y(), 0); }, true);
    ASSERT_EQ(found.time_to_violation.has_value(), least(v, 0).first < options.margin);
    if (found.time_to_violation) {
      options.horizon.until = *found.time_to_violation;
      if (options.horizon.until > options.horizon.from) {
        ASSERT_GE(least(v, 0).first, options.margin * (1 - 1e-9));
      }
    }
  }
  EXPECT_GT(frees, 50);
  EXPECT_GT(conflicts, 50);
  EXPECT_LT(between, 1e-4);
}

/// A ball with a margin is a larger ball, by manoeuvres too.
TEST(Bands, KeepTheMarginAsALargerBallDoes) {
  RandomBodies random(3829);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < campaign_size(20, 400); ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    const double margin = random.uniform(0.1, 1), radius = random.uniform(0.5, 2);
    const Vector3d at = random.uniform(8, 20) * random.direction(), u = random.direction();
    const Vector3d v = at / random.uniform(4, 8) + u;
    BandOptions options;
    options.horizon.until = random.uniform(8, 15);
    if (i % 2 == 0) options.lateral = options.longitudinal = options.vertical = random.uniform(0.5, 2);
    const Intruder plain{ball(at, radius), u}, larger{ball(at, radius + margin), u};
    const Bands whole = bands(ball(Vector3d::Zero(), 0.5), v, {&larger, 1}, options);
    options.margin = margin;
    const Bands kept = bands(ball(Vector3d::Zero(), 0.5), v, {&plain, 1}, options);
    for (const Band Bands::*band : {&Bands::heading, &Bands::speed, &Bands::climb})
      for (const auto list : {&Band::free, &Band::conflict}) {
        double difference = 0;
        for (const Range& range : kept.*band.*list) difference += range.to - range.from;
        for (const Range& range : whole.*band.*list) difference -= range.to - range.from;
        ASSERT_NEAR(difference, 0, options.lateral > 0 ? 1e-3 : 1e-8);
      }
    ASSERT_EQ(kept.time_to_violation.has_value(), whole.time_to_violation.has_value());
    if (kept.time_to_violation) {
      ASSERT_NEAR(*kept.time_to_violation, *whole.time_to_violation, 1e-9);
    }
  }
}

TEST(AlertBands, AreNestedAndSayTheWayOut) {
  RandomBodies random(3830);
  SCOPED_TRACE(random.trace());
  const auto holds = [](const std::vector<Range>& ranges, double q) {
    return std::any_of(ranges.begin(), ranges.end(),
                       [&](const Range& r) { return r.from <= q && q <= r.to; });
  };
  const std::array<double, 3> margins{6, 3, 0};
  int recovered = 0;
  for (int i = 0; i < campaign_size(20, 200); ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    // Within the outermost volume already, as a rule.
    const Vector3d out = random.direction();
    const Intruder other{ball(random.uniform(4.5, 8) * out, 1),
                         random.uniform(0, 1) * random.direction() - 0.5 * out};
    const Vector3d v = random.uniform(1, 2) * Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), 0.1);
    BandOptions options;
    options.horizon.until = 30;
    const AlertBands found = alert_bands(ball(Vector3d::Zero(), 1), v, {&other, 1}, margins, options);
    ASSERT_EQ(found.levels.size(), 3U);
    for (std::size_t k = 0; k < 3; ++k) {
      options.margin = margins[k];
      const Bands alone = bands(ball(Vector3d::Zero(), 1), v, {&other, 1}, options);
      ASSERT_EQ(alone.heading.free.size(), found.levels[k].heading.free.size());
      if (k > 0) {
        for (const Range& range : found.levels[k - 1].heading.free)
          ASSERT_TRUE(holds(found.levels[k].heading.free, 0.5 * (range.from + range.to)));
      }
    }
    if (!found.recovery) continue;
    ++recovered;
    ASSERT_TRUE(found.levels[0].heading.free.empty());
    // Out of the largest from then on, never in the least, by the distance of two points.
    const Vector3d w =
        on(found.recovery->heading, std::hypot(v.x(), v.y())) + v.z() * Vector3d::UnitZ() - other.velocity;
    const Vector3d c = other.body.pose.position;
    const auto nearest = [&](double from) {
      return (c - std::clamp(c.dot(w) / w.squaredNorm(), from, 30.0) * w).norm() - 2;
    };
    ASSERT_GT(nearest(0), 0);
    ASSERT_GE(nearest(found.recovery->time), 6 * (1 - 1e-9));
    // No heading of many is out sooner, by 1 %.
    for (int k = 0; k < 720; ++k) {
      const Vector3d other_w =
          on(kTurn * k / 720, std::hypot(v.x(), v.y())) + v.z() * Vector3d::UnitZ() - other.velocity;
      const double sooner = 0.99 * found.recovery->time, along = c.dot(other_w) / other_w.squaredNorm();
      const double least = (c - std::clamp(along, sooner, 30.0) * other_w).norm() - 2,
                   inner = (c - std::clamp(along, 0.0, 30.0) * other_w).norm() - 2;
      ASSERT_FALSE(least > 6 * (1 + 1e-9) && inner > 0) << k;
    }
  }
  EXPECT_GT(recovered, 3);
  const std::array<double, 2> wrong{1, 2};
  try {
    static_cast<void>(alert_bands(ball(Vector3d::Zero(), 1), {1, 0, 0}, {}, wrong, {}));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.field(), "margins[1]");
  }
}

TEST(Bands, SayWhenSafetyIsRegained) {
  // Inside a ball that flies away: nothing is free, the heading back is soonest.
  const Intruder around{ball({0, 1, 0}, 5), {0, 1, 0}};
  const Bands found = bands(ball(Vector3d::Zero(), 1), on(0, 2), {&around, 1}, {.horizon = {0, 60}});
  EXPECT_TRUE(found.heading.free.empty() && found.speed.free.empty() && found.climb.free.empty());
  EXPECT_EQ(found.time_to_violation, 0);
  ASSERT_TRUE(found.recovery);
  EXPECT_NEAR(found.recovery->heading, kPi, 0.02);
  EXPECT_NEAR(found.recovery->time, 5.0 / 3, 0.01);  // 6 m apart, 1 m on that side already, 3 m/s
}

TEST(Bands, OfWhatOnlyPassesForEver) {
  // Level over a box, along its top; at one velocity; a range of one value; a contact that is over by then.
  const Intruder box{{HullBody::box({-1, -1, -1}, {1, 1, 1}), Pose{{5, 3, 1}}}, {2, 0, 0}};
  const Bands beside = bands(ball(Vector3d::Zero(), 0.5), {2, 0, 0}, {&box, 1}, {});
  double free = 0;
  for (const Range& range : beside.climb.free) free += range.to - range.from;
  EXPECT_NEAR(free, 4, 1e-9);
  const Bands resting = bands(ball(Vector3d::Zero(), 0.5), Vector3d::Zero(), {&box, 1}, {});
  const Intruder still{box.body, Vector3d::Zero()};
  const Bands both = bands(ball(Vector3d::Zero(), 0.5), Vector3d::Zero(), {&still, 1}, {});
  EXPECT_EQ(both.heading.free.size(), 1U);
  EXPECT_EQ(both.speed.free.size(), 1U);
  EXPECT_EQ(resting.speed.free.size(), 1U);
  const Intruder ahead{ball({0, 10, 0}, 1), Vector3d::Zero()};
  BandOptions later;
  later.horizon = {20, 30};
  EXPECT_FALSE(bands(ball(Vector3d::Zero(), 1), on(0, 1), {&ahead, 1}, later).time_to_violation);
  later.horizon = {9, 30};
  EXPECT_EQ(bands(ball(Vector3d::Zero(), 1), on(0, 1), {&ahead, 1}, later).time_to_violation, 9);
}

TEST(Bands, RefuseWhatIsNone) {
  const Placed agent = ball(Vector3d::Zero(), 1);
  const auto refused = [&](const Vector3d& v, const BandOptions& options) {
    try {
      static_cast<void>(bands(agent, v, {}, options));
    } catch (const InputError& error) {
      return error.field();
    }
    return std::string("nothing");
  };
  const Vector3d v(1, 0, 0);
  EXPECT_EQ(refused({NAN, 0, 0}, {}), "velocity[0]");
  EXPECT_EQ(refused(v, {.horizon = {2, 1}}), "horizon");
  EXPECT_EQ(refused(v, {.horizon = {0, 0}}), "horizon");
  BandOptions options;
  options.speed = {2, 1};
  EXPECT_EQ(refused(v, options), "speed");
  options.speed = {-1, 1};
  EXPECT_EQ(refused(v, options), "speed");
  options.speed = {0, 0};
  options.lateral = -1;
  EXPECT_EQ(refused(v, options), "lateral");
  options.lateral = 1;
  EXPECT_EQ(refused(v, options), "horizon");
  const Bands alone = bands(agent, v, {}, {});
  ASSERT_EQ(alone.heading.free.size(), 1U);
  EXPECT_EQ(alone.heading.free[0].to, kTurn);
  EXPECT_FALSE(alone.time_to_violation);
}

}  // namespace
}  // namespace vericone::guidance
