// SPDX-License-Identifier: BSD-3-Clause
//
// Slabs and half-spaces: against walls so wide that nothing goes around them, closed forms, touches in whole
// numbers with the next doubles, and displacements that are tried.
#include <gtest/gtest.h>
#include <vericone/cones/slab.h>
#include <vericone/geometry/error.h>
#include <vericone/geometry/exact/rational.h>
#include <vericone/testing/random_bodies.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "support/campaign.h"

namespace vericone::testing {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;
using exact::Rational;

constexpr double kEver = std::numeric_limits<double>::infinity();
const Vector3d kStill = Vector3d::Zero();

bool is_delimited(const Body& body) {
  if (const auto* quadric = body.quadric()) return !quadric->is_ellipsoid();
  const auto* quadrics = body.quadrics();
  return quadrics &&
         std::any_of(quadrics->begin(), quadrics->end(), [](const auto& one) { return !one.is_ellipsoid(); });
}

/// A random body of any kind but those with hyperboloids.
Body solid(RandomBodies& random) {
  for (;;) {
    const Body body =
        any_body(random, kBodyKinds[std::size_t(random.integer(0, int(kBodyKinds.size()) - 1))]);
    if (!is_delimited(body)) return body;
  }
}

/// A wall 1 km wide is met as the slab is by bodies that go at most some 10 m along it.
TEST(Slabs, AreMetAsWideWallsAre) {
  RandomBodies random(4110);
  SCOPED_TRACE(random.trace());
  std::array<int, 6> seen{};
  constexpr double kTurned = 1e-12;  // m, roundings of its corners
  const int cases = campaign_size(25, 5'000);
  for (int i = 0; i < cases; ++i) {
    const double thick = random.coin() ? 0 : random.uniform(0.1, 3);
    const Pose wall{random.in_box(3), random.rotation()};
    const Placed agent(solid(random), any_pose(random, random.uniform(0, 6)));
    const HullBody box = HullBody::box({-500, -500, thick > 0 ? -thick : -500}, {500, 500, 0});
    const Vector3d n = random.uniform(0.1, 4) * wall.rotation.col(2);
    const double high = n.dot(wall.position);
    const SlabPair slab(agent, {n, thick > 0 ? high - thick * n.norm() : -kEver, high});
    const Pair pair(agent, Placed(box, wall));
    EXPECT_EQ(slab.relation(), pair.relation()) << i;
    for (int k = 0; k < 5; ++k) {
      const Vector3d v = random.in_box(1), u = random.in_box(1);
      const double along = std::abs(n.dot(v - u)) / n.norm();
      if (along < 0.05) continue;  // it would go around the wall
      const Verdict verdict = slab.verdict(v, u);
      EXPECT_EQ(verdict, pair.verdict(v, u)) << i;
      ++seen[std::size_t(verdict)];
      const auto contact = slab.contact(v, u), other = pair.contact(v, u);
      ASSERT_EQ(contact.has_value(), other.has_value()) << i;
      const Miss miss = slab.miss(v, u), far = pair.miss(v, u);
      if (slab.relation() != Relation::disjoint) continue;
      if (!contact) {
        EXPECT_LE(miss.least, far.most + kTurned);
        EXPECT_GE(miss.most, far.least - kTurned);
        EXPECT_LT(miss.most - miss.least, 1e-11);
        EXPECT_NEAR((miss.normal - far.normal).norm(), 0, 1e-4);
        continue;
      }
      EXPECT_LE(contact->earliest, other->latest + kTurned / along);  // of a wall that is turned: rounded
      EXPECT_GE(contact->latest, other->earliest - kTurned / along);
      EXPECT_LT(contact->latest - contact->earliest, 1e-9);
      const Vector3d on = *contact->point - contact->time * u;
      EXPECT_NEAR(std::min(std::abs(n.dot(on) - high), std::abs(n.dot(on) - high + thick * n.norm())), 0,
                  1e-8 * n.norm());
      // Before it and after it.
      EXPECT_EQ(slab.verdict(v, u, contact->earliest * (1 - 1e-9)), Verdict::out);
      EXPECT_EQ(slab.verdict(v, u, contact->latest * (1 + 1e-9)), Verdict::in);
    }
    if (const auto depth = slab.penetration()) {
      // Moved that far it is out, to rounding, and no shorter way along the normal is.
      const auto moved = [&](double by) {
        Placed there = agent;
        there.pose.position -= by * depth->normal;
        return SlabPair(there, {n, thick > 0 ? high - thick * n.norm() : -kEver, high}).relation();
      };
      EXPECT_EQ(moved(depth->most + 1e-9), Relation::disjoint);
      for (const double part : {-1.0, -0.7, 0.3, 0.9, 0.999})
        EXPECT_EQ(moved(part * (depth->least - 1e-9)), Relation::overlapping) << part;
      EXPECT_LT(depth->most - depth->least, 1e-9);
    }
  }
  EXPECT_GT(seen[std::size_t(Verdict::in)], cases / 4);
  EXPECT_GT(seen[std::size_t(Verdict::out)], cases / 4);
  EXPECT_GT(seen[std::size_t(Verdict::overlapping)], cases / 4);
}

/// Normals and bodies whose lengths are whole: with the next doubles on both sides of the touch.
TEST(Slabs, AreTouchedExactly) {
  struct Case {
    Body body;
    Vector3d normal;
    double reach;  // -min normal.x over the body
  };
  const Case cases[] = {
      {Convex::cylinder(5, 4), {3, 4, 0}, 25},
      {Convex::cylinder(5, 4), {3, 4, 12}, 5 * 5 + 2 * 12},
      {Convex::capsule(2, 6), {2, 3, 6}, 3 * 6 + 2 * 7},
      {Convex::cone(4, 6), {3, 4, 12}, 5 * 4 + 3 * 12},
      {Convex::box({1, 2, 3}), {1, -5, 7}, 1 + 10 + 21},
      {Convex::box({1, 2, 3}).swollen(0.5), {2, 3, 6}, 2 + 6 + 18 + 3.5},
      {Ellipsoid::from_axes(kStill, {2, 3, 6}, Matrix3d::Identity()), {1.5, 2, 1}, 9},
      {Convex::rounded(Ellipsoid::from_axes(kStill, {3, 1, 1}, Matrix3d::Identity()), 0.25),
       {2, 3, 6},
       9 + 0.25 * 7},
      {Assembly::cloud({{0, 0, 0}, {1, 1, 1}}, 3), {2, 3, 6}, 21},
  };
  for (const Case& one : cases) {
    for (const double offset : {0.0, -7.0, 1024.0}) {
      const auto relation = [&](double high) {
        return SlabPair(one.body, {one.normal, -kEver, high}).relation();
      };
      const double touch = -one.reach;
      EXPECT_EQ(relation(touch), Relation::touching);
      EXPECT_EQ(relation(std::nextafter(touch, -kEver)), Relation::disjoint);
      EXPECT_EQ(relation(std::nextafter(touch, kEver)), Relation::overlapping);
      // Placed elsewhere, and from below.
      const Placed there(one.body, Pose{Vector3d(offset, 0, 0), Matrix3d::Identity()});
      const double moved = offset * one.normal.x();
      EXPECT_EQ(SlabPair(there, {one.normal, -kEver, touch + moved}).relation(), Relation::touching);
      EXPECT_EQ(SlabPair(there, {-one.normal, -touch - moved, kEver}).relation(), Relation::touching);
      // They reach it at the very end: 8 away along the normal, at 4 a second.
      const double most = one.normal.cwiseAbs().maxCoeff();
      Vector3d w = kStill;
      for (int k = 0; k < 3; ++k)
        if (std::abs(one.normal(k)) == most) w(k) = one.normal(k) > 0 ? -1 : 1;
      const SlabPair away(one.body, {one.normal, -kEver, touch - 8 * most});
      EXPECT_EQ(away.verdict(w, kStill, 8), Verdict::on);
      EXPECT_EQ(away.verdict(w, kStill, std::nextafter(8, 9)), Verdict::in);
      EXPECT_EQ(away.verdict(w, kStill, std::nextafter(8, 7)), Verdict::out);
      EXPECT_EQ(away.verdict(kStill, -w), Verdict::in);
    }
  }
}

/// How far a body gets from a point, going straight.
double farthest(const Placed& agent, const Vector3d& from, const Vector3d& w, double until) {
  const Box bounds = agent.body.bounds();
  const double size = bounds.low.cwiseAbs().cwiseMax(bounds.high.cwiseAbs()).norm();
  return size +
         std::max((agent.pose.position - from).norm(), (agent.pose.position + until * w - from).norm());
}

/// The part that an agent can reach meets it when the slab does: any kind of agent, its own time.
TEST(Slabs, PartsOfThemAreMetAsTheyAre) {
  RandomBodies random(4112);
  SCOPED_TRACE(random.trace());
  std::array<int, 6> seen{};
  const int cases = campaign_size(60, 10'000);
  for (int i = 0; i < cases; ++i) {
    const Placed agent(solid(random), any_pose(random, random.uniform(0, 6)));
    const bool axis = random.coin();
    const Vector3d n = axis ? Vector3d((random.coin() ? 1 : -1) * Vector3d::Unit(i % 3))
                            : Vector3d(random.uniform(0.1, 4) * random.rotation().col(2));
    const double high = random.uniform(-4, 4) * n.norm(),
                 low = random.coin() ? -kEver : high - random.uniform(0, 3) * n.norm();
    const Slab slab{n, low, high};
    const SlabPair whole(agent, slab);
    const Vector3d about = random.in_box(2), foot = about + (high - n.dot(about)) / n.squaredNorm() * n;
    const Vector3d w = random.in_box(1) - (i % 2) * 0.8 * n.normalized();
    const double until = random.uniform(0, 12);
    const double extent = (farthest(agent, foot, w, until) + 3) * random.uniform(1, 2);
    const HullBody part = clipped(slab, about, extent);
    for (const Vector3d& corner : part.points()) {  // sampled: all of the part is in it, and little else
      EXPECT_LE(n.dot(corner), high + 1e-12 * n.norm() * (10 + extent));
      EXPECT_GE(n.dot(corner), low - 1e-12 * n.norm() * (10 + extent));
    }
    const Vector3d u = n.unitOrthogonal(), v = n.normalized().cross(u);
    for (int k = 0; k < 5; ++k) {
      const double turn = random.uniform(0, 2 * M_PI),
                   deep = std::isinf(low) ? extent : (high - low) / n.norm();
      const Vector3d x = foot + extent * (std::cos(turn) * u + std::sin(turn) * v) -
                         random.uniform(0, deep) * n.normalized();
      EXPECT_EQ(Pair(Placed(Convex::point(x)), Placed(part)).relation(), Relation::overlapping) << i;
    }
    const Pair pair(agent, Placed(part));
    const Verdict expected = whole.verdict(w, kStill, until);
    EXPECT_EQ(pair.relation(), whole.relation()) << i;
    EXPECT_EQ(pair.verdict(w, kStill, Horizon{0, until}), expected) << i;
    ++seen[std::size_t(expected)];
  }
  for (const Verdict verdict : {Verdict::in, Verdict::out, Verdict::overlapping})
    EXPECT_GT(seen[std::size_t(verdict)], cases / 12) << to_string(verdict);
}

TEST(Slabs, PartsOfThemAreTouchedExactlyAlongAxes) {
  const Placed drum(Convex::cylinder(5, 4), Pose{{3, 1e3, 7}, Matrix3d::Identity()});
  for (const double end : {5.0, std::nextafter(5, 6), std::nextafter(5, 4)}) {
    const Placed ground(clipped({{0, 0, 1}, -kEver, end}, {900, 3, 40}, 4e3));
    EXPECT_EQ(Pair(drum, ground).relation(), SlabPair(drum, {{0, 0, 1}, -kEver, end}).relation());
    const Placed wall(clipped({{-4, 0, 0}, -32, 4 * end}, {5, 5, 5}, 4e3));
    EXPECT_EQ(Pair(drum, wall).relation(), SlabPair(drum, {{-4, 0, 0}, -32, 4 * end}).relation());
  }
  // Where its own plane is no double the part is a rounding wider, never narrower.
  const HullBody third = clipped({{0, 0, 3}, -kEver, 1}, kStill, 9);
  EXPECT_GT(third.support({0, 0, 1}), 1. / 3);
  EXPECT_LT(third.support({0, 0, 1}), 1. / 3 + 4e-15);
  // A corner whose sum cancels to 0, 1e-30 below the plane.
  const Vector3d slanted(0.6, 0, 0.8), u = slanted.stableNormalized().unitOrthogonal(),
                                       v = slanted.stableNormalized().cross(u);
  double wide = 1;  // of extent 1, with its slack
  for (int i = 0; i < 60; ++i) wide = 1 + 0x1p-48 + 0x1p-48 * (wide + 1e-30 + 1e-30);
  const HullBody beside = clipped({slanted, -kEver, 1e-30}, wide * u + wide * v, 1);
  EXPECT_LT(beside.points()[0].norm(), 1e-29);
  EXPECT_GT(slanted.dot(beside.points()[0]), 0.9e-30);
  const auto field = [](const Slab& slab, const Vector3d& about, double extent) {
    try {
      static_cast<void>(clipped(slab, about, extent));
    } catch (const InputError& e) {
      return e.field();
    }
    return std::string();
  };
  EXPECT_EQ(field({}, kStill, 0), "extent");
  EXPECT_EQ(field({}, kStill, kEver), "extent");
  EXPECT_EQ(field({}, kStill, 1e308), "");
  EXPECT_EQ(field({{1, 2, 3}}, kStill, 1.7e308), "extent");
  EXPECT_EQ(field({{0, 0, 1}, -kEver, 1e20}, kStill, 1), "extent");
  EXPECT_EQ(field({}, {0, kEver, 0}, 1), "about");
  EXPECT_EQ(field({{0, 0, 0}}, kStill, 1), "slab.normal");
}

/// A normal's length counts with the heights, and with nothing else: powers of two change no bit.
/// All corners of a side are in front of it, and by roundings: of tilts below what a length of 1 shows, and
/// of slabs without thickness.
TEST(Slabs, PartsHoldTheirSidesWhateverTheNormal) {
  constexpr double kExtent = 1000;
  for (const Slab& slab :
       {Slab{{1e-8, 0, 1}, -std::numeric_limits<double>::infinity(), 0}, Slab{{0, -1e-9, 2}, 0.5, 0.5},
        Slab{{1, 2, 3}, 1, 1}, Slab{{0, 0, 3}, 1 - 0x1p-53, 1}, Slab{{0.1, 0.2, -0.3}, -2, 7}}) {
    const auto side = [&](const Eigen::Vector3d& corner, double height) {
      Rational sum = -Rational(height);
      for (int i = 0; i < 3; ++i) sum += Rational(slab.normal(i)) * Rational(corner(i));
      return sum;
    };
    Rational highest = -1000000, lowest = 1000000;
    int in_front = 0, behind = 0;
    const HullBody part = clipped(slab, {1, 2, 3}, kExtent);
    for (const Eigen::Vector3d& corner : part.points()) {
      const Rational over = side(corner, slab.high);
      highest = std::max(highest, over);
      in_front += over >= 0;
      if (!std::isfinite(slab.low)) continue;
      const Rational under = side(corner, slab.low);
      lowest = std::min(lowest, under);
      behind += under <= 0;
    }
    EXPECT_GE(in_front, 4);
    EXPECT_LE(highest, Rational(1e-11));
    if (!std::isfinite(slab.low)) continue;
    EXPECT_GE(behind, 4);
    EXPECT_GE(lowest, Rational(-1e-11));
  }
}

TEST(Slabs, NormalsHaveAnyLength) {
  const Placed drum(Convex::cylinder(5, 4).swollen(0.5), Pose{{3, 1, 2}, Matrix3d::Identity()});
  const Vector3d n(0.6, -0.3, 0.7);
  const SlabPair usual(drum, {n, -1, 2});
  ASSERT_EQ(usual.relation(), Relation::overlapping);
  for (const int power : {-1040, -700, -400, 350, 500, 1000}) {
    const auto scaled = [&](double x) { return std::ldexp(x, power); };
    const SlabPair pair(drum, {n.unaryExpr(scaled), scaled(-1), scaled(2)});
    EXPECT_EQ(pair.relation(), Relation::overlapping);
    const auto depth = pair.penetration(), expected = usual.penetration();
    ASSERT_TRUE(depth.has_value());
    if (power > -1000) {  // below, the normal itself has fewer digits
      EXPECT_EQ(depth->least, expected->least) << power;
      EXPECT_EQ(depth->most, expected->most) << power;
      EXPECT_EQ(depth->normal, expected->normal) << power;
    }
    EXPECT_NEAR(depth->most, expected->most, 1e-3) << power;
    EXPECT_NEAR(depth->normal.norm(), 1, 1e-15) << power;
    const Placed above(drum.body, Pose{{3, 1, 40}, Matrix3d::Identity()});
    const auto there =
                   SlabPair(above, {n.unaryExpr(scaled), scaled(-1), scaled(2)}).contact({0, 0, -1}, kStill),
               then = SlabPair(above, {n, -1, 2}).contact({0, 0, -1}, kStill);
    EXPECT_NEAR(there->time, then->time, 1e-2) << power;
    EXPECT_LT(there->latest - there->earliest, 1e-12) << power;
  }
  const auto depth = SlabPair(Body(), {{0, 0, 1e-200}, -kEver, 0}).penetration();
  EXPECT_EQ(depth->normal, Vector3d(0, 0, -1));
  EXPECT_NEAR(depth->most, 1, 1e-14);
  EXPECT_GE(depth->most, 1);
  EXPECT_LE(depth->least, 1);
}

TEST(Slabs, AreNotMetAlongTheirPlane) {
  const SlabPair ground(Placed(Convex::cylinder(1, 2), Pose{{0, 0, 5}, Matrix3d::Identity()}),
                        Slab{{0, 0, 1}, -kEver, 0});
  EXPECT_EQ(ground.verdict({1e9, 3, 0}, kStill), Verdict::out);
  EXPECT_EQ(ground.verdict({1e9, 3, -5e-324}, kStill), Verdict::in);
  EXPECT_EQ(ground.verdict({1e9, 3, 5e-324}, kStill), Verdict::out);
  const Miss miss = ground.miss({1, 0, 0}, kStill);
  EXPECT_EQ(miss.distance, 4);
  EXPECT_EQ(miss.time, 0);
  const auto safe = ground.safe_half_space();
  ASSERT_TRUE(safe.has_value());
  EXPECT_NEAR(safe->room, 4, 1e-12);
  EXPECT_EQ(safe->normal, Vector3d(0, 0, -1));
  // A slanted normal and a velocity whose product is 0 in whole numbers, and rounds to one that is not.
  const Vector3d n(0.1, 0.2, 0.3), along(n.y(), -n.x(), 0);
  const SlabPair slanted(Placed(Convex::cylinder(1, 2), Pose{{9, 9, 9}, Matrix3d::Identity()}),
                         Slab{n, -kEver, 0});
  EXPECT_EQ(slanted.verdict(along, kStill), Verdict::out);
  EXPECT_EQ(slanted.verdict(-along, kStill), Verdict::out);
}

TEST(Slabs, PartsOnBothSidesMeetThemEitherWay) {
  const Assembly both = Assembly::boxes({{{0, 0, 2}, {1, 1, 3}}, {{0, 0, -4}, {1, 1, -3}}});
  const SlabPair pair(Body(both), {{0, 0, 1}, -1, 1});
  EXPECT_EQ(pair.relation(), Relation::disjoint);
  EXPECT_EQ(pair.verdict({0, 0, 1}, kStill), Verdict::in);
  EXPECT_EQ(pair.verdict({0, 0, -1}, kStill), Verdict::in);
  EXPECT_EQ(pair.verdict({1, 0, 0}, kStill), Verdict::out);
  EXPECT_NEAR(pair.contact({0, 0, 1}, kStill)->time, 2, 1e-12);
  EXPECT_NEAR(pair.contact({0, 0, -1}, kStill)->time, 1, 1e-12);
  EXPECT_FALSE(pair.safe_half_space().has_value());
  // Moved down by 1.5 a part is in it: 0.5 up, not all of both parts above it.
  const SlabPair deep(Placed(both, Pose{{0, 0, -1.5}, Matrix3d::Identity()}), {{0, 0, 1}, -1, 1});
  ASSERT_TRUE(deep.penetration().has_value());
  EXPECT_NEAR(deep.penetration()->most, 0.5, 1e-12);
  EXPECT_GE(deep.penetration()->most, 0.5);
  EXPECT_LE(deep.penetration()->least, 0.5);
}

TEST(Slabs, ThatAreNoneAreRefused) {
  const auto field = [](const Slab& slab, const Body& body = Body()) {
    try {
      static_cast<void>(SlabPair(body, slab));
    } catch (const InputError& e) {
      return e.field();
    }
    return std::string();
  };
  const double none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(field({}), "");
  EXPECT_EQ(field({{0, 0, 0}}), "slab.normal");
  EXPECT_EQ(field({{0, kEver, 0}}), "slab.normal[1]");
  EXPECT_EQ(field({{0, 0, 1}, none, 0}), "slab.low");
  EXPECT_EQ(field({{0, 0, 1}, 2, 1}), "slab.high");
  EXPECT_EQ(field({{0, 0, 1}, -kEver, kEver}), "slab.high");
  RandomBodies random(4111);
  EXPECT_EQ(field({}, any_body(random, BodyKind::combined)), "agent");
  for (const double bad : {none, kEver}) {
    const Placed agent(Body(), Pose{{0, bad, 0}, Matrix3d::Identity()});
    try {
      static_cast<void>(SlabPair(agent, {}));
      ADD_FAILURE() << bad;
    } catch (const InputError& e) {
      EXPECT_EQ(e.field(), "pose.position[1]");
    }
  }
  EXPECT_THROW(static_cast<void>(SlabPair(Body(), {}).verdict({none, 0, 0}, kStill)), InputError);
  EXPECT_THROW(static_cast<void>(SlabPair(Body(), {}).verdict(kStill, kStill, -1)), InputError);
}

}  // namespace
}  // namespace vericone::testing
