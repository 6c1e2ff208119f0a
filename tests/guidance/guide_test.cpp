// SPDX-License-Identifier: BSD-3-Clause
//
// One step of guidance as a whole: what it commands makes y follow its order along real motion.
#include <gtest/gtest.h>
#include <vericone/cones/ellipsoids/predicates.h>
#include <vericone/cones/planar/sector.h>
#include <vericone/guidance/guide.h>
#include <vericone/internal/cones/ellipsoids/plane_sector.h>
#include <vericone/internal/cones/planar/cone_function.h>
#include <vericone/internal/guidance/collision_course.h>
#include <vericone/testing/random_bodies.h>
#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "support/allocations.h"

namespace vericone::guidance::guide_test {
namespace {

using Eigen::Vector3d;
using vericone::testing::RandomBodies;

BodyState body(const Ellipsoid& shape, const Vector3d& velocity, Turning turning = Turning::none) {
  BodyState state;
  state.shape = CombinedEllipsoid(shape);
  state.position = shape.center();
  state.velocity = velocity;
  state.turning = turning;
  return state;
}

BodyState ball(const Vector3d& center, const Vector3d& velocity, double radius) {
  return body(Ellipsoid::from_axes(center, Vector3d::Constant(radius)), velocity);
}

/// Spheres: psi = 2 asin((R_A + R_B) / r), theta_b = 0, y = sin^2 of the angle off the line of sight -
/// sin^2(psi/2).
TEST(Guide, SpheresInClosedForm) {
  RandomBodies random(71);
  SCOPED_TRACE(random.trace());
  for (const SectorMethod method : {SectorMethod::true_cone, SectorMethod::slice}) {
    for (int i = 0; i < 100; ++i) {
      const Vector3d c = random.uniform(8, 30) * random.direction();
      const Vector3d v = 5 * (c.normalized() + 0.1 * random.in_box(1)).normalized();
      GuideOptions options;
      options.sector = method;
      options.plane.choice = PlaneChoice::of_motion;
      GuideMemory memory;
      const auto step = guide(ball({0, 0, 0}, v, 1.5), ball(c, {0, 0, 0}, 2), options, memory, 0);
      ASSERT_TRUE(step);
      const double sine = 3.5 / c.norm(), off = c.cross(v).norm() / (c.norm() * v.norm());
      if (off >= sine) {
        EXPECT_EQ(step->status, LawStatus::clear);
        EXPECT_TRUE(step->a.isZero(0));
        continue;
      }
      EXPECT_NEAR(step->psi, 2 * std::asin(sine), 1e-9);
      EXPECT_NEAR(step->theta_b, 0, 1e-9);
      EXPECT_NEAR(step->y, off * off - sine * sine, 1e-9);
    }
  }
}

/// An ellipsoid on a parabola that turns with its heading, without roll.
Ellipsoid flown(const Ellipsoid& shape, const Vector3d& velocity, const Vector3d& acceleration, double t) {
  const Vector3d omega = velocity.cross(acceleration) / velocity.squaredNorm();
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(omega.norm() * t, omega.norm() > 0 ? Vector3d(omega.normalized()) : Vector3d::UnitX())
          .toRotationMatrix();
  const Eigen::Matrix3d factor = turn * shape.factor(), s = factor * factor.transpose();
  return Ellipsoid::from_shape(shape.center() + velocity * t + 0.5 * t * t * acceleration,
                               (s + s.transpose()) / 2);
}

class Inversion : public ::testing::TestWithParam<Law> {};

/// Both turn with their headings, the commands act: dy/dt = -K (y - w), by differences of the exact sector
/// along motion propagated here. The plane is carried along with the line of sight, as the law assumes.
TEST_P(Inversion, MakesYFollowItsOrder) {
  RandomBodies random(72);
  SCOPED_TRACE(random.trace());
  GuideOptions options;
  options.law = GetParam();
  options.mu = -0.5;
  options.plane.choice = PlaneChoice::of_motion;
  options.inversion.gain = 1.3;
  options.inversion.reference = 0.02;
  int tested = 0;
  while (tested < 300) {
    const auto [shape_a, shape_b] = random.separated_along_centers(1, 5, random.uniform(1.5, 3));
    const Vector3d c = shape_b.center() - shape_a.center();
    const Vector3d vb = 3 * random.direction();
    const Vector3d va = vb + random.uniform(5, 15) * (c.normalized() + 0.2 * random.in_box(1)).normalized();
    GuideMemory memory;
    const auto step = guide(body(shape_a, va, Turning::with_heading),
                            body(shape_b, vb, Turning::with_heading), options, memory, 0);
    ASSERT_TRUE(step);
    if (step->status != LawStatus::steering || step->demanded > 300) continue;
    const Vector3d u0 = c.normalized(), e0 = step->across;
    const auto y = [&, &shape_a = shape_a, &shape_b = shape_b](double t) {
      const Ellipsoid a = flown(shape_a, va, step->a, t), b = flown(shape_b, vb, step->b, t);
      const Vector3d u = (b.center() - a.center()).normalized();
      const Vector3d e =
          Eigen::Quaterniond::FromTwoVectors(u0, u) * e0;  // parallel transport, to second order
      const PlaneSector sector = true_sector(a, b, e);
      const Vector3d v = vb + step->b * t - va - step->a * t;
      return cone_function_y(v.dot(u), v.dot(e), 0, sector.theta_b(), sector.psi());
    };
    ASSERT_NEAR(y(0), step->y, 1e-10);
    const double h = 1e-4 / (1 + step->a.norm() / va.norm() + step->b.norm() / vb.norm());
    const double found = (8 * (y(h) - y(-h)) - (y(2 * h) - y(-2 * h))) / (12 * h);
    const double wanted = -options.inversion.gain * (step->y - options.inversion.reference);
    EXPECT_NEAR(found, wanted, 1e-5 * (1 + std::abs(wanted)));
    ++tested;
  }
}
INSTANTIATE_TEST_SUITE_P(Laws, Inversion, ::testing::Values(Law::avoidance, Law::cooperative_avoidance),
                         [](const auto& param) {
                           return param.param == Law::avoidance ? "Avoidance" : "Cooperation";
                         });

/// Backward differences are the same law in the limit of small steps.
TEST(Guide, BackwardDifferencesApproachTheRates) {
  const Ellipsoid a = Ellipsoid::from_axes({0, 0, 0}, {3, 1, 1}),
                  b = Ellipsoid::from_axes({20, 2, 1}, {2, 3, 1});
  const Vector3d va(8, 0, 0.5), vb(-1, 0.5, 0);
  GuideOptions analytic, backward;
  analytic.plane.choice = backward.plane.choice = PlaneChoice::of_motion;
  backward.rates = GuideRates::backward;
  GuideMemory none;
  const auto wanted = guide(body(a, va), body(b, vb), analytic, none, 1);
  ASSERT_TRUE(wanted);
  std::vector<double> errors;
  for (const double h : {1e-2, 1e-3, 1e-4}) {
    GuideMemory memory;
    ASSERT_TRUE(
        guide(body(a.translated(-h * va), va), body(b.translated(-h * vb), vb), backward, memory, 1 - h));
    const auto found = guide(body(a, va), body(b, vb), backward, memory, 1);
    ASSERT_TRUE(found);
    errors.push_back((found->a - wanted->a).norm() / wanted->a.norm());
  }
  EXPECT_LT(errors[1], 0.2 * errors[0]);
  EXPECT_LT(errors[2], 0.2 * errors[1]);
  EXPECT_LT(errors[2], 1e-3);
}

/// Ellipsoids of ordinary shape, on and off a collision course: nothing is allocated, whatever the law.
TEST(Guide, DoesNotAllocate) {
  RandomBodies random(74);
  SCOPED_TRACE(random.trace());
  for (const Law law : {Law::avoidance, Law::cooperative_avoidance, Law::clearance}) {
    for (const PlaneChoice choice : {PlaneChoice::of_motion, PlaneChoice::largest_opening}) {
      GuideOptions options;
      options.law = law;
      options.plane.choice = choice;
      GuideMemory memory;
      for (int i = 0; i < 100; ++i) {
        const auto [shape_a, shape_b] = random.separated_along_centers(1, 5, random.uniform(1.5, 3));
        const Vector3d c = shape_b.center() - shape_a.center();
        const BodyState a = body(shape_a, 9 * (c.normalized() + 0.5 * random.in_box(1)),
                                 Turning::with_heading),
                        b = body(shape_b, random.in_box(1), Turning::with_heading);
        const std::size_t before = testing::allocations();
        const auto step = guide(a, b, options, memory, i);
        EXPECT_EQ(testing::allocations(), before) << to_string(law);
        EXPECT_TRUE(step);
      }
    }
  }
}

TEST(Guide, SaysNothingWithoutACone) {
  GuideOptions options;
  GuideMemory memory;
  EXPECT_FALSE(guide(ball({0, 0, 0}, {1, 0, 0}, 2), ball({3, 0, 0}, {0, 0, 0}, 2), options, memory, 0));
}

/// The decision is the exact predicate's, or that of the sections on the plane of the relative velocity.
TEST(Guide, DecidesByTheCone) {
  RandomBodies random(73);
  SCOPED_TRACE(random.trace());
  int missed = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto [shape_a, shape_b] = random.separated_along_centers(1, 10, random.uniform(1.5, 3));
    const Vector3d c = shape_b.center() - shape_a.center();
    const Vector3d v = 5 * (c.normalized() + 0.5 * random.in_box(1)).normalized();
    const BodyState a = body(shape_a, v), b = body(shape_b, Vector3d::Zero());
    const auto exact = on_collision_course(a, b, SectorMethod::true_cone);
    const auto slice = on_collision_course(a, b, SectorMethod::slice);
    ASSERT_TRUE(exact && slice);
    EXPECT_EQ(*exact, ConeOracle(shape_a, shape_b).membership(v) != Membership::out);
    EXPECT_TRUE(*exact || !*slice);  // slices are contained in the cone
    missed += *exact && !*slice;
    const auto margin = on_collision_course(a, b, SectorMethod::true_cone, 0.01);
    EXPECT_TRUE(*margin || !*exact);
  }
  EXPECT_GT(missed, 20);  // and in general strictly
}

/// Cooperation: mu relates the two accelerations, each perpendicular to its own velocity.
TEST(Guide, CooperationKeepsItsRatio) {
  const BodyState a = body(Ellipsoid::from_axes({0, 0, 0}, {3, 1, 1}), {8, 0, 0.5}),
                  b = body(Ellipsoid::from_axes({20, 2, 1}, {2, 3, 1}), {-2, 0.5, 0});
  GuideOptions options;
  options.law = Law::cooperative_avoidance;
  options.mu = -0.5;
  options.inversion.reference = 0.1;
  GuideMemory memory;
  const auto step = guide(a, b, options, memory, 0);
  ASSERT_TRUE(step);
  EXPECT_GT(step->a.norm(), 0);
  EXPECT_NEAR(step->b.norm(), 0.5 * step->a.norm(), 1e-12 * step->a.norm());
  EXPECT_NEAR(step->a.dot(a.velocity), 0, 1e-9);
  EXPECT_NEAR(step->b.dot(b.velocity), 0, 1e-9);
}

}  // namespace
}  // namespace vericone::guidance::guide_test
