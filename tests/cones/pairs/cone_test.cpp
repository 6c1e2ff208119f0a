// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/cone.h>
#include <vericone/internal/cones/map/cell.h>

#include <gtest/gtest.h>
#include <vericone/cones/ellipsoids/true_cone.h>
#include <vericone/cones/pair.h>
#include <vericone/geometry/error.h>
#include <vericone/testing/random_bodies.h>
#include <cmath>
#include <numbers>
#include <thread>
#include <vector>

#include "support/campaign.h"

namespace vericone::cone_test {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;
using testing::any_body;
using testing::any_pose;
using testing::RandomBodies;
using testing::share;

Placed ball(const Vector3d& center, double radius) {
  return Placed(Ellipsoid::from_axes(center, Vector3d::Constant(radius)));
}

/// Where the answer of the cone is known without the pair, the pair says the same.
void expect_agreement(RandomBodies& random, const Pair& pair, const Cone& cone, int velocities) {
  int known = 0;
  for (int i = 0; i < velocities; ++i) {
    const Vector3d w =
        (cone.axis + random.uniform(0, 1.5) * random.direction()) * random.log_uniform(1e-3, 1e3);
    const Verdict verdict = pair.verdict(w, Vector3d::Zero());
    switch (cone.contains(w)) {
      case Certified::in:
        ASSERT_TRUE(verdict == Verdict::in || verdict == Verdict::on || verdict == Verdict::undecided)
            << to_string(verdict);
        ++known;
        break;
      case Certified::out:
        ASSERT_TRUE(verdict == Verdict::out || verdict == Verdict::undecided) << to_string(verdict);
        ++known;
        break;
      case Certified::undecided:
        break;
    }
  }
  EXPECT_GT(known, velocities * 8 / 10) << cone.method;
}

TEST(ConeOfPair, BallsHaveTheCapOfTheClosedForm) {
  const Pair pair(ball({0, 0, 0}, 1), ball({5, 0, 0}, 2));
  const Cone cone = pair.cone();
  const double angle = std::asin(3.0 / 5), cap = 2 * pi * (1 - std::cos(angle)),
               disc = pi * std::pow(std::tan(angle), 2);
  EXPECT_TRUE(cone.solid_angle.contains(cap));
  EXPECT_LT(2 * cone.solid_angle.rad(), 0.011 * cap);
  ASSERT_TRUE(cone.section);
  EXPECT_TRUE(cone.section->contains(disc));
  EXPECT_EQ(cone.contains({1, 0, 0}), Certified::in);
  EXPECT_EQ(cone.contains({-1, 0, 0}), Certified::out);
  EXPECT_EQ(cone.contains({0, 0, 0}), Certified::out);
  EXPECT_EQ(cone.contains(Vector3d(std::cos(angle * 0.99), std::sin(angle * 0.99), 0)), Certified::in);
  EXPECT_EQ(cone.contains(Vector3d(std::cos(angle * 1.01), std::sin(angle * 1.01), 0)), Certified::out);
  EXPECT_EQ(cone.contains(Vector3d(std::cos(angle), std::sin(angle), 0)), Certified::undecided);
  EXPECT_EQ(cone.contains(1e300 * Vector3d(1, 0.1, 0)), Certified::in);
  EXPECT_THROW(cone.contains({NAN, 0, 0}), InputError);
}

TEST(ConeOfPair, AgreesWithThePairForConvexAndDelimitedBodies) {
  RandomBodies random(1801);
  SCOPED_TRACE(random.trace());
  const std::vector<std::pair<BodyKind, BodyKind>> kinds{
      {BodyKind::ellipsoid, BodyKind::ellipsoid}, {BodyKind::ellipsoid, BodyKind::hull},
      {BodyKind::hull, BodyKind::ellipsoid},      {BodyKind::hull, BodyKind::hull},
      {BodyKind::ellipsoid, BodyKind::combined},  {BodyKind::combined, BodyKind::ellipsoid}};
  for (int i = 0; i < share(40); ++i)
    for (const auto& [first, second] : kinds) {
      const double distance = random.uniform(4, 7);
      const Placed a(any_body(random, first), any_pose(random, 0.5)),
          b(any_body(random, second), any_pose(random, distance));
      const Pair pair(a, b);
      if (pair.relation() != Relation::disjoint) continue;
      const Cone cone = pair.cone({.tolerance = 0.05});
      ASSERT_LE(cone.star_inner.solid_angle, cone.star_outer.solid_angle);
      ASSERT_NO_FATAL_FAILURE(expect_agreement(random, pair, cone, 60));
    }
}

TEST(ConeOfPair, AgreesWithThePairForMaps) {
  RandomBodies random(1802);
  SCOPED_TRACE(random.trace());
  for (const BodyKind kind : {BodyKind::mesh, BodyKind::cloud, BodyKind::boxes, BodyKind::pieces}) {
    const Placed a(any_body(random, BodyKind::ellipsoid), any_pose(random, 0.5)),
        b(any_body(random, kind), any_pose(random, 6));
    const Pair pair(a, b), mirrored(b, a);
    ASSERT_EQ(pair.relation(), Relation::disjoint);
    const ConeOptions options{.resolution = 0.05, .threads = 2};
    const Cone cone = pair.cone(options), reversed = mirrored.cone(options);
    EXPECT_TRUE(cone.complete);
    ASSERT_NO_FATAL_FAILURE(expect_agreement(random, pair, cone, 60));
    ASSERT_NO_FATAL_FAILURE(expect_agreement(random, mirrored, reversed, 60));
    EXPECT_NEAR(reversed.solid_angle.mid(), cone.solid_angle.mid(), 1e-12);
  }
}

TEST(ConeOfPair, OfBodiesThatAreNotApartHasEveryVelocity) {
  const Pair touching(ball({0, 0, 0}, 1), ball({3, 0, 0}, 2)),
      overlapping(ball({0, 0, 0}, 1), ball({1, 0, 0}, 2));
  for (const Pair& pair : {touching, overlapping}) {
    const Cone cone = pair.cone();
    EXPECT_EQ(cone.relation, pair.relation());
    EXPECT_EQ(cone.contains({-1, 0, 0}), Certified::in);
    EXPECT_EQ(cone.contains({0, 0, 0}), Certified::out);
    EXPECT_TRUE(cone.outer.empty());
  }
}

TEST(ConeOfPair, SeveralObstaclesMakeOneMap) {
  const Placed agent = ball({0, 0, 0}, 1);
  const std::vector<Pair> pairs{{agent, ball({6, 0, 0}, 1)}, {agent, ball({0, 6, 0}, 1)}};
  ConeMapOptions options;
  options.resolution = 0.05;
  const ConeMap both = cone_map(pairs, options);
  const double cap = 2 * pi * (1 - std::cos(std::asin(2.0 / 6)));
  EXPECT_LT(both.colliding, 2 * cap);
  EXPECT_GT(both.colliding + both.undecided, 2 * cap);
  EXPECT_EQ(both.cells[cell_at(both, {1, 0, 0})].label, Certified::in);
  EXPECT_EQ(both.cells[cell_at(both, {0, 1, 0})].label, Certified::in);
  EXPECT_EQ(both.cells[cell_at(both, {1, 1, 0})].label, Certified::out);
}

/// Polygons that are symmetric have corners at these azimuths, and steps along the radius.
TEST(ConeOfPair, KnowsDirectionsAtItsCorners) {
  const CombinedEllipsoid dented(Ellipsoid::from_axes({8, 0, 0}, {2, 3, 3}), {hyperboloid(2, {0.5, 1, 1})});
  const Cone cone = Pair(ball({0, 0, 0}, 1), Placed(dented)).cone({.tolerance = 0.02});
  EXPECT_EQ(cone.contains({1, 0, 0}), Certified::in);
  EXPECT_EQ(cone.contains({-1, 0, 0}), Certified::out);
  for (int i = 0; i < 16; ++i) {
    const double azimuth = 2 * pi * i / 16;
    EXPECT_EQ(cone.contains({1, std::cos(azimuth), std::sin(azimuth)}), Certified::out) << i;
    EXPECT_EQ(cone.contains({1, 0.1 * std::cos(azimuth), 0.1 * std::sin(azimuth)}), Certified::in) << i;
  }
}

TEST(ConeOfPair, RefusesATolerance) {
  const Pair pair(ball({0, 0, 0}, 1), ball({5, 0, 0}, 2));
  try {
    (void)pair.cone({.tolerance = 0});
    FAIL();
  } catch (const InputError& e) {
    EXPECT_EQ(e.field(), "tolerance");
  }
}

}  // namespace
}  // namespace vericone::cone_test
