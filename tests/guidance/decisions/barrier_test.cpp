// SPDX-License-Identifier: BSD-3-Clause
//
// Barriers: against closed forms of balls, distances at single times, every pair of parts, exact verdicts;
// and in a filter of velocities.
#include <vericone/guidance/barrier.h>

#include <gtest/gtest.h>
#include <vericone/cones/pair.h>
#include <vericone/geometry/convex.h>
#include <vericone/geometry/error.h>
#include <vericone/testing/random_bodies.h>
#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "guidance/decisions/balls.h"
#include "support/campaign.h"

namespace vericone::guidance {
namespace {

using Eigen::Vector3d;
using testing::any_body;
using testing::any_pose;
using testing::campaign_size;
using testing::RandomBodies;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Flight {
  Placed agent{Body()}, obstacle{Body()};
  Vector3d v = Vector3d::Zero(), u = Vector3d::Zero();
  double until = 0;

  Barrier answer() const { return barrier(Pair(agent, obstacle), v, u, until); }
  Placed agent_at(double time) const {
    Placed then = agent;
    then.pose.position += time * (v - u);
    return then;
  }
};

/// Half of them so that they come near.
Flight random_flight(RandomBodies& random, const Placed& agent, const Placed& obstacle) {
  Flight f{agent, obstacle};
  f.u = random.uniform(0, 2) * random.direction();
  const Vector3d c = obstacle.pose.position - agent.pose.position;
  f.v = f.u + (random.coin() ? Vector3d(c / random.uniform(2, 10) + random.uniform(0, 1) * random.direction())
                             : Vector3d(random.uniform(0, 3) * random.direction()));
  f.until = random.uniform(0, 12);
  return f;
}

Placed any_placed(RandomBodies& random, BodyKind kind, double distance) {
  return {any_body(random, kind), any_pose(random, distance)};
}

/// The least of a convex function between two numbers.
template <typename Of>
double least_between(double low, double high, const Of& of) {
  const double part = std::numbers::phi - 1;
  double a = high - part * (high - low), b = low + part * (high - low), at_a = of(a), at_b = of(b);
  for (int i = 0; i < 80; ++i) {
    const bool left = at_a < at_b;
    (left ? high : low) = left ? b : a;
    (left ? b : a) = left ? a : b;
    (left ? at_b : at_a) = left ? at_a : at_b;
    (left ? a : b) = left ? high - part * (high - low) : low + part * (high - low);
    (left ? at_a : at_b) = of(left ? a : b);
  }
  return std::min({at_a, at_b, of(low), of(high)});
}

/// Of two convex bodies that do not meet.
double least_distance(const Flight& f) {
  return least_between(0, f.until, [&](double t) { return Pair(f.agent_at(t), f.obstacle).distance(); });
}

/// Of ellipsoids, whether they meet or not: what a unit normal proves.
class Value {
 public:
  explicit Value(const Flight& f)
      : a_(in_world(f.agent.body.quadric()->ellipsoid(), f.agent.pose)),
        b_(in_world(f.obstacle.body.quadric()->ellipsoid(), f.obstacle.pose)),
        way_(f.until * (f.v - f.u)) {}
  double operator()(const Vector3d& n) const {
    return n.dot(b_.center() - a_.center()) - a_.radius(n) - b_.radius(n) - std::max(0.0, n.dot(way_));
  }

 private:
  Ellipsoid a_, b_;
  Vector3d way_;
};

/// The best of all normals, on finer and finer grids of angles. About w as the axis: the value has a crease
/// on the equator.
double best_of_all_normals(const Flight& f) {
  const Eigen::Matrix3d turn =
      Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), f.v - f.u).toRotationMatrix();
  const Value value(f);
  constexpr int kAround = 120;
  double best = -kInfinity, azimuth = 0, polar = 0;
  const auto look = [&](double x, double y) {
    const Vector3d n(std::cos(x) * std::sin(y), std::sin(x) * std::sin(y), std::cos(y));
    if (const double at = value(turn * n); at > best) best = at, azimuth = x, polar = y;
  };
  for (int i = 0; i < kAround; ++i)
    for (int k = 0; k <= kAround / 2; ++k)
      look(2 * std::numbers::pi * i / kAround, 2 * std::numbers::pi * k / kAround);
  for (double step = 0.03; step > 1e-9; step *= 0.7) {
    const double x = azimuth, y = polar;
    for (int i = -3; i <= 3; ++i)
      for (int k = -3; k <= 3; ++k) look(x + i * step, y + k * step);
  }
  return best;
}

TEST(Barrier, OfBallsByTheClosedForm) {
  RandomBodies random(4101);
  SCOPED_TRACE(random.trace());
  int met = 0, inside = 0;
  for (int i = 0; i < campaign_size(2000, 100000); ++i) {
    const double ra = random.uniform(0.1, 2), rb = random.uniform(0.1, 2);
    Flight f = random_flight(random, ball(random.in_box(1), ra),
                             ball(random.uniform(0.5, 12) * random.direction(), rb));
    if (i % 10 == 0) f.until = 0;
    if (i % 10 == 1) f.until = kInfinity;
    if (i % 10 == 2) f.v = f.u;
    const Vector3d c = f.obstacle.pose.position - f.agent.pose.position, w = f.v - f.u;
    const double time = w.isZero(0) ? 0 : std::clamp(c.dot(w) / w.squaredNorm(), 0.0, f.until);
    const Vector3d off = c - time * w, n = off.normalized();
    const double exact = off.norm() - ra - rb;
    if (off.norm() < 0.1) continue;  // any direction is as good
    const Barrier found = f.answer();
    SCOPED_TRACE("case " + std::to_string(i));
    met += exact < 0;
    inside += time > 0 && time < f.until;
    ASSERT_NEAR(found.h, exact, 1e-12);
    ASSERT_LE(found.least, exact + 1e-14);
    ASSERT_LE(found.h - found.least, 1e-11);
    ASSERT_NEAR(found.time, time, 1e-5 * (1 + time));
    ASSERT_LE((found.by_position + n).norm(), 1e-6);
    ASSERT_LE((found.by_velocity + time * n).norm(), 1e-5 * (1 + time));
    ASSERT_LE(found.by_rotation.norm(), 1e-6);
  }
  EXPECT_GT(met, 100);
  EXPECT_GT(inside, 300);
}

/// Not where one normal or time is about to take the place of another.
bool is_smooth(const Flight& f, const Barrier& found) {
  for (int k = 0; k < 12; ++k) {
    Flight moved = f;
    (k % 2 ? moved.agent.pose.position : moved.v)(k % 3) += k < 6 ? 1e-3 : -1e-3;
    if ((moved.answer().by_velocity - found.by_velocity).norm() > 0.01 * (1 + f.until)) return false;
  }
  return true;
}

/// Against central differences of `value(flight)`.
template <typename Value>
void expect_gradient(const Flight& f, const Barrier& found, double error, const Value& value) {
  constexpr double kStep = 1e-4;
  for (int k = 0; k < 3; ++k) {
    const auto slope = [&](const auto& move) {
      Flight before = f, after = f;
      move(before, -kStep);
      move(after, kStep);
      return (value(after) - value(before)) / (2 * kStep);
    };
    EXPECT_NEAR(found.by_position(k), slope([&](Flight& x, double by) { x.agent.pose.position(k) += by; }),
                error);
    EXPECT_NEAR(found.by_velocity(k), slope([&](Flight& x, double by) { x.v(k) += by; }),
                error * (1 + f.until));
    EXPECT_NEAR(found.by_rotation(k), slope([&](Flight& x, double by) {
                  x.agent.pose.rotation =
                      Eigen::AngleAxisd(by, Vector3d::Unit(k)).toRotationMatrix() * x.agent.pose.rotation;
                }),
                error * 5);
  }
}

TEST(Barrier, OfConvexBodiesByDistancesAtSingleTimes) {
  RandomBodies random(4102);
  SCOPED_TRACE(random.trace());
  constexpr std::array kinds{BodyKind::ellipsoid, BodyKind::hull, BodyKind::convex};
  int apart = 0, inside = 0, differenced = 0;
  for (int i = 0; i < campaign_size(120, 4500); ++i) {
    const Flight f = random_flight(random, any_placed(random, kinds[i % 3], 0.3),
                                   any_placed(random, kinds[i / 3 % 3], random.uniform(4, 15)));
    if (Pair(f.agent, f.obstacle).verdict(f.v, f.u, {0, f.until}) != Verdict::out) continue;
    const double expected = least_distance(f);
    if (expected < 0.05) continue;
    SCOPED_TRACE("case " + std::to_string(i));
    const Barrier found = f.answer();
    ++apart;
    inside += found.time > 0 && found.time < f.until;
    EXPECT_NEAR(found.h, expected, 1e-8);
    EXPECT_LE(found.least, expected + 1e-8);
    EXPECT_LE(found.h - found.least, 1e-10);
    if (is_smooth(f, found)) {
      ++differenced;
      expect_gradient(f, found, 5e-5, least_distance);
    }
    // No normal beside it proves more.
    const Pair pair(f.agent, f.obstacle);
    for (double step = 1e-2; step > 1e-8; step /= 4)
      for (int k = 0; k < 10; ++k) {
        const Vector3d n = (step * random.direction() - found.by_position).normalized();
        EXPECT_LE(pair.gap(n) - f.until * std::max(0.0, n.dot(f.v - f.u)), found.h + 1e-11);
      }
  }
  EXPECT_GT(apart, 30);
  EXPECT_GT(inside, 8);
  EXPECT_GT(differenced, 0.8 * apart);
}

TEST(Barrier, OfEllipsoidsThatMeetByAllNormals) {
  RandomBodies random(4103);
  SCOPED_TRACE(random.trace());
  int met = 0, best = 0, differenced = 0;
  const int count = campaign_size(100, 5000);
  for (int i = 0; met < count; ++i) {
    const Flight f = random_flight(random, any_placed(random, BodyKind::ellipsoid, 0.3),
                                   any_placed(random, BodyKind::ellipsoid, random.uniform(0.5, 8)));
    const double expected = best_of_all_normals(f);
    if (!(expected < -0.05)) continue;
    SCOPED_TRACE("case " + std::to_string(i));
    const Barrier found = f.answer();
    ++met;
    ASSERT_NEAR(found.h, Value(f)(-found.by_position), 1e-12);
    ASSERT_LE(found.h - found.least, 1e-10);
    if (found.h < expected - 1e-6) continue;
    ++best;
    if (met % 10 != 0 || found.h > expected + 1e-9 || !is_smooth(f, found)) continue;
    ++differenced;
    expect_gradient(f, found, 1e-4, best_of_all_normals);
  }
  EXPECT_GE(best, 0.99 * met);
  EXPECT_GE(differenced, met / 20);
}

TEST(Barrier, OfFacesTurnsAboutThePlaceThatIsNearest) {
  // A ball above a corner of a box's face, and a box beside a box with a common stretch of two edges.
  Flight f;
  f.agent = Placed(HullBody::box({-2, -2, -1}, {2, 2, 0}));
  f.obstacle = ball({1.5, -1, 1.5}, 0.5);
  const Barrier one = f.answer();
  EXPECT_NEAR(one.h, 1, 1e-12);
  EXPECT_LE((one.by_rotation - Vector3d(0, 0, 1).cross(Vector3d(1.5, -1, 0))).norm(), 1e-9);
  f.obstacle = Placed(HullBody::box({-1, -1, -1}, {1, 1, 1}), Pose{{0, 0, 4}});
  f.v = {0, 0, 0.5};
  f.until = 2;
  const Barrier other = f.answer();
  EXPECT_NEAR(other.h, 2, 1e-12);
  EXPECT_NEAR(other.time, 2, 1e-12);
  EXPECT_LE((other.by_position - Vector3d(0, 0, -1)).norm(), 1e-9);
  // Two crossing bars of a hash: the nearest places are on neither's corners.
  f.agent = Placed(HullBody({{-3, 0, 0}, {3, 0, 0}}));
  f.obstacle = Placed(HullBody({{1, -3, 2}, {1, 1, 2}}));
  f.v.setZero();
  const Barrier crossed = f.answer();
  EXPECT_NEAR(crossed.h, 2, 1e-12);
  EXPECT_LE((crossed.by_rotation - Vector3d(0, 0, 1).cross(Vector3d(1, 0, 0))).norm(), 1e-9);
}

/// The parts of a body, each of which is one.
std::vector<Placed> parts(const Placed& body) {
  std::vector<Placed> all;
  if (const auto* one = body.body.quadric()) {
    all.emplace_back(one->ellipsoid(), body.pose);
  } else if (const auto* several = body.body.quadrics()) {
    for (const CombinedEllipsoid& part : *several) all.emplace_back(part.ellipsoid(), body.pose);
  } else if (const auto* pieces = body.body.assembly()) {
    for (std::size_t i = 0; i < pieces->size(); ++i) {
      if (pieces->kind() == PieceKind::convex)
        all.emplace_back(pieces->convex_piece(i), body.pose);
      else if (pieces->radius() > 0)
        all.emplace_back(
            Ellipsoid::from_axes(pieces->piece(i).points().front(), Vector3d::Constant(pieces->radius())),
            body.pose);
      else
        all.emplace_back(pieces->piece(i), body.pose);
    }
  } else {
    all.push_back(body);
  }
  return all;
}

TEST(Barrier, IsTheLeastOfAllParts) {
  RandomBodies random(4104);
  SCOPED_TRACE(random.trace());
  int apart = 0;
  for (const BodyKind first : kBodyKinds)
    for (const BodyKind second : kBodyKinds)
      for (int i = 0; i < campaign_size(8, 100); ++i) {
        SCOPED_TRACE(std::string(to_string(first)) + " and " + to_string(second) + ", " + std::to_string(i));
        const Flight f = random_flight(random, any_placed(random, first, 0.3),
                                       any_placed(random, second, random.uniform(4, 15)));
        const Barrier found = f.answer();
        double least = kInfinity;
        for (const Placed& a : parts(f.agent))
          for (const Placed& b : parts(f.obstacle))
            least = std::min(least, barrier(Pair(a, b), f.v, f.u, f.until).least);
        ASSERT_NEAR(found.least, least, 1e-12);
        ASSERT_NEAR(found.h, least, 1e-10);
        apart += least > 0;
      }
  EXPECT_GT(apart, 64 * campaign_size(8, 100) / 4);
}

TEST(Barrier, OfManyPartsLooksAtFew) {
  // A field of balls: the one that is nearest, not the first one.
  RandomBodies random(4105);
  SCOPED_TRACE(random.trace());
  std::vector<Vector3d> points;
  for (int i = 0; i < 20000; ++i) points.push_back(random.in_box(20));
  Flight f;
  f.obstacle = Placed(Assembly::cloud(points, 0.05));
  for (int i = 0; i < 20; ++i) {
    f.agent = ball(random.uniform(25, 60) * random.direction(), random.uniform(0.2, 1));
    f.v = random.uniform(0, 8) * random.direction();
    f.until = random.uniform(0, 3);
    double least = kInfinity;
    for (const Vector3d& x : points) {
      const Vector3d c = x - f.agent.pose.position;
      const double t = std::clamp(c.dot(f.v) / f.v.squaredNorm(), 0.0, f.until);
      least = std::min(least, (c - t * f.v).norm());
    }
    const Barrier found = f.answer();
    const double radius = f.agent.body.quadric()->ellipsoid().semi_axes().x();
    ASSERT_NEAR(found.h, least - radius - 0.05, 1e-10) << i;
  }
}

TEST(Barrier, AgreesWithExactVerdicts) {
  RandomBodies random(4106);
  SCOPED_TRACE(random.trace());
  int out = 0, in = 0;
  for (const BodyKind first : kBodyKinds)
    for (const BodyKind second : kBodyKinds)
      for (int i = 0; i < campaign_size(30, 400); ++i) {
        Flight f = random_flight(random, any_placed(random, first, 0.3),
                                 any_placed(random, second, random.uniform(3, 15)));
        const Pair pair(f.agent, f.obstacle);
        // Near to where they only just meet by then.
        if (i % 3 == 0)
          if (const auto contact = pair.contact(f.v, f.u); contact && std::isfinite(contact->time))
            f.until = std::max(0.0, contact->time * (1 + random.uniform(-1e-9, 1e-9)));
        const Verdict verdict = pair.verdict(f.v, f.u, {0, f.until});
        const Barrier found = f.answer();
        SCOPED_TRACE(std::string(to_string(first)) + " and " + to_string(second) + ", " + std::to_string(i) +
                     ": " + to_string(verdict));
        ASSERT_LE(found.least, found.h);
        if (found.least > 0) {
          ASSERT_EQ(verdict, Verdict::out);
        }
        if (verdict == Verdict::in || verdict == Verdict::overlapping) {
          ASSERT_LE(found.h, 1e-12);
        }
        out += found.least > 0;
        in += verdict == Verdict::in || verdict == Verdict::overlapping;
      }
  EXPECT_GT(out, 300);
  EXPECT_GT(in, 100);
}

TEST(Barrier, IsNeverAboveADistanceOnTheWay) {
  RandomBodies random(4107);
  SCOPED_TRACE(random.trace());
  constexpr std::array kinds{BodyKind::ellipsoid, BodyKind::hull, BodyKind::mesh, BodyKind::boxes};
  double worst = 0;
  for (int i = 0; i < campaign_size(300, 10000); ++i) {
    const Flight f = random_flight(random, any_placed(random, kinds[i % 2], 0.3),
                                   any_placed(random, kinds[i % 4], random.uniform(4, 15)));
    const Barrier found = f.answer();
    double most = kInfinity;
    for (int k = 0; k <= 20; ++k)
      most = std::min(
          most, Pair(f.agent_at(f.until * k / 20), f.obstacle).miss(Vector3d::Zero(), Vector3d::Zero()).most);
    most = std::min(most,
                    Pair(f.agent_at(found.time), f.obstacle).miss(Vector3d::Zero(), Vector3d::Zero()).most);
    ASSERT_LE(found.least, most + 1e-13) << i;
    if (found.h > 0) worst = std::max(worst, most - found.least);
  }
  EXPECT_LE(worst, 1e-6);  // at the time that it names they are as near as it says
}

TEST(Barrier, InAFilterOfVelocitiesKeepsThemApart) {
  // The agent wants to fly straight to its goal; of its velocity the one nearest that obeys
  // d/dt least >= -rate least is flown. One row, so that it is a projection.
  RandomBodies random(4108);
  SCOPED_TRACE(random.trace());
  int turned = 0, hits = 0;
  for (int i = 0; i < campaign_size(20, 300); ++i) {
    const Body shape = i % 2 ? Body(Ellipsoid::from_axes({0, 0, 0}, {0.3, 0.3, 0.3}))
                             : Body(Ellipsoid::from_axes({0, 0, 0}, {1, 0.2, 0.2}));
    Placed agent(shape, Pose{{-10, random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5)}});
    Placed obstacle(i % 3 ? Body(Ellipsoid::from_axes({0, 0, 0}, {0.8, 3, 1.5}, random.rotation()))
                          : any_body(random, BodyKind::hull));
    const Vector3d u = random.uniform(0, 0.5) * random.direction(), goal(12, 0, 0);
    constexpr double kStep = 0.01, kRate = 2, kSpeed = 1.5;
    hits +=
        Pair(agent, obstacle).verdict(kSpeed * (goal - agent.pose.position).normalized(), u) != Verdict::out;
    double least = kInfinity;
    for (int step = 0; step < 2500; ++step) {
      const Pair pair(agent, obstacle);
      Vector3d v = kSpeed * (goal - agent.pose.position).normalized();
      const Barrier now = barrier(pair, v, u, 0);
      least = std::min(least, now.least);
      const double rate = now.by_position.dot(v - u) + kRate * now.least;
      if (rate < 0) {
        v -= rate * now.by_position;  // of length 1
        ++turned;
      }
      // What one step does is proved by the barrier of the step.
      ASSERT_GT(barrier(pair, v, u, kStep).least, 0) << "case " << i << ", step " << step;
      agent.pose.position += kStep * v;
      obstacle.pose.position += kStep * u;
    }
    EXPECT_GT(least, 0);
  }
  EXPECT_GT(turned, 1000);
  EXPECT_GT(hits, campaign_size(20, 300) / 2);  // had they gone straight
}

TEST(Barrier, RefusesWhatIsNone) {
  const auto refused = [](auto&& set) {
    Flight f{ball({0, 0, 0}, 1), ball({5, 0, 0}, 1)};
    set(f);
    try {
      static_cast<void>(f.answer());
    } catch (const InputError& error) {
      return error.field();
    }
    return std::string("nothing");
  };
  EXPECT_EQ(refused([](Flight& f) { f.until = -1; }), "until");
  EXPECT_EQ(refused([](Flight& f) { f.until = NAN; }), "until");
  EXPECT_EQ(refused([](Flight& f) { f.v.y() = NAN; }), "agent_velocity[1]");
  EXPECT_EQ(refused([](Flight& f) { f.u.z() = kInfinity; }), "obstacle_velocity[2]");
  EXPECT_EQ(refused([](Flight&) {}), "nothing");
}

}  // namespace
}  // namespace vericone::guidance
