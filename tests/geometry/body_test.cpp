// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/body.h>

#include <gtest/gtest.h>
#include <vericone/geometry/error.h>
#include <vericone/testing/random_bodies.h>
#include <algorithm>
#include <cmath>

#include "support/campaign.h"

namespace vericone::body_test {
namespace {

using Eigen::Vector3d;
using testing::any_body;
using testing::any_pose;
using testing::RandomBodies;
using testing::share;

/// Points of the body whose hull it has: corners, centres of balls, points on ellipsoids.
std::vector<Vector3d> points_of(RandomBodies& random, const Body& body) {
  std::vector<Vector3d> points;
  const auto add_quadric = [&](const CombinedEllipsoid& part) {
    for (int i = 0; i < 50; ++i) {
      const Vector3d u = random.direction();
      points.push_back(part.center() + u / part.gauge(u));
    }
  };
  if (const auto* part = std::get_if<CombinedEllipsoid>(&body.shape())) add_quadric(*part);
  if (const auto* parts = std::get_if<std::vector<CombinedEllipsoid>>(&body.shape()))
    for (const auto& part : *parts) add_quadric(part);
  if (const auto* hull = std::get_if<HullBody>(&body.shape())) points = hull->points();
  if (const auto* assembly = std::get_if<Assembly>(&body.shape()))
    for (std::size_t i = 0; i < assembly->size(); ++i) {
      const HullBody piece = assembly->piece(i);
      for (const Vector3d& x : piece.points()) {
        points.push_back(x);
        if (assembly->radius() > 0) points.push_back(x + assembly->radius() * random.direction());
      }
    }
  return points;
}

TEST(BodyOfAnyKind, SupportBoundsAndEllipsoidContainItsPoints) {
  RandomBodies random(2001);
  SCOPED_TRACE(random.trace());
  for (const BodyKind kind : kBodyKinds)
    for (int i = 0; i < share(100); ++i) {
      const Body body = any_body(random, kind);
      ASSERT_EQ(body.kind(), kind);
      const Placed placed(body, any_pose(random, 10));
      const Ellipsoid around = placed.containing_ellipsoid();
      const Eigen::Matrix3d inverse = around.shape().inverse();
      const Box box = body.bounds();
      const Vector3d n = random.direction();
      double most = -1e300;
      for (const Vector3d& x : points_of(random, body)) {
        const Vector3d world = placed.pose.to_world(x);
        most = std::max(most, n.dot(world));
        ASSERT_LE(n.dot(world), placed.support(n) + 1e-12) << to_string(kind);
        ASSERT_LE((world - around.center()).dot(inverse * (world - around.center())), 1 + 1e-9)
            << to_string(kind);
        ASSERT_TRUE((x.array() >= box.low.array() - 1e-12).all() &&
                    (x.array() <= box.high.array() + 1e-12).all());
      }
      if (kind == BodyKind::hull || kind == BodyKind::mesh || kind == BodyKind::boxes) {
        ASSERT_NEAR(placed.support(n), most, 1e-12) << to_string(kind);
      }
    }
}

TEST(BodyOfAnyKind, FlatAndSinglePointsHaveAnEllipsoidAround) {
  const std::vector<std::vector<Vector3d>> flat{
      {{1, 2, 3}}, {{0, 0, 0}}, {{0, 0, 0}, {1, 0, 0}}, {{0, 0, 5}, {1, 0, 5}, {0, 1, 5}, {1, 1, 5}}};
  for (const auto& points : flat) {
    const Ellipsoid around = Body(HullBody(points)).containing_ellipsoid();
    for (const Vector3d& x : points)
      EXPECT_LE((x - around.center()).dot(around.shape().inverse() * (x - around.center())), 1 + 1e-9);
  }
  const Body swelled = swollen(Body(HullBody({Vector3d(0, 0, 0)})), 2);
  EXPECT_LE((swelled.containing_ellipsoid().semi_axes() - Vector3d::Constant(2)).norm(), 1e-9);
}

TEST(BodyOfAnyKind, PosesComposeAndInvert) {
  RandomBodies random(2002);
  for (int i = 0; i < share(100); ++i) {
    const Pose first = any_pose(random, 3), second = any_pose(random, 5);
    const Vector3d x = random.in_box(4);
    EXPECT_LT((composed(first, second).to_world(x) - first.to_world(second.to_world(x))).norm(), 1e-13);
    EXPECT_LT((composed(first, inverse(first)).to_world(x) - x).norm(), 1e-13);
  }
}

TEST(BodyOfAnyKind, StandsInTheWorldAsItsPointsDo) {
  RandomBodies random(2003);
  for (int i = 0; i < share(100); ++i) {
    const auto body = *any_body(random, BodyKind::combined).quadric();
    const Pose pose = any_pose(random, 5);
    const CombinedEllipsoid moved = in_world(body, pose);
    const Vector3d u = random.direction();
    EXPECT_NEAR(moved.gauge(pose.rotation * u), body.gauge(u), 1e-9 * body.gauge(u));
    EXPECT_LT((moved.center() - pose.to_world(body.center())).norm(), 1e-14);
  }
  const Ellipsoid same = Ellipsoid::from_axes({1, 2, 3}, {1, 2, 3});
  EXPECT_EQ(in_world(same, Pose{}).factor(), same.factor());
}

TEST(BodyOfAnyKind, RefusesNoPieces) {
  try {
    (void)Body::pieces({});
    FAIL();
  } catch (const InputError& e) {
    EXPECT_EQ(e.field(), "pieces");
  }
}

}  // namespace
}  // namespace vericone::body_test
