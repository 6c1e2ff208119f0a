// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/geometry/world_body.h>

#include <gtest/gtest.h>
#include <vericone/testing/random_bodies.h>
#include <Eigen/Geometry>
#include <cmath>

#include "support/campaign.h"

namespace vericone::world_body_test {
namespace {

using Eigen::Vector3d;
using testing::any_body;
using testing::RandomBodies;
using testing::share;

/// The body about the origin, in world coordinates where that is a kind of its own.
WorldBody world_body(const Body& body) {
  if (body.quadric()) return *body.quadric();
  if (body.hull()) return *body.hull();
  return Placed(body);
}

TEST(WorldBody, PosedAndMovedStandWhereThePlacedBodyStands) {
  RandomBodies random(2101);
  SCOPED_TRACE(random.trace());
  for (const BodyKind kind : kBodyKinds)
    for (int i = 0; i < share(50); ++i) {
      const Body body = any_body(random, kind);
      const WorldBody own = world_body(body);
      EXPECT_EQ(own.placed() != nullptr,
                kind != BodyKind::ellipsoid && kind != BodyKind::combined && kind != BodyKind::hull);
      EXPECT_EQ(own.delimited(), kind == BodyKind::combined);
      const double angle = random.uniform(0.1, 3);
      const Vector3d axis = random.direction(), to = 5 * random.direction(), n = random.direction();
      const Eigen::Matrix3d rotation = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
      const double support = Placed(body, {to, rotation}).support(n);
      EXPECT_NEAR(own.posed(to, rotation).as_placed().support(n), support, 1e-12) << to_string(kind);
      EXPECT_NEAR(own.moved(Vector3d::Zero(), to, angle * axis, {}, 1).as_placed().support(n), support, 1e-12)
          << to_string(kind);
      EXPECT_LE(body.support(n), own.reach() * (1 + 1e-14));
      const double around = own.containing_ellipsoid().support(n);
      // The support of a delimited body is its ellipsoid's: it is not contained in the least one.
      if (kind != BodyKind::combined) {
        EXPECT_LE(body.support(n), around + 1e-12);
      }
      if (const auto farthest = own.support_point(n)) {
        EXPECT_NEAR(n.dot(*farthest), body.support(n), 1e-12);
      }
    }
}

TEST(WorldBody, ChangesAtItsRate) {
  RandomBodies random(2102);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < share(50); ++i) {
    const Body body = any_body(random, BodyKind::combined);
    const CombinedEllipsoid& own = *body.quadric();
    BodyRate rate{own.ellipsoid().shape() * random.uniform(-0.2, 0.2), {}};
    for (const Delimiter<3>& d : own.delimiters()) rate.delimiters.push_back({0.1 * d.matrix, 0.3});
    constexpr double kStep = 1e-5;
    const Vector3d zero = Vector3d::Zero();
    const WorldBody after = WorldBody(own).moved(zero, zero, zero, rate, kStep),
                    before = WorldBody(own).moved(zero, zero, zero, rate, -kStep);
    const Eigen::Matrix3d s =
        (after.quadric()->ellipsoid().shape() - before.quadric()->ellipsoid().shape()) / (2 * kStep);
    EXPECT_TRUE(s.isApprox(rate.shape, 1e-8));
    for (std::size_t k = 0; k < own.delimiters().size(); ++k) {
      const Delimiter<3>&x = after.quadric()->delimiters()[k], &y = before.quadric()->delimiters()[k];
      EXPECT_TRUE(((x.matrix - y.matrix) / (2 * kStep)).isApprox(rate.delimiters[k].matrix, 1e-8));
      EXPECT_NEAR((x.level - y.level) / (2 * kStep), 0.3, 1e-8);
    }
  }
}

TEST(WorldBody, InflatedHoldsAllThatIsNear) {
  RandomBodies random(2103);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < share(50); ++i) {
    const Body body = any_body(random, i % 2 ? BodyKind::combined : BodyKind::ellipsoid);
    const CombinedEllipsoid& solid = *body.quadric();
    const CombinedEllipse flat =
        central_section(solid, Vector3d::UnitX(), Vector3d::UnitY(), random.in_box(4).head<2>());
    const double distance = random.uniform(0.01, 1);
    const WorldBody around = WorldBody(solid).inflated(distance),
                    flat_around = WorldBody(flat).inflated(distance);
    for (int k = 0; k < 100; ++k) {
      const Vector3d u = random.direction(), e = distance * random.direction();
      EXPECT_LE(around.gauge(solid.center() + u / solid.gauge(u) + e), 1 + 1e-12);
      const Eigen::Vector2d v = u.head<2>(), f = distance * e.head<2>().normalized();
      Vector3d near = Vector3d::Zero();
      near.head<2>() = flat.center() + v / flat.gauge(v) + f;
      EXPECT_LE(flat_around.gauge(near), 1 + 1e-12);
    }
  }
}

TEST(WorldBody, WhatABodyOfAnotherKindHasNotIsRefused) {
  const WorldBody flat{CombinedEllipse(Ellipse())}, hull{HullBody::box({0, 0, 0}, {1, 1, 1})};
  EXPECT_THROW((void)flat.containing_ellipsoid(), InputError);
  EXPECT_THROW((void)hull.containing_ellipse(), InputError);
  EXPECT_THROW((void)hull.gauge({0, 0, 0}), InputError);
  EXPECT_THROW((void)hull.inflated(0.1), InputError);
}

}  // namespace
}  // namespace vericone::world_body_test
