// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/cones/slices/slice_cone.h>
#include <vericone/guidance/plane_view.h>
#include <vericone/internal/cones/ellipsoids/plane_sector.h>
#include <vericone/internal/cones/slices/slice_sector.h>
#include <vericone/internal/guidance/plane_view.h>

#include <cmath>

#include "cones/ellipsoids/richardson.h"
#include "guidance/engagements.h"
#include "support/allocations.h"

namespace vericone::guidance::plane_view_test {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;
using testing::RandomBodies, testing::richardson_derivative;

const Ellipsoid& ellipsoid_of(const BodyState& body) { return body.shape.quadric()->ellipsoid(); }

TEST(PlaneStates, ProjectTheCartesianMotion) {
  RandomBodies random(7201);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 1000; ++i) {
    const auto [moving_a, moving_b] = testing::moving_pair(random, 1.2, 4);
    const BodyState a = moving_a.state(), b = moving_b.state();
    const double spin = random.uniform(-1, 1);
    const PlaneView view = plane_states(a, b, random.direction(), spin);
    const Vector3d &u = view.line_of_sight, &e = view.across, n = view.normal();
    const Vector3d v = b.velocity - a.velocity;
    const PlanarState& s = view.state;
    EXPECT_LT((s.r * u - (b.position - a.position)).norm(), 1e-13 * s.r);
    EXPECT_LT(std::abs(u.dot(e)), 1e-15);
    EXPECT_NEAR(e.norm(), 1, 1e-15);
    EXPECT_EQ(s.theta, 0);
    EXPECT_EQ(s.plane_spin, spin);
    EXPECT_LT((s.v_r * u + s.v_theta * e + s.v_normal * n - v).norm(), 1e-13 * v.norm());
    const Vector3d flat_a = s.speed_a * (std::cos(s.alpha) * u + std::sin(s.alpha) * e),
                   flat_b = s.speed_b * (std::cos(s.beta) * u + std::sin(s.beta) * e);
    EXPECT_LT((flat_a + a.velocity.dot(n) * n - a.velocity).norm(), 1e-13 * a.velocity.norm());
    EXPECT_LT((flat_b + b.velocity.dot(n) * n - b.velocity).norm(), 1e-13 * b.velocity.norm());
    EXPECT_NEAR(view.lateral_a().dot(a.velocity), 0, 1e-13 * a.velocity.norm());
    EXPECT_NEAR(view.lateral_b().dot(b.velocity), 0, 1e-13 * b.velocity.norm());
    EXPECT_NEAR(view.lateral_a().dot(n), 0, 1e-15);
    // Heading + pi/2: from the velocity counter-clockwise about the normal.
    EXPECT_GE(a.velocity.cross(view.lateral_a()).dot(n), 0);
  }
}

TEST(PlaneView, EllipsoidsAreTheSectorsOfTheCones) {
  RandomBodies random(7202);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 1000; ++i) {
    const auto [moving_a, moving_b] = testing::moving_pair(random, 1.05, 4);
    const BodyState a = moving_a.state(), b = moving_b.state();
    const Vector3d across = random.direction();
    const auto exact = plane_view(a, b, across, SectorMethod::true_cone, RateMethod::none);
    const auto slice = plane_view(a, b, across, SectorMethod::slice, RateMethod::none);
    ASSERT_TRUE(exact && slice);
    const PlaneSector sector = true_sector(ellipsoid_of(a), ellipsoid_of(b), across);
    EXPECT_NEAR(exact->cone.psi, sector.psi(), 1e-13);
    EXPECT_NEAR(exact->cone.theta_b, sector.theta_b(), 1e-13);
    const Slice known = slice_sector(ellipsoid_of(a), ellipsoid_of(b), across);
    EXPECT_NEAR(slice->cone.psi, known.psi(), 1e-11);
    EXPECT_NEAR(slice->cone.theta_b, known.theta_b(), 1e-11);
    EXPECT_LE(slice->cone.psi, exact->cone.psi * (1 + 1e-12));
  }
}

/// Rates by Richardson's extrapolation of the cone along the motion that `at_a`, `at_b` and `axis` describe.
struct Differences {
  double psi, theta_b;
};
template <typename AtA, typename AtB, typename Axis>
Differences differences(const AtA& at_a, const AtB& at_b, const Axis& axis, SectorMethod method, double h) {
  // Against fixed axes: with the angle that the line of sight has turned in the plane.
  const auto cone = [&](double t) {
    return plane_view(at_a(t), at_b(t), axis(t), method, RateMethod::none)->cone;
  };
  return {richardson_derivative([&](double t) { return cone(t).psi; }, h),
          richardson_derivative([&](double t) { return cone(t).theta_b; }, h)};
}

void rates_of_ellipsoids(SectorMethod method, std::uint64_t seed) {
  RandomBodies random(seed);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 1000; ++i) {
    auto [moving_a, moving_b] = testing::moving_pair(random, 1.3, 4);
    const double spin = i % 2 ? random.uniform(-1, 1) : 0;
    const Vector3d across = random.direction();
    double lateral = 0;
    if (i % 3) {
      moving_a.now.turning = Turning::with_heading;
      lateral = random.uniform(-20, 20);
      moving_a.acceleration = lateral * plane_states(moving_a.at(0), moving_b.at(0), across).lateral_a();
    }
    const BodyState a = moving_a.state(), b = moving_b.state();
    const auto view = plane_view(a, b, across, method, RateMethod::analytic, spin);
    ASSERT_TRUE(view);
    const Vector3d c = b.position - a.position, v = b.velocity - a.velocity;
    // The plane follows the line of sight of unaccelerated motion; the acceleration shows in second order.
    const auto axis = [&](double t) { return testing::carried_axis(c, v, t, view->across, spin); };
    const double scale = v.norm() / c.norm() + a.omega.norm() + b.omega.norm() +
                         moving_a.acceleration.norm() / a.velocity.norm();
    const double h = 0.02 / scale;
    const Differences rates =
        differences([&moving_a = moving_a](double t) { return moving_a.at(t); },
                    [&moving_b = moving_b](double t) { return moving_b.at(t); }, axis, method, h);
    const PlaneCone& cone = view->cone;
    const double psi = cone.psi_rate + lateral * cone.psi_rate_by_a,
                 theta_b = cone.theta_b_rate + lateral * cone.theta_b_rate_by_a;
    EXPECT_NEAR(psi, rates.psi, 1e-6 * std::max(std::abs(psi), 0.1 * scale)) << i;
    EXPECT_NEAR(theta_b, rates.theta_b + view->state.v_theta / view->state.r,
                1e-6 * std::max(std::abs(theta_b), 0.1 * scale))
        << i;
  }
}

TEST(PlaneViewRates, EllipsoidsExact) { rates_of_ellipsoids(SectorMethod::true_cone, 7203); }
TEST(PlaneViewRates, EllipsoidsSliced) { rates_of_ellipsoids(SectorMethod::slice, 7204); }

TEST(PlaneView, EdgesAreWhereTheExactOracleSaysSo) {
  RandomBodies random(7205);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 500; ++i) {
    const auto [moving_a, moving_b] = testing::moving_pair(random, 1.05, 4);
    const BodyState a = moving_a.state(), b = moving_b.state();
    const ConeOracle oracle(ellipsoid_of(a), ellipsoid_of(b));
    const auto view = plane_view(a, b, random.direction(), SectorMethod::true_cone, RateMethod::none);
    ASSERT_TRUE(view);
    const PlaneCone& cone = view->cone;
    const auto at = [&](double angle) {
      return oracle.membership(std::cos(angle) * view->line_of_sight + std::sin(angle) * view->across);
    };
    for (const double side : {1., -1.}) {
      const double edge = cone.theta_b + 0.5 * side * cone.psi;
      EXPECT_EQ(at(edge - 1e-10 * side), Membership::in) << i;
      EXPECT_EQ(at(edge + 1e-10 * side), Membership::out) << i;
    }
  }
}

TEST(PlaneView, TheOtherAxisMirrorsIt) {
  RandomBodies random(7206);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 200; ++i) {
    auto [moving_a, moving_b] = testing::moving_pair(random, 1.2, 4);
    moving_a.now.turning = Turning::with_heading;
    const BodyState a = moving_a.state(), b = moving_b.state();
    const Vector3d across = random.direction();
    const double spin = random.uniform(-1, 1);
    for (const SectorMethod method : {SectorMethod::true_cone, SectorMethod::slice}) {
      const auto one = plane_view(a, b, across, method, RateMethod::analytic, spin);
      const auto two = plane_view(a, b, -across, method, RateMethod::analytic, spin);
      ASSERT_TRUE(one && two);
      EXPECT_NEAR(one->cone.psi, two->cone.psi, 1e-12);
      EXPECT_NEAR(one->cone.theta_b, -two->cone.theta_b, 1e-12);
      EXPECT_NEAR(one->cone.psi_rate, two->cone.psi_rate, 1e-9);
      EXPECT_NEAR(one->cone.theta_b_rate, -two->cone.theta_b_rate, 1e-9);
      // A's lateral acceleration is the other way round.
      EXPECT_NEAR(one->cone.psi_rate_by_a, -two->cone.psi_rate_by_a, 1e-9);
      EXPECT_NEAR(one->cone.theta_b_rate_by_a, two->cone.theta_b_rate_by_a, 1e-9);
    }
  }
}

TEST(PlaneViewRates, DifferencesAgreeWithTheClosedForm) {
  RandomBodies random(7207);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 500; ++i) {
    auto [moving_a, moving_b] = testing::moving_pair(random, 1.3, 4);
    if (i % 2) moving_a.now.turning = Turning::with_heading;
    const BodyState a = moving_a.state(), b = moving_b.state();
    const Vector3d across = random.direction();
    const double spin = random.uniform(-1, 1);
    for (const SectorMethod method : {SectorMethod::true_cone, SectorMethod::slice}) {
      const auto closed = plane_view(a, b, across, method, RateMethod::analytic, spin),
                 differenced = plane_view(a, b, across, method, RateMethod::differenced, spin);
      ASSERT_TRUE(closed && differenced);
      const PlaneCone &c = closed->cone, &d = differenced->cone;
      const double scale = 1e-6 * (1 + closed->state.speed_a + closed->state.speed_b);
      EXPECT_NEAR(c.psi_rate, d.psi_rate, scale) << i;
      EXPECT_NEAR(c.theta_b_rate, d.theta_b_rate, scale) << i;
      EXPECT_NEAR(c.psi_rate_by_a, d.psi_rate_by_a, 1e-6) << i;
      EXPECT_NEAR(c.theta_b_rate_by_a, d.theta_b_rate_by_a, 1e-6) << i;
    }
  }
}

TEST(PlaneView, EllipsoidsNeitherAllocateNorThrow) {
  RandomBodies random(7208);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 300; ++i) {
    // Also overlapping ones, and one inside the other.
    auto [moving_a, moving_b] = testing::moving_pair(random, 0, 3);
    moving_a.now.turning = Turning::with_heading;
    const BodyState a = moving_a.state(), b = moving_b.state();
    const bool apart = relation<3>(ellipsoid_of(a), ellipsoid_of(b)) == Relation::disjoint;
    const Vector3d across = random.direction();
    for (const SectorMethod method : {SectorMethod::true_cone, SectorMethod::slice})
      for (const RateMethod rates : {RateMethod::analytic, RateMethod::differenced, RateMethod::none}) {
        PlaneView view = plane_states(a, b, across);
        view.cone.psi = -1;
        bool found = false;
        const std::size_t before = testing::allocations();
        EXPECT_NO_THROW(found = fill_cone(view, a, b, method, rates));
        EXPECT_EQ(testing::allocations(), before);
        if (method == SectorMethod::true_cone) {
          EXPECT_EQ(found, apart) << i;
        } else {
          EXPECT_GE(found, apart) << i;
        }
        EXPECT_EQ(found, view.cone.psi >= 0);
      }
  }
}

TEST(PlaneView, TouchingBodiesAreNotApart) {
  BodyState a, b;
  a.shape = CombinedEllipsoid(Ellipsoid::from_axes({0, 0, 0}, {1, 2, 3}));
  b.shape = CombinedEllipsoid(Ellipsoid::from_axes({3, 0, 0}, {2, 1, 1}));
  b.position = {3, 0, 0};
  a.velocity = {1, 0, 0};
  for (const SectorMethod method : {SectorMethod::true_cone, SectorMethod::slice})
    EXPECT_FALSE(plane_view(a, b, {0, 1, 0}, method, RateMethod::analytic));
  EXPECT_FALSE(plane_view(a, a, {0, 1, 0}, SectorMethod::true_cone, RateMethod::analytic));
}

TEST(BodyState, AdvancedIsTheMotionToFirstOrder) {
  RandomBodies random(7209);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 200; ++i) {
    testing::MovingBody m = testing::moving_body(random, random.in_box(5));
    if (i % 2) testing::dent(random, m);
    m.now.turning = Turning::with_heading;
    m.acceleration = 3 * m.now.velocity.cross(random.direction()).normalized();
    const double dt = 1e-4;
    const auto change = [&](const BodyState& state) {
      const auto& shape = *state.shape.quadric();
      Eigen::Matrix3d sum = shape.ellipsoid().shape();
      for (const Delimiter<3>& d : shape.delimiters())
        sum += d.matrix + d.level * Eigen::Matrix3d::Identity();
      return sum;
    };
    const BodyState ahead = advanced(m.state(), dt, m.acceleration),
                    behind = advanced(m.state(), -dt, m.acceleration);
    EXPECT_LT((ahead.position - m.at(dt).position).norm(), 1e-14 * 10);
    EXPECT_LT((ahead.velocity - m.at(dt).velocity).norm(), 1e-14 * 10);
    EXPECT_EQ(ellipsoid_of(ahead).center(), ahead.position);
    const Eigen::Matrix3d rate = (change(ahead) - change(behind)) / (2 * dt),
                          truth = (change(m.at(dt)) - change(m.at(-dt))) / (2 * dt);
    EXPECT_LT((rate - truth).norm(), 1e-6 * (1 + truth.norm())) << i;
  }
}

}  // namespace
}  // namespace vericone::guidance::plane_view_test
