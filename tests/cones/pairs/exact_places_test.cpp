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

/// Multiples of 1/8: differences of them are doubles, sums with a place of 53 bits are not.
Vector3d coarse(RandomBodies& random, int most) {
  return Vector3d(random.integer(-most, most), random.integer(-most, most), random.integer(-most, most)) / 8;
}

std::vector<Vector3d> around(RandomBodies& random, const Vector3d& middle, int count) {
  std::vector<Vector3d> points;
  for (int i = 0; i < count; ++i) points.push_back(middle + coarse(random, 8));
  return points;
}

Known of_hull(std::vector<Vector3d> points) { return {HullBody(points), {points}}; }

Known any(RandomBodies& random, Kind kind) {
  const Vector3d none = Vector3d::Zero();
  Known known;
  switch (kind) {
    case Kind::point:
      return of_hull(around(random, none, 1));
    case Kind::segment:
      return of_hull(around(random, none, 2));
    case Kind::plate:
      return of_hull(around(random, none, 3));
    case Kind::hull:
      return of_hull(around(random, none, 5));
    case Kind::ball:
      known.radius = random.integer(1, 8) / 8.0;
      known.pieces = {{coarse(random, 8)}};
      known.body = Ellipsoid::from_axes(known.pieces[0][0], Vector3d::Constant(known.radius));
      return known;
    case Kind::balls: {
      known.radius = random.integer(1, 4) / 8.0;
      std::vector<CombinedEllipsoid> parts;
      for (int i = 0; i < 2; ++i) {
        known.pieces.push_back({coarse(random, 16)});
        parts.push_back(Ellipsoid::from_axes(known.pieces.back()[0], Vector3d::Constant(known.radius)));
      }
      known.body = Body::pieces(std::move(parts));
      return known;
    }
    case Kind::points:
    case Kind::cloud: {
      std::vector<Vector3d> centers;
      known.radius = kind == Kind::points ? 0 : random.integer(1, 4) / 8.0;
      for (int i = 0; i < 3; ++i) {
        centers.push_back(coarse(random, 16));
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
        const std::vector<Vector3d> corners = around(random, {4.0 * i, 0, 0}, 3);
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
        const Vector3d middle = Vector3d(4.0 * i, 0, 0) + coarse(random, 4);
        Vector3d half = coarse(random, 8).cwiseAbs() + Vector3d::Constant(0.125);
        half(random.integer(0, 2)) = 0;
        boxes.push_back({middle - half, middle + half});
        known.pieces.push_back(HullBody::box(middle - half, middle + half).points());
      }
      known.body = Assembly::boxes(boxes);
      return known;
    }
    case Kind::hulls: {
      std::vector<HullBody> hulls;
      for (int i = 0; i < 2; ++i) {
        known.pieces.push_back(around(random, {4.0 * i, 0, 0}, 4));
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

/// From about where a corner of one passes one of the other, and a bit beside.
Vector3d aimed(RandomBodies& random, const Known& a, const Vector3d& a_at, const Known& b,
               const Vector3d& b_at) {
  const auto& piece_a =
      a.pieces[static_cast<std::size_t>(random.integer(0, static_cast<int>(a.pieces.size()) - 1))];
  const auto& piece_b =
      b.pieces[static_cast<std::size_t>(random.integer(0, static_cast<int>(b.pieces.size()) - 1))];
  const Vector3d side = random.direction();
  const auto farthest = [&](const std::vector<Vector3d>& points, double sign) {
    Vector3d best = points.front();
    for (const Vector3d& x : points)
      if (sign * side.dot(x - best) > 0) best = x;
    return best;
  };
  Vector3d w = (farthest(piece_b, 1) - farthest(piece_a, -1)) + (b_at - a_at);
  const double radius = a.radius + b.radius;
  const double length = w.norm();
  if (radius > 0 && length > radius) {
    // Along a tangent of the ball about it, to rounding.
    const Vector3d u = w / length, across = (side - side.dot(u) * u).normalized();
    const double sine = radius / length;
    w = length * (std::sqrt(1 - sine * sine) * u + sine * across);
  }
  for (int k = 0; k < 3; ++k)
    for (int i = random.integer(-2, 2); i != 0; i += i < 0 ? 1 : -1)
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
    const Known a = any(random, first), b = any(random, second);
    // The same digits in both places, so that their difference is a double, or digits of their own.
    Vector3d a_at = random.in_box(1) / 3 + 1000 * random.in_box(1), b_at = a_at;
    if (random.coin()) {
      b_at = a_at + 5 * random.direction();
    } else {
      b_at.x() += 8;
      if (random.coin()) b_at.x() = std::nextafter(b_at.x(), 0);
      a_at.x() = b_at.x() - 8;
    }
    if (random.coin()) a_at -= b_at, b_at.setZero();
    const Vector3d v_b = coarse(random, 16), w = aimed(random, a, a_at, b, b_at);
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
        const Known a = any(random, first), b = any(random, second);
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

}  // namespace
}  // namespace vericone::exact_places
