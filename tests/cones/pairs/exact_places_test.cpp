// SPDX-License-Identifier: BSD-3-Clause
//
// Pairs of bodies that stand somewhere, without a rotation, against rational arithmetic that tries all
// combinations of points (hull_reference.h). Their places are such that adding them to the points would
// round, and velocities graze, or nearly do.
#include <gtest/gtest.h>
#include <vericone/cones/pair.h>
#include <vericone/testing/random_bodies.h>
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include "cones/hulls/hull_reference.h"
#include "support/campaign.h"

namespace vericone::exact_places {
namespace {

using Eigen::Vector3d;
using testing::campaign_size;
using testing::RandomBodies;
using testing::Rational;
using testing::share;

enum class Kind {
  point,
  segment,
  plate,
  hull,
  ball,
  mesh,
  points,
  cloud,
  boxes,
  hulls,
  balls,
};
constexpr Kind kKinds[] = {Kind::point,  Kind::segment, Kind::plate, Kind::hull,  Kind::ball, Kind::mesh,
                           Kind::points, Kind::cloud,   Kind::boxes, Kind::hulls, Kind::balls};
constexpr const char* kNames[] = {"point",  "segment", "plate", "hull",  "ball", "mesh",
                                  "points", "cloud",   "boxes", "hulls", "balls"};

/// A body and its convex pieces: hulls of points, each with a ball of that radius about it.
struct Known {
  Body body;
  std::vector<std::vector<Vector3d>> pieces;
  double radius = 0;
};

/// What bodies are made of. Coarse numbers are multiples of 1/8: their differences are doubles, so that a
/// graze may be exact, and sums with a place of 53 bits below 1 are none. Fine ones have 53 bits: with places
/// of 1,000 m the sums lose 1e-13 m.
struct Numbers {
  RandomBodies& random;
  bool fine;

  Vector3d vector(int most) const {
    if (fine) return random.in_box(most / 8.0);
    return Vector3d(random.integer(-most, most), random.integer(-most, most), random.integer(-most, most)) /
           8;
  }
  double length(int most) const {
    return fine ? random.uniform(0.1, most / 8.0) : random.integer(1, most) / 8.0;
  }
  std::vector<Vector3d> around(const Vector3d& middle, int count) const {
    std::vector<Vector3d> points;
    for (int i = 0; i < count; ++i) points.push_back(middle + vector(8));
    return points;
  }
};

Known of_hull(std::vector<Vector3d> points) { return {HullBody(points), {points}}; }

Known any(const Numbers& numbers, Kind kind) {
  const Vector3d none = Vector3d::Zero();
  Known known;
  switch (kind) {
    case Kind::point:
      return of_hull(numbers.around(none, 1));
    case Kind::segment:
      return of_hull(numbers.around(none, 2));
    case Kind::plate:
      return of_hull(numbers.around(none, 3));
    case Kind::hull:
      return of_hull(numbers.around(none, 5));
    case Kind::ball:
      known.radius = numbers.length(8);
      known.pieces = {{numbers.vector(8)}};
      known.body = Ellipsoid::from_axes(known.pieces[0][0], Vector3d::Constant(known.radius));
      return known;
    case Kind::balls: {
      known.radius = numbers.length(4);
      std::vector<CombinedEllipsoid> parts;
      for (int i = 0; i < 2; ++i) {
        known.pieces.push_back({numbers.vector(16)});
        parts.push_back(Ellipsoid::from_axes(known.pieces.back()[0], Vector3d::Constant(known.radius)));
      }
      known.body = Body::pieces(std::move(parts));
      return known;
    }
    case Kind::points:
    case Kind::cloud: {
      std::vector<Vector3d> centers;
      known.radius = kind == Kind::points ? 0 : numbers.length(4);
      for (int i = 0; i < 3; ++i) {
        centers.push_back(numbers.vector(16));
        known.pieces.push_back({centers.back()});
      }
      known.body = Assembly::cloud(centers, known.radius);
      return known;
    }
    // Pieces that share no corner: where pieces join, a body is more than each of them.
    case Kind::mesh: {
      std::vector<Vector3d> points;
      std::vector<Assembly::Triangle> triangles;
      for (std::uint32_t i = 0; i < 2; ++i) {
        const std::vector<Vector3d> corners = numbers.around({4.0 * i, 0, 0}, 3);
        points.insert(points.end(), corners.begin(), corners.end());
        triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
        known.pieces.push_back(corners);
      }
      known.body = Assembly::mesh(points, triangles);
      return known;
    }
    case Kind::boxes: {
      std::vector<Box> boxes;
      for (int i = 0; i < 2; ++i) {
        // One side has no width, so that there are few corners.
        const Vector3d middle = Vector3d(4.0 * i, 0, 0) + numbers.vector(4);
        Vector3d half = numbers.vector(8).cwiseAbs() + Vector3d::Constant(0.125);
        half(numbers.random.integer(0, 2)) = 0;
        boxes.push_back({middle - half, middle + half});
        known.pieces.push_back(HullBody::box(middle - half, middle + half).points());
      }
      known.body = Assembly::boxes(boxes);
      return known;
    }
    case Kind::hulls: {
      std::vector<HullBody> hulls;
      for (int i = 0; i < 2; ++i) {
        known.pieces.push_back(numbers.around({4.0 * i, 0, 0}, 4));
        hulls.emplace_back(known.pieces.back());
      }
      known.body = Assembly::polyhedra(hulls);
      return known;
    }
  }
  return known;
}

/// All obstacle points less the agent's, in the world.
std::vector<testing::Vector> differences(const std::vector<Vector3d>& agent, const Vector3d& agent_at,
                                         const std::vector<Vector3d>& obstacle, const Vector3d& obstacle_at) {
  using testing::operator+;
  using testing::operator-;
  const testing::Vector between = testing::rational(obstacle_at) - testing::rational(agent_at);
  std::vector<testing::Vector> d = testing::differences(obstacle, agent);
  for (testing::Vector& x : d) x = x + between;
  return d;
}

Verdict truth(const Known& a, const Vector3d& a_at, const Known& b, const Vector3d& b_at, const Vector3d& v_a,
              const Vector3d& v_b) {
  using testing::operator-;
  const testing::Vector w = testing::rational(v_a) - testing::rational(v_b);
  const Rational radius = Rational(a.radius) + Rational(b.radius);
  bool touching = false, on = false, in = false;
  for (const auto& piece_a : a.pieces)
    for (const auto& piece_b : b.pieces) {
      const auto d = differences(piece_a, a_at, piece_b, b_at);
      const Relation now = radius > 0 ? testing::ball_and_points(d, radius) : testing::origin_and_points(d);
      if (now == Relation::overlapping) return Verdict::overlapping;
      touching = touching || now == Relation::touching;
      if (now != Relation::disjoint) continue;
      const Membership one =
          radius > 0 ? testing::cone_of_ball_and_points(d, radius, w) : testing::cone_of_points(d, w);
      in = in || one == Membership::in;
      on = on || one == Membership::on;
    }
  return touching ? Verdict::touching : in ? Verdict::in : on ? Verdict::on : Verdict::out;
}

/// A velocity that grazes, rounded, and a few roundings off: to the outermost corner of the differences on a
/// side, or to the tangent of the ball about it. The side is turned until it is across the velocity.
Vector3d aimed(RandomBodies& random, const Known& a, const Vector3d& a_at, const Known& b,
               const Vector3d& b_at) {
  std::vector<Vector3d> corners;
  const bool all = random.coin();
  for (const auto& piece_a : a.pieces)
    for (const auto& piece_b : b.pieces) {
      if (!all && !corners.empty()) continue;  // of the first pair of pieces
      for (const Vector3d& x : piece_a)
        for (const Vector3d& y : piece_b) corners.push_back((y - x) + (b_at - a_at));
    }
  const double radius = a.radius + b.radius;
  Vector3d side = random.direction(), w = corners.front();
  for (int i = 0; i < 8; ++i) {
    Vector3d farthest = corners.front();
    for (const Vector3d& x : corners)
      if (side.dot(x - farthest) > 0) farthest = x;
    const double length = farthest.norm();
    if (!(length > 1.001 * radius) || !(length > 0)) return farthest;
    const Vector3d u = farthest / length, across = (side - side.dot(u) * u).normalized();
    const double sine = radius / length, cosine = std::sqrt(1 - sine * sine);
    w = radius > 0 ? Vector3d(length * (cosine * u + sine * across)) : farthest;
    side = cosine * across - sine * u;
  }
  for (int k = 0; k < 3; ++k)
    for (int i = random.coin() ? random.integer(-2, 2) : 0; i != 0; i += i < 0 ? 1 : -1)
      w(k) = std::nextafter(w(k), i < 0 ? -1e9 : 1e9);
  return w;
}

class ExactPlaces : public ::testing::TestWithParam<std::tuple<Kind, Kind>> {};

TEST_P(ExactPlaces, VerdictsAreThoseOfTheNumbersAsGiven) {
  const auto [first, second] = GetParam();
  RandomBodies random(3100 + 17 * static_cast<std::uint64_t>(first) + static_cast<std::uint64_t>(second));
  SCOPED_TRACE(random.trace());
  int decided[6] = {};
  for (int i = 0; i < campaign_size(12, 170); ++i) {
    const Numbers numbers{random, random.coin()};
    const Known a = any(numbers, first), b = any(numbers, second);
    Vector3d a_at = random.in_box(numbers.fine ? 1000 : 0.5), b_at = a_at;
    if (random.coin()) {
      b_at += 5 * random.direction();  // digits of their own
    } else {
      // The same digits, so that the difference is a double.
      b_at.x() += 8;
      a_at.x() = b_at.x() - 8;
      if (random.coin()) b_at.y() = std::nextafter(b_at.y(), 0);
    }
    if (numbers.fine && random.coin()) a_at -= b_at, b_at.setZero();
    const Vector3d v_b = Numbers{random, false}.vector(16), w = aimed(random, a, a_at, b, b_at);
    const Vector3d v_a = random.coin() ? w : Vector3d(w + v_b);
    const Vector3d other = v_a == w ? Vector3d(Vector3d::Zero()) : v_b;
    const Verdict expected = truth(a, a_at, b, b_at, v_a, other);
    const Pair pair(Placed(a.body, {a_at}), Placed(b.body, {b_at}));
    ASSERT_EQ(pair.verdict(v_a, other), expected) << "line " << i;
    const Pair exchanged(Placed(b.body, {b_at}), Placed(a.body, {a_at}));
    ASSERT_EQ(exchanged.verdict(other, v_a), expected) << "line " << i;
    ASSERT_TRUE(pair.guarantee().exact && exchanged.guarantee().exact);
    ++decided[static_cast<int>(expected)];
    // What hangs on the verdict holds of the same bodies.
    const auto contact = pair.contact(v_a, other);
    ASSERT_EQ(contact.has_value(), expected != Verdict::out) << "line " << i;
    const Miss miss = pair.miss(v_a, other);
    ASSERT_LE(miss.least, miss.most) << "line " << i;
    ASSERT_EQ(miss.most > 0, expected == Verdict::out) << "line " << i;
  }
  RecordProperty("in", decided[static_cast<int>(Verdict::in)]);
  RecordProperty("on", decided[static_cast<int>(Verdict::on)]);
  RecordProperty("out", decided[static_cast<int>(Verdict::out)]);
}

INSTANTIATE_TEST_SUITE_P(Kinds, ExactPlaces,
                         ::testing::Combine(::testing::ValuesIn(kKinds), ::testing::ValuesIn(kKinds)),
                         [](const ::testing::TestParamInfo<ExactPlaces::ParamType>& info) {
                           return std::string(kNames[static_cast<int>(std::get<0>(info.param))]) + "_and_" +
                                  kNames[static_cast<int>(std::get<1>(info.param))];
                         });

/// Pair(a, b).verdict(v, u) == Pair(b, a).verdict(u, v), however the poses turn.
TEST(ExchangedPairs, AgreeNextToAGrazeOfTurnedBodies) {
  RandomBodies random(8);
  SCOPED_TRACE(random.trace());
  const Kind kinds[] = {Kind::plate, Kind::hull, Kind::ball, Kind::mesh, Kind::cloud, Kind::boxes};
  int pairs = 0;
  for (const Kind first : kinds)
    for (const Kind second : kinds)
      for (int i = 0; i < campaign_size(3, 40); ++i) {
        const Numbers numbers{random, true};
        const Known a = any(numbers, first), b = any(numbers, second);
        const Placed agent(
            a.body, {random.in_box(1), random.coin() ? random.rotation() : Eigen::Matrix3d::Identity()});
        const Placed obstacle(b.body, {Vector3d(9, 0, 0) + random.in_box(1), random.rotation()});
        const Pair pair(agent, obstacle), exchanged(obstacle, agent);
        const Vector3d still = Vector3d::Zero();
        ASSERT_EQ(pair.relation(), exchanged.relation());
        Vector3d in = obstacle.middle() - agent.middle(), out = in + 20 * random.direction();
        if (pair.verdict(in, still) != Verdict::in || pair.verdict(out, still) != Verdict::out) continue;
        for (;;) {
          const Vector3d middle = 0.5 * (in + out);
          if (middle == in || middle == out) break;
          const Verdict verdict = pair.verdict(middle, still);
          ASSERT_EQ(exchanged.verdict(still, middle), verdict) << to_string(verdict);
          (verdict == Verdict::out ? out : in) = middle;
        }
        ++pairs;
      }
  EXPECT_GT(pairs, 20);
}

/// A hull that an assembly holds alone, turned by a quarter, which rounds nothing: 2^-60 m tell.
TEST(ExactPlaces, ATurnedHullOfAnAssemblyLeavesTheOtherBodyAsItIs) {
  Eigen::Matrix3d quarter;
  quarter << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  const Placed box(HullBody::box({1, -1, -1}, {3, 1, 1}));
  const Placed low(HullBody::box({1, -1, -3}, {3, 1, -1}));
  const Assembly points = Assembly::polyhedra({HullBody::box({-1, -1, -1}, {1, 1, 1})});
  for (const double off : {-0x1p-60, 0.0, 0x1p-60}) {
    const Placed turned(points, Pose{{off, 0.5, 0.25}, quarter});
    const Relation expected = off < 0   ? Relation::disjoint
                              : off > 0 ? Relation::overlapping
                                        : Relation::touching;
    EXPECT_EQ(Pair(box, turned).relation(), expected) << off;
    EXPECT_EQ(Pair(turned, box).relation(), expected) << off;
    // Past its top, along x.
    const Placed above(points, Pose{{-9, 0.5, off}, quarter});
    const Verdict past = off < 0 ? Verdict::in : off > 0 ? Verdict::out : Verdict::on;
    EXPECT_EQ(Pair(low, above).verdict({-1, 0, 0}, Vector3d::Zero()), past) << off;
    EXPECT_EQ(Pair(above, low).verdict({1, 0, 0}, Vector3d::Zero()), past) << off;
  }
}

}  // namespace
}  // namespace vericone::exact_places
