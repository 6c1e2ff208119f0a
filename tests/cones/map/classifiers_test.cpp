// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/cones/ellipsoids/true_cone.h>
#include <vericone/cones/map/cone_map.h>
#include <vericone/internal/cones/map/cell.h>
#include <vericone/internal/cones/map/classifiers.h>

#include "cones/map/cone_map_checks.h"
#include "cones/opening/random_openings.h"
#include "support/random_combined.h"

namespace vericone::classifiers_test {
namespace {

using Eigen::Vector3d;
using testing::cap, testing::expect_never_contradicted, testing::RandomBodies;

ConeMap map_of(const DirectionClassifier& classifier, double resolution) {
  ConeMapOptions options;
  options.resolution = resolution;
  return cone_map(classifier, options);
}

Certified truth_of(Membership m) { return m == Membership::out ? Certified::out : Certified::in; }

TEST(EllipsoidClassifier, ThinAndDistantBodiesLeaveOnlyTheRim) {
  RandomBodies random(11);
  SCOPED_TRACE(random.trace());
  for (int k = 0; k < 30; ++k) {
    const auto [a, b] = random.scaled_from_touching(1e-3, 1e2, k % 2 ? 1.001 : 30);
    const TrueCone cone = true_cone(a, b, 64);
    double around = 0;  // the rim, radians
    for (std::size_t i = 0; i < cone.boundary.size(); ++i)
      around += (cone.boundary[(i + 1) % cone.boundary.size()].direction - cone.boundary[i].direction).norm();
    const double resolution = std::min(0.02, 0.02 * around);
    const ConeMap map = map_of(EllipsoidClassifier(a, b), resolution);
    EXPECT_LT(map.undecided, 2 * resolution * (around + 4 * resolution)) << k;
    const ConeOracle oracle(a, b);
    expect_never_contradicted(map, random, 500,
                              [&](const Vector3d& d) { return truth_of(oracle.membership(d)); });
  }
}

TEST(EllipsoidClassifier, BodiesThatTouchOrOverlapCollideEverywhere) {
  const Ellipsoid ball = Ellipsoid::from_axes({0, 0, 0}, {1, 1, 1});
  for (const double x : {0.0, 1.5, 2.0}) {
    const ConeMap map = map_of(EllipsoidClassifier(ball, Ellipsoid::from_axes({x, 0, 0}, {1, 1, 1})), 0.1);
    EXPECT_EQ(map.cells.size(), 20);
    EXPECT_NEAR(map.colliding, 4 * std::numbers::pi, 1e-13);
  }
}

TEST(CombinedClassifier, LiesBetweenTheCertifiedConesAndIsNeverContradicted) {
  RandomBodies random(12);
  SCOPED_TRACE(random.trace());
  for (int k = 0; k < 6; ++k) {
    const Vector3d at = random.uniform(4.5, 9) * random.direction();
    const Vector3d axes(random.uniform(1, 2), random.uniform(1, 2), random.uniform(1, 2));
    // Waisted about its longest extent: a hyperboloid of one sheet inside the ellipsoid.
    const CombinedEllipsoid obstacle(
        Ellipsoid::from_axes(at, 1.5 * axes, random.rotation()),
        {Delimiter<3>{Vector3d(1 / (axes.x() * axes.x()), 1 / (axes.y() * axes.y()), -0.5).asDiagonal(), 1}});
    const CombinedEllipsoid agent(random.ellipsoid({0, 0, 0}, 0.2, 0.8));
    const CombinedCone cone = combined_cone(agent, obstacle, 0.05);
    ASSERT_EQ(cone.relation, Relation::disjoint);
    const ConeMap map = map_of(CombinedClassifier(cone), 0.01);
    EXPECT_LE(map.colliding, cone.inner.solid_angle + 1e-12);
    EXPECT_GE(map.colliding + map.undecided, cone.outer.solid_angle - 1e-12);
    // What is undecided: the gap between the polygons, and a band of cells along each.
    EXPECT_LT(map.undecided,
              cone.outer.solid_angle - cone.inner.solid_angle + 3 * 0.01 * 2 * std::numbers::pi * 0.6);
    const CombinedOracle oracle(agent, obstacle);
    expect_never_contradicted(map, random, 800, [&](const Vector3d& d) { return oracle.membership(d); });
  }
}

TEST(CombinedClassifier, TwoEllipsoidsAsByTheirOwnClassifier) {
  const Ellipsoid a = Ellipsoid::from_axes({0, 0, 0}, {1, 0.5, 0.5});
  const Ellipsoid b = Ellipsoid::from_axes({3, 1, 2}, {1, 2, 0.3});
  const CombinedCone cone = combined_cone(a, b, 0.001);
  const ConeMap combined = map_of(CombinedClassifier(cone), 0.005),
                own = map_of(EllipsoidClassifier(a, b), 0.005);
  EXPECT_NEAR(combined.colliding, own.colliding, 0.02 * own.colliding);
  EXPECT_NEAR(combined.safe, own.safe, 0.02 * own.colliding);
  for (std::size_t i = 0; i < combined.cells.size(); ++i) {
    const Vector3d d = combined.cell(i)[0] + combined.cell(i)[1] + combined.cell(i)[2];
    const Certified other = own.cells[cell_at(own, d)].label, label = combined.cells[i].label;
    ASSERT_TRUE(label == other || label == Certified::undecided || other == Certified::undecided);
  }
}

TEST(CombinedClassifier, WithoutACone) {
  CombinedCone unknown;
  EXPECT_NEAR(map_of(CombinedClassifier(unknown), 0.5).undecided, 4 * std::numbers::pi, 1e-12);
  const Ellipsoid a;
  EXPECT_NEAR(map_of(CombinedClassifier(combined_cone(a, a, 0.1)), 0.5).colliding, 4 * std::numbers::pi,
              1e-12);
}

/// Hits the wall or touches the rim; passes, or goes away.
Certified truth_of(const OrificeOracle& oracle, const Vector3d& d) {
  const Vector3d& n = oracle.normal();
  const double toward = n.dot(oracle.center() - oracle.agent().center()) * n.dot(d);
  if (std::abs(toward) < 1e-12) return Certified::undecided;
  return toward < 0 || oracle.transit(d) == Transit::passes ? Certified::out : Certified::in;
}

TEST(OrificeClassifier, TheOrificeConeIsASafeRegion) {
  RandomBodies random(13);
  SCOPED_TRACE(random.trace());
  for (int k = 0; k < 10; ++k) {
    const Ellipsoid agent = random.ellipsoid(random.in_box(1), 0.1, 0.6);
    Orifice hole;
    hole.center = agent.center() + random.uniform(1.5, 3) * random.direction();
    do hole.normal = random.direction();
    while (std::abs(hole.normal.dot(hole.center - agent.center())) < 1);
    hole.radius = random.uniform(0.8, 1.5);
    const OrificeOracle oracle(agent, hole);
    ASSERT_EQ(oracle.side(), WallSide::clear);
    const ConeMap map = map_of(OrificeClassifier(agent, hole), 0.01);
    expect_never_contradicted(map, random, 2000, [&](const Vector3d& d) { return truth_of(oracle, d); });
    EXPECT_LT(map.undecided, 2 * 0.01 * 4 * std::numbers::pi);
    const Vector3d through = hole.center - agent.center();
    const auto region = region_around(map, through);
    if (oracle.transit(through) != Transit::passes) continue;
    ASSERT_TRUE(region) << k;
    EXPECT_EQ(region->label, Certified::out);
    const auto away = region_around(map, -through);
    ASSERT_TRUE(away);
    EXPECT_NE(region->possible, away->possible) << "proved to be apart";
    EXPECT_EQ(region->boundary.size(), 1);
    // The passing directions are convex, so on each half-plane about `through` they end once.
    const AxisFrame frame(through);
    double truth = 0;
    constexpr int kPlanes = 2000;
    for (int i = 0; i < kPlanes; ++i) {
      const double azimuth = 2 * std::numbers::pi * i / kPlanes;
      double low = 0, high = std::numbers::pi;
      for (int step = 0; step < 40; ++step) {
        const double t = 0.5 * (low + high);
        const Vector3d d = std::cos(t) * frame.axis +
                           std::sin(t) * (std::cos(azimuth) * frame.e1 + std::sin(azimuth) * frame.e2);
        (oracle.transit(d) == Transit::passes ? low : high) = t;
      }
      truth += cap(low) / kPlanes;
    }
    EXPECT_LE(region->solid_angle, truth * (1 + 1e-4));
    EXPECT_GE(region->most_solid_angle, truth * (1 - 1e-4));
    EXPECT_GT(region->solid_angle, 0.6 * truth);
  }
}

TEST(OrificeClassifier, OpeningsOfAnyOutline) {
  RandomBodies random(14);
  SCOPED_TRACE(random.trace());
  std::array<int, 3> found{};
  for (int k = 0; k < 12; ++k) {
    const int kind = k % 3;
    const Ellipsoid agent = random.ellipsoid(random.in_box(1), 0.03, 0.2);
    PlacedOpening hole =
        testing::random_placed(random, kind, agent.center() + random.uniform(1.2, 2) * random.direction());
    while (std::abs(hole.normal().dot(hole.center - agent.center())) < 1)
      hole.axes = random.rotation().leftCols<2>();
    const OrificeOracle oracle(agent, hole);
    ASSERT_EQ(oracle.side(), WallSide::clear);
    const ConeMap map = map_of(OrificeClassifier(agent, hole), 0.02);
    expect_never_contradicted(map, random, 2000, [&](const Vector3d& d) { return truth_of(oracle, d); });
    EXPECT_LT(map.undecided, 2 * 0.02 * 4 * std::numbers::pi) << "case " << k;
    EXPECT_GT(map.colliding, 1) << "the wall is half of all directions";
    const Vector3d through = hole.at(hole.opening.deepest()) - agent.center();
    if (oracle.transit(through) != Transit::passes) continue;
    const auto region = region_around(map, through);
    if (!region) continue;  // so tight that the cell is undecided
    ++found[kind];
    EXPECT_EQ(region->label, Certified::out);
    const auto away = region_around(map, -through);
    ASSERT_TRUE(away);
    EXPECT_NE(region->possible, away->possible) << "proved to be apart";
  }
  for (const int n : found) EXPECT_GE(n, 2);
}

TEST(OrificeClassifier, TwoRegionsOfOneOpening) {
  for (const double scale : {1.0, 0.3, 0.7}) {
    SCOPED_TRACE(scale);
    // Two chambers that a slit joins: the ball passes either, not the slit.
    std::vector<Eigen::Vector2d> corners{{-3, -1}, {-1, -1}, {-1, -0.1}, {1, -0.1}, {1, -1}, {3, -1},
                                         {3, 1},   {1, 1},   {1, 0.1},   {-1, 0.1}, {-1, 1}, {-3, 1}};
    for (Eigen::Vector2d& x : corners) x *= scale;
    const PlacedOpening hole{
        Opening::polygon(corners), {0, 0, 4 * scale}, Eigen::Matrix<double, 3, 2>::Identity()};
    const Ellipsoid ball = Ellipsoid::from_axes({0, 0, 0}, Vector3d::Constant(0.5 * scale));
    const ConeMap map = map_of(OrificeClassifier(ball, hole), 0.01);
    const OrificeOracle oracle(ball, hole);
    RandomBodies random(15);
    expect_never_contradicted(map, random, 2000, [&](const Vector3d& d) { return truth_of(oracle, d); });
    const auto left = region_around(map, {-2, 0, 4}), right = region_around(map, {2, 0, 4});
    ASSERT_TRUE(left && right);
    EXPECT_NE(left->possible, right->possible) << "proved to be apart";
    EXPECT_EQ(left->label, Certified::out);
    EXPECT_NEAR(left->solid_angle, right->solid_angle, 0.2 * left->solid_angle);
    const auto slit = region_around(map, {0, 0, 4});
    ASSERT_TRUE(slit);
    EXPECT_EQ(slit->label, Certified::in);
  }
}

TEST(OrificeClassifier, ABallBeforeAnOpeningThatFacesIt) {
  // Passing: the distance of the line from the whole rim is at least the ball's radius. Straight through the
  // middle of an opening of radius 2 a ball of 0.5 may turn until the rim's nearest point is 0.5 away.
  const OrificeClassifier classifier(Ellipsoid::from_axes({0, 0, 0}, {0.5, 0.5, 0.5}),
                                     {{3, 0, 0}, {1, 0, 0}, 2});
  const auto region = region_around(map_of(classifier, 0.005), {1, 0, 0});
  ASSERT_TRUE(region);
  // In a plane through the axis: the ray to the rim, turned inwards by asin(0.5 / its length).
  const double t = std::atan2(2, 3) - std::asin(0.5 / std::hypot(2, 3));
  EXPECT_LE(region->solid_angle, cap(t));
  EXPECT_GE(region->most_solid_angle, cap(t));
  EXPECT_LT(region->most_solid_angle - region->solid_angle, 2 * 0.005 * 2 * std::numbers::pi * std::sin(t));
}

TEST(OrificeClassifier, CutByTheWall) {
  const OrificeClassifier classifier(Ellipsoid(), {{0.5, 0, 0}, {1, 0, 0}, 2});
  EXPECT_NEAR(map_of(classifier, 0.5).undecided, 4 * std::numbers::pi, 1e-12);
}

TEST(AnyOfClassifier, SeveralObstacles) {
  RandomBodies random(14);
  SCOPED_TRACE(random.trace());
  const Ellipsoid agent = random.ellipsoid({0, 0, 0}, 0.3, 1);
  std::vector<std::shared_ptr<const DirectionClassifier>> each;
  std::vector<ConeOracle> oracles;
  for (int i = 0; i < 6; ++i) {
    const Ellipsoid body = random.ellipsoid(random.uniform(4, 8) * random.direction(), 0.3, 1.5);
    each.push_back(std::make_shared<EllipsoidClassifier>(agent, body));
    oracles.emplace_back(agent, body);
  }
  // One that needs its frontier.
  const CombinedEllipsoid waisted(Ellipsoid::from_axes({5, -3, 2}, {2, 2, 2}),
                                  {Delimiter<3>{Vector3d(1, 1, -0.5).asDiagonal(), 1}});
  each.push_back(std::make_shared<CombinedClassifier>(combined_cone(agent, waisted, 0.05)));
  const CombinedOracle last(agent, waisted);
  const ConeMap map = map_of(AnyOfClassifier(each), 0.01);
  expect_never_contradicted(map, random, 3000, [&](const Vector3d& d) {
    bool in = false;
    for (const ConeOracle& o : oracles) in = in || o.membership(d) != Membership::out;
    return in ? Certified::in : last.membership(d);
  });
  EXPECT_LT(map.undecided, 0.5);
  EXPECT_NEAR(map_of(AnyOfClassifier({}), 0.1).safe, 4 * std::numbers::pi, 1e-12);
}

TEST(MirroredClassifier, ExchangesTheBodies) {
  const Ellipsoid a = Ellipsoid::from_axes({0, 0, 0}, {1, 0.5, 0.5}),
                  b = Ellipsoid::from_axes({3, 1, 2}, {1, 2, 0.3});
  const MirroredClassifier mirrored(std::make_shared<EllipsoidClassifier>(b, a));
  const ConeMap map = map_of(mirrored, 0.01);
  const TrueCone cone = true_cone(a, b, 128);
  EXPECT_LE(map.colliding, cone.solid_angle);
  EXPECT_GE(map.colliding + map.undecided, cone.solid_angle);
  RandomBodies random(15);
  SCOPED_TRACE(random.trace());
  const ConeOracle oracle(a, b);
  expect_never_contradicted(map, random, 2000,
                            [&](const Vector3d& d) { return truth_of(oracle.membership(d)); });
}

}  // namespace
}  // namespace vericone::classifiers_test
