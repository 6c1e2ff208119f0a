// SPDX-License-Identifier: BSD-3-Clause
//
// Views of convex hulls of points.
#include <gtest/gtest.h>
#include <vericone/guidance/plane_view.h>
#include <vericone/internal/cones/hulls/hull_oracle.h>

#include <cmath>

#include "guidance/engagements.h"

namespace vericone::guidance::plane_view_hulls_test {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;
using testing::RandomBodies;

const Ellipsoid& ellipsoid_of(const BodyState& body) { return body.shape.quadric()->ellipsoid(); }

BodyState hull_state(RandomBodies& random, const Vector3d& position, int count) {
  BodyState b;
  b.position = position;
  b.velocity = random.uniform(1, 5) * random.direction();
  b.omega = random.in_box(1);
  std::vector<Vector3d> points;
  for (int i = 0; i < count; ++i) points.push_back(position + random.uniform(1, 3) * random.direction());
  b.shape = HullBody(std::move(points));
  return b;
}

TEST(PlaneView, TrueSectorsOfHulls) {
  RandomBodies random(7226);
  SCOPED_TRACE(random.trace());
  int aside = 0, seen = 0;
  for (int i = 0; i < 100; ++i) {
    testing::MovingBody moving = testing::moving_body(random, random.in_box(5));
    const BodyState a = moving.state();
    BodyState b = hull_state(random, a.position + 9 * random.direction(), 12);
    // The reference point may be anywhere.
    if (i % 3 == 0) b.position += 6 * random.direction();
    const HullOracle oracle(ellipsoid_of(a), *b.shape.hull());
    const auto view = plane_view(a, b, random.direction(), SectorMethod::true_cone, RateMethod::none);
    if (!view) continue;
    ++seen;
    for (const double side : {1., -1.}) {
      const double edge = view->cone.theta_b + 0.5 * side * view->cone.psi;
      aside += side * edge < 0;
      const auto at = [&](double angle) {
        return oracle.membership(std::cos(angle) * view->line_of_sight + std::sin(angle) * view->across);
      };
      EXPECT_EQ(at(edge - 3e-8 * side), Membership::in) << i;
      EXPECT_EQ(at(edge + 3e-8 * side), Membership::out) << i;
    }
    const auto slice = plane_view(a, b, view->across, SectorMethod::slice, RateMethod::none);
    if (slice) {
      EXPECT_LE(slice->cone.psi, view->cone.psi + 1e-8);
    }
  }
  EXPECT_GT(aside, 5);
  EXPECT_GT(seen, 80);
}

TEST(PlaneViewRates, HullsOfOnePointAreTinyEllipsoids) {
  RandomBodies random(7227);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 50; ++i) {
    testing::MovingBody moving = testing::moving_body(random, random.in_box(5));
    moving.now.turning = Turning::with_heading;
    const BodyState a = moving.state();
    BodyState b;
    b.position = a.position + random.uniform(4, 8) * random.direction();
    b.velocity = random.uniform(1, 5) * random.direction();
    BodyState ball = b;
    b.shape = HullBody({b.position});
    ball.shape = CombinedEllipsoid(Ellipsoid::from_axes(b.position, Vector3d::Constant(1e-10)));
    const Vector3d across = random.direction();
    const auto view = plane_view(a, b, across, SectorMethod::true_cone, RateMethod::analytic, 0.3);
    const auto known = plane_view(a, ball, across, SectorMethod::true_cone, RateMethod::analytic, 0.3);
    ASSERT_TRUE(view && known);
    EXPECT_NEAR(view->cone.psi, known->cone.psi, 3e-9);
    EXPECT_NEAR(view->cone.theta_b, known->cone.theta_b, 3e-9);
    EXPECT_NEAR(view->cone.psi_rate, known->cone.psi_rate, 1e-4);
    EXPECT_NEAR(view->cone.theta_b_rate, known->cone.theta_b_rate, 1e-4);
    EXPECT_NEAR(view->cone.psi_rate_by_a, known->cone.psi_rate_by_a, 1e-4);
    EXPECT_NEAR(view->cone.theta_b_rate_by_a, known->cone.theta_b_rate_by_a, 1e-4);
  }
}

/// Against differences of sectors along the motion.
TEST(PlaneViewRates, TrueSectorsOfHulls) {
  RandomBodies random(7230);
  SCOPED_TRACE(random.trace());
  int compared = 0;
  for (int i = 0; i < 60; ++i) {
    testing::MovingBody moving = testing::moving_body(random, random.in_box(5));
    const double spin = random.uniform(-1, 1);
    const BodyState a = moving.state();
    const BodyState b = hull_state(random, a.position + random.uniform(8, 12) * random.direction(), 12);
    const auto view =
        plane_view(a, b, random.direction(), SectorMethod::true_cone, RateMethod::analytic, spin);
    if (!view) continue;
    const Vector3d c = b.position - a.position, v = b.velocity - a.velocity;
    const auto at = [&](double t) {
      BodyState later = b;
      later.position += t * b.velocity;
      std::vector<Vector3d> points;
      for (const Vector3d& x : b.shape.hull()->points())
        points.push_back(later.position + testing::turn(t * b.omega) * (x - b.position));
      later.shape = HullBody(std::move(points));
      const auto seen = plane_view(moving.at(t), later, testing::carried_axis(c, v, t, view->across, spin),
                                   SectorMethod::true_cone, RateMethod::none);
      return seen ? seen->cone : PlaneCone{};
    };
    const double scale = v.norm() / c.norm() + a.omega.norm() + b.omega.norm() + std::abs(spin);
    const double h = 0.003 / scale, close = 1e-6 * scale;
    const auto psi = testing::settled_derivative([&](double t) { return at(t).psi; }, h, close),
               theta_b = testing::settled_derivative([&](double t) { return at(t).theta_b; }, h, close);
    if (!psi || !theta_b) continue;
    ++compared;
    EXPECT_NEAR(view->cone.psi_rate, *psi, 2 * close) << i;
    EXPECT_NEAR(view->cone.theta_b_rate, *theta_b + view->state.v_theta / view->state.r, 2 * close) << i;
  }
  EXPECT_GT(compared, 40);
}

TEST(PlaneView, SlicesOfBoxes) {
  RandomBodies random(7228);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 200; ++i) {
    testing::MovingBody moving = testing::moving_body(random, random.in_box(5));
    const BodyState a = moving.state();
    BodyState b;
    b.position = a.position + 9 * random.direction();
    const Vector3d half(random.uniform(0.5, 2), random.uniform(0.5, 2), random.uniform(0.5, 2));
    const Eigen::Matrix3d r = random.rotation();
    std::vector<Vector3d> points;
    for (int k = 0; k < 8; ++k)
      points.push_back(b.position + r * Vector3d(k & 1 ? half.x() : -half.x(), k & 2 ? half.y() : -half.y(),
                                                 k & 4 ? half.z() : -half.z()));
    b.shape = HullBody(points);
    const auto view = plane_view(a, b, random.direction(), SectorMethod::slice, RateMethod::none);
    ASSERT_TRUE(view);
    const Vector3d &u = view->line_of_sight, &e = view->across;
    // The twelve edges cut by the plane; the sections collide along d where their shadows overlap.
    std::vector<Vector2d> corners;
    for (int k = 0; k < 8; ++k)
      for (int bit : {1, 2, 4})
        if (!(k & bit)) {
          const Vector3d x = points[k] - a.position, y = points[k | bit] - a.position;
          const double hx = x.dot(view->normal()), hy = y.dot(view->normal());
          if (hx * hy > 0) continue;
          const Vector3d z = x + hx / (hx - hy) * (y - x);
          corners.emplace_back(z.dot(u), z.dot(e));
        }
    const CombinedEllipse section = central_section(*a.shape.quadric(), u, e, Vector2d::Zero());
    const auto meet = [&](double angle) {
      const Vector2d m(-std::sin(angle), std::cos(angle));
      double low = 1e300, high = -1e300;
      for (const Vector2d& x : corners) low = std::min(low, m.dot(x)), high = std::max(high, m.dot(x));
      const double width = section.ellipsoid().radius(m);
      return low <= width && high >= -width;
    };
    for (const double side : {1., -1.}) {
      const double edge = view->cone.theta_b + 0.5 * side * view->cone.psi;
      EXPECT_TRUE(meet(edge - 1e-9 * side)) << i;
      EXPECT_FALSE(meet(edge + 1e-9 * side)) << i;
    }
  }
}

TEST(PlaneView, BodiesThatDoNotFitTogether) {
  RandomBodies random(7229);
  const BodyState hull = hull_state(random, {9, 0, 0}, 10);
  const BodyState solid = testing::moving_body(random, {0, 0, 0}).state();
  BodyState flat;
  flat.shape = CombinedEllipse(Ellipse());
  for (const SectorMethod method : {SectorMethod::true_cone, SectorMethod::slice}) {
    // A hull as the agent has no slices; its true sector opens as wide as the other way round.
    const auto turned_round = plane_view(hull, solid, {0, 1, 0}, method, RateMethod::analytic);
    ASSERT_EQ(turned_round.has_value(), method == SectorMethod::true_cone);
    if (turned_round) {
      EXPECT_NEAR(turned_round->cone.psi,
                  plane_view(solid, hull, {0, 1, 0}, method, RateMethod::none)->cone.psi, 3e-9);
    }
    EXPECT_FALSE(plane_view(flat, hull, {0, 1, 0}, method, RateMethod::analytic));
    EXPECT_TRUE(plane_view(solid, hull, {0, 1, 0}, method, RateMethod::analytic));
    BodyState near = solid;
    near.position = {8, 0, 0};
    near.shape = CombinedEllipsoid(ellipsoid_of(solid).translated(near.position));
    EXPECT_FALSE(plane_view(near, hull, {0, 1, 0}, method, RateMethod::analytic));
  }
}

}  // namespace
}  // namespace vericone::guidance::plane_view_hulls_test
