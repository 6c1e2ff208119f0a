// SPDX-License-Identifier: BSD-3-Clause
//
// Cylinders, capsules, boxes and bodies with margins as pairs: what the same set says written in two ways,
// what contains what, and truths in closed form.
#include <gtest/gtest.h>
#include <vericone/cones/certificate.h>
#include <vericone/cones/cone.h>
#include <vericone/cones/pair.h>
#include <vericone/geometry/error.h>
#include <vericone/testing/random_bodies.h>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/campaign.h"

namespace vericone::convex_pair_test {
namespace {

using Eigen::Vector3d;
using testing::any_body;
using testing::any_pose;
using testing::RandomBodies;
using testing::share;

const Vector3d kRest = Vector3d::Zero();

/// At a body at `center`, or beside it.
Vector3d aimed(RandomBodies& random, const Vector3d& center) {
  return center + random.uniform(0, 4) * random.direction();
}

void expect_same(const Pair& one, const Pair& two, RandomBodies& random) {
  EXPECT_EQ(one.relation(), two.relation());
  for (int k = 0; k < 10; ++k) {
    const Vector3d w = aimed(random, one.obstacle().pose.position - one.agent().pose.position);
    ASSERT_EQ(one.verdict(w, kRest), two.verdict(w, kRest));
    const double until = random.uniform(0.2, 1.2);
    ASSERT_EQ(one.verdict(w, kRest, {0, until}), two.verdict(w, kRest, {0, until}));
    ASSERT_NEAR(one.miss(w, kRest).least, two.miss(w, kRest).least, 1e-7);
  }
}

TEST(ConvexPairs, TheSameSetWrittenInTwoWays) {
  RandomBodies random(3001);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < share(40); ++i) {
    const Pose here = any_pose(random, 0.5), there = any_pose(random, random.uniform(4, 9));
    const Placed other(any_body(random, kBodyKinds[std::size_t(random.integer(0, 1)) ? 7 : 2]), there);
    // Sizes on a grid, so that no sum below is rounded.
    const double r = random.integer(1, 12) / 8.0, length = random.integer(1, 20) / 4.0;
    const auto ball = [&](double z) { return Ellipsoid::from_axes({0, 0, z}, Vector3d::Constant(r)); };
    const Pair capsule(Placed(Convex::capsule(r, length), here), other);
    expect_same(capsule, Pair(Placed(Convex::hull_of(ball(-length / 2), ball(length / 2)), here), other),
                random);
    expect_same(
        capsule,
        Pair(Placed(Convex::segment({0, 0, -length / 2}, {0, 0, length / 2}).swollen(r), here), other),
        random);
    expect_same(Pair(Placed(Convex::cylinder(r, length), here), other),
                Pair(Placed(Convex::frustum(r, r, length), here), other), random);
    expect_same(Pair(Placed(Convex::cone(r, length), here), other),
                Pair(Placed(Convex::frustum(r, 0, length), here), other), random);
    expect_same(Pair(Placed(Convex::cylinder(r, 0), here), other), Pair(Placed(Convex::disc(r), here), other),
                random);
    const Vector3d half(r, length, 0.5);
    expect_same(Pair(Placed(Convex::box(half), here), other),
                Pair(Placed(HullBody::box(-half, half), here), other), random);
  }
}

/// Margins of the two bodies count together.
TEST(ConvexPairs, AMarginIsThatOfEitherBody) {
  RandomBodies random(3002);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < share(60); ++i) {
    const auto kind = [&] {
      return kBodyKinds[std::size_t(std::array{0, 2, 7}[std::size_t(random.integer(0, 2))])];
    };
    const Body a = any_body(random, kind()), b = any_body(random, kind());
    const auto base = [](const Body& body) {  // margins on a grid, so that their sums are not rounded
      return body.convex() ? Body(Convex::of_pieces(body.convex()->pieces())) : body;
    };
    const Pose here = any_pose(random, 0.5), there = any_pose(random, random.uniform(4, 9));
    const double r = random.integer(1, 8) / 8.0;
    const Pair on_a(Placed(swollen(base(a), r), here), Placed(base(b), there)),
        on_b(Placed(base(a), here), Placed(swollen(base(b), r), there)),
        on_both(Placed(swollen(base(a), r / 2), here), Placed(swollen(base(b), r / 2), there));
    for (int k = 0; k < 10; ++k) {
      const Vector3d w = aimed(random, there.position);
      const Verdict verdict = on_a.verdict(w, kRest);
      ASSERT_EQ(on_b.verdict(w, kRest), verdict);
      ASSERT_EQ(on_both.verdict(w, kRest), verdict);
      const Miss miss = on_a.miss(w, kRest),
                 without = Pair(Placed(base(a), here), Placed(base(b), there)).miss(w, kRest);
      if (miss.least > 0) {
        ASSERT_NEAR(without.distance - miss.distance, r, 1e-7);
      }
    }
  }
}

/// Prisms within and around a cylinder: the verdict is monotone.
TEST(ConvexPairs, ACylinderIsBetweenItsPrisms) {
  RandomBodies random(3003);
  SCOPED_TRACE(random.trace());
  constexpr int kSides = 64;
  const double wider = 1 / std::cos(std::numbers::pi / kSides);
  const auto prism = [&](double radius, double height) {
    std::vector<Vector3d> points;
    for (int i = 0; i < kSides; ++i)
      for (const double z : {-height / 2, height / 2}) {
        const double angle = 2 * std::numbers::pi * i / kSides;
        points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
      }
    return HullBody(std::move(points));
  };
  int between = 0, told = 0;
  for (int i = 0; i < share(60); ++i) {
    const double r = random.uniform(0.3, 1.5), height = random.uniform(0.2, 3);
    const Pose here = any_pose(random, 0.5), there = any_pose(random, random.uniform(4, 8));
    const Body other = any_body(random, random.coin() ? BodyKind::ellipsoid : BodyKind::hull);
    const Pair inner(Placed(prism(r * (1 - 1e-12), height * (1 - 1e-12)), here), Placed(other, there)),
        outer(Placed(prism(r * wider * (1 + 1e-12), height * (1 + 1e-12)), here), Placed(other, there)),
        own(Placed(Convex::cylinder(r, height), here), Placed(other, there));
    for (int k = 0; k < 20; ++k) {
      const Vector3d w = aimed(random, there.position);
      const Verdict verdict = own.verdict(w, kRest);
      if (inner.verdict(w, kRest) == Verdict::in) {
        ASSERT_EQ(verdict, Verdict::in);
        ++told;
      } else if (outer.verdict(w, kRest) == Verdict::out) {
        ASSERT_EQ(verdict, Verdict::out);
        ++told;
      } else {
        ++between;
      }
      ASSERT_LE(outer.miss(w, kRest).least, own.miss(w, kRest).most + 1e-9);
      ASSERT_GE(inner.miss(w, kRest).most, own.miss(w, kRest).least - 1e-9);
    }
  }
  EXPECT_LT(between, told / 20);
}

/// The least distance of two segments (D. Sunday's method, by clamped parameters on a fine search).
double segment_distance(const Vector3d& p, const Vector3d& q, const Vector3d& r, const Vector3d& s) {
  const auto to_segment = [](const Vector3d& x, const Vector3d& a, const Vector3d& b) {
    const double t = std::clamp((x - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    return (x - a - t * (b - a)).norm();
  };
  // Convex in the parameter: golden section.
  double low = 0, high = 1;
  for (int i = 0; i < 200; ++i) {
    const double one = low + (high - low) / 3, two = high - (high - low) / 3;
    const auto at = [&](double t) { return to_segment(p + t * (q - p), r, s); };
    (at(one) < at(two) ? high : low) = at(one) < at(two) ? two : one;
  }
  return to_segment(p + 0.5 * (low + high) * (q - p), r, s);
}

TEST(ConvexPairs, DistancesOfCapsulesAndOfABallAndACylinder) {
  RandomBodies random(3004);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < share(200); ++i) {
    const double r = random.uniform(0.1, 1), s = random.uniform(0.1, 1), l = random.uniform(0.5, 3),
                 m = random.uniform(0.5, 3);
    const Pose here = any_pose(random, 0.5), there = any_pose(random, random.uniform(5, 9));
    const Pair pair(Placed(Convex::capsule(r, l), here), Placed(Convex::capsule(s, m), there));
    const auto end = [](const Pose& pose, double z) { return pose.to_world({0, 0, z}); };
    const double truth =
        segment_distance(end(here, -l / 2), end(here, l / 2), end(there, -m / 2), end(there, m / 2)) - r - s;
    const Miss now = pair.miss(kRest, kRest);
    ASSERT_LE(now.least, truth + 1e-9);
    ASSERT_GE(now.most, truth - 1e-9);
    ASSERT_LE(now.most - now.least, 1e-6);
    // A ball past a cylinder.
    const Vector3d x = 4 * random.direction();
    const double radius = random.uniform(0.2, 1), height = random.uniform(0.2, 3),
                 ball = random.uniform(0.1, 0.5);
    const double beside = std::max(std::hypot(x.x(), x.y()) - radius, 0.0),
                 above = std::max(std::abs(x.z()) - height / 2, 0.0);
    const Pair other(Placed(Ellipsoid::from_axes(x, Vector3d::Constant(ball))),
                     Placed(Convex::cylinder(radius, height)));
    const Miss still = other.miss(kRest, kRest);
    ASSERT_LE(still.least, std::hypot(beside, above) - ball + 1e-9);
    ASSERT_GE(still.most, std::hypot(beside, above) - ball - 1e-9);
    ASSERT_LE(still.most - still.least, 1e-6);
  }
}

/// Of numbers whose touches are exact, and their neighbours.
TEST(ConvexPairs, TouchesOfUprightBodies) {
  const auto at = [](double x, double y, double z) { return Pose{{x, y, z}, Eigen::Matrix3d::Identity()}; };
  struct Case {
    Body a, b;
    Vector3d offset, w, beside;  // the last one takes it from touching to apart
  };
  const std::vector<Case> cases{
      {Convex::cylinder(2, 2), Convex::cylinder(3, 4), {3, 4, 8}, {0, 0, 1}, {1, 0, 0}},
      {Convex::cylinder(2, 2), Convex::cylinder(3, 4), {10, 5, 0}, {1, 0, 0}, {0, 1, 0}},
      {Convex::cylinder(2, 2), Convex::cylinder(3, 4), {10, 0, 3}, {1, 0, 0}, {0, 0, 1}},
      {Convex::capsule(1, 2), Convex::capsule(4, 2), {9, 5, 0}, {1, 0, 0}, {0, 1, 0}},
      {Convex::capsule(2, 4), Convex::box({1, 1, 1}), {8, 3, 0}, {1, 0, 0}, {0, 1, 0}},
      {Convex::box({1, 1, 1}), Convex::cylinder(2, 2), {8, 3, 0}, {1, 0, 0}, {0, 1, 0}},
      {Convex::box({1, 1, 1}), Convex::box({2, 2, 2}), {8, 3, 0}, {1, 0, 0}, {0, 1, 0}},
      {Ellipsoid::from_axes(kRest, {1, 2, 3}), Convex::cylinder(2, 2), {8, 4, 0}, {1, 0, 0}, {0, 1, 0}},
      {Convex::disc(1), Convex::disc(2), {8, 3, 0}, {1, 0, 0}, {0, 1, 0}},
      {Convex::cone(3, 4), Ellipsoid::from_axes(kRest, {1, 1, 1}), {8, 0, 3}, {1, 0, 0}, {0, 0, 1}}};
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Case& c = cases[i];
    const auto verdict = [&](const Vector3d& offset) {
      return Pair(Placed(c.a, at(0, 0, 0)), Placed(c.b, at(offset.x(), offset.y(), offset.z())))
          .verdict(c.w, kRest);
    };
    EXPECT_EQ(verdict(c.offset), Verdict::on) << i;
    for (const double step : {0x1p-20, 0x1p-40, 0x1p-48}) {
      EXPECT_EQ(verdict(c.offset + step * c.beside), Verdict::out) << i << ' ' << step;
      // A disc in its own plane has no inside to enter.
      EXPECT_EQ(verdict(c.offset - step * c.beside), i == 8 ? Verdict::on : Verdict::in) << i << ' ' << step;
    }
  }
}

/// A union of convex bodies is what its parts are.
TEST(ConvexPairs, AUnionSaysWhatItsPartsSay) {
  RandomBodies random(3005);
  SCOPED_TRACE(random.trace());
  int in = 0;
  for (int i = 0; i < share(40); ++i) {
    std::vector<Convex> parts;
    for (int k = 0; k < 5; ++k)
      parts.push_back(
          in_world(*any_body(random, BodyKind::convex).convex(), {random.in_box(2), random.rotation()}));
    const Pose there = any_pose(random, 9);
    const Pose upright{there.position, Eigen::Matrix3d::Identity()};
    const BodyKind kind = kBodyKinds[static_cast<std::size_t>(random.integer(0, 7))];
    const Placed other(any_body(random, kind), any_pose(random, 0.5));
    if (kind == BodyKind::combined || kind == BodyKind::pieces) continue;
    const Pair whole(other, Placed(Assembly::convexes(parts), upright));
    for (int k = 0; k < 10; ++k) {
      const Vector3d w = aimed(random, there.position);
      bool meets = false;
      double least = 1e300, most = 1e300;
      for (const Convex& part : parts) {
        const Pair one(other, Placed(part, upright));
        meets = meets || one.verdict(w, kRest) == Verdict::in;
        const Miss miss = one.miss(w, kRest);
        least = std::min(least, miss.least);
        most = std::min(most, miss.most);
      }
      in += meets;
      ASSERT_EQ(whole.verdict(w, kRest), meets ? Verdict::in : Verdict::out) << to_string(kind);
      const Miss miss = whole.miss(w, kRest);
      ASSERT_LE(miss.least, most + 1e-9);
      ASSERT_GE(miss.most, least - 1e-9);
      ASSERT_LE(miss.most - miss.least, 1e-2);
    }
  }
  EXPECT_GT(in, 20);
}

TEST(ConvexPairs, MarginsOfOtherBodies) {
  const Body mesh = Assembly::mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  const Body fat = swollen(mesh, 0.5);
  EXPECT_EQ(fat.kind(), BodyKind::pieces);
  const Body ball = Ellipsoid::from_axes({0.25, 0.25, 3}, Vector3d::Constant(0.5));
  EXPECT_NEAR(Pair(ball, fat).distance(), 2, 1e-9);
  EXPECT_NEAR(Pair(ball, swollen(Assembly::cloud({{0.25, 0.25, 0}}, 0.25), 0.5)).distance(), 1.75, 1e-9);
  EXPECT_THROW(static_cast<void>(swollen(mesh, -1)), InputError);
  EXPECT_THROW(static_cast<void>(Convex::cylinder(-1, 1)), InputError);
  EXPECT_EQ(swollen(mesh, 0).kind(), BodyKind::mesh);
}

}  // namespace
}  // namespace vericone::convex_pair_test
