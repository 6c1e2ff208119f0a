// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/cones/ellipsoids/true_cone.h>
#include <vericone/cones/slices/slice_cone.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/ellipsoids/plane_sector.h>
#include <vericone/internal/cones/slices/slice_sector.h>
#include <vericone/testing/random_bodies.h>

#include <numbers>

namespace vericone::plane_sector_test {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;
using std::numbers::pi;
using testing::RandomBodies;

Ellipsoid sphere(const Vector3d& center, double radius) {
  return Ellipsoid::from_axes(center, Vector3d::Constant(radius));
}

Vector3d direction(const PlaneSector& s, double angle) {
  return std::cos(angle) * s.line_of_sight + std::sin(angle) * s.across;
}

RandomBodies::Pair draw(RandomBodies& random, int kind) {
  switch (kind % 4) {
    case 0:
      return random.scaled_from_touching(1, 10, random.uniform(1.05, 3));
    case 1:
      return random.scaled_from_touching(1, 10, 1 + random.log_uniform(1e-4, 1e-1));
    case 2:
      return random.scaled_from_touching(1e-2, 1, random.uniform(1.05, 2));
    default:
      return random.scaled_from_touching(1, 10, random.log_uniform(10, 1e8));
  }
}

TEST(PlaneSector, EdgesAreTheBoundaryOfTheCone) {
  RandomBodies random(621);
  SCOPED_TRACE(random.trace());
  int not_separated_by_centers = 0;
  for (int i = 0; i < 4000; ++i) {
    const auto [a, b] = draw(random, i);
    const Vector3d across = random.direction();
    const PlaneSector s = true_sector(a, b, across);
    const Vector3d c = b.center() - a.center();
    SCOPED_TRACE("case " + std::to_string(i));
    ASSERT_LT((s.line_of_sight - c.normalized()).norm(), 1e-15);
    ASSERT_NEAR(s.across.dot(s.line_of_sight), 0, 1e-15);
    ASSERT_NEAR(s.across.norm(), 1, 1e-15);
    ASSERT_GT(s.across.dot(across), 0);
    not_separated_by_centers += !separates<3>(a, b, c);
    const ConeOracle oracle(a, b);
    for (const double side : {1.0, -1.0}) {
      const PlaneSector::Edge& edge = side > 0 ? s.left : s.right;
      ASSERT_GT(edge.angle, 0);
      ASSERT_LT(edge.angle, pi);
      const double step = 1e-9 * edge.angle + 1e-15;  // directions are rounded
      ASSERT_EQ(oracle.membership(direction(s, side * (edge.angle - step))), Membership::in);
      ASSERT_EQ(oracle.membership(direction(s, side * (edge.angle + step))), Membership::out);
      // The contact lies on the edge, the normal is that of a plane through it that touches both bodies.
      const Vector3d d = direction(s, side * edge.angle);
      const double size = c.norm();
      ASSERT_NEAR(edge.contact.cross(d).norm(), 0, 1e-9 * size);
      ASSERT_GT(edge.contact.dot(d), 0);
      ASSERT_NEAR(edge.normal.norm(), 1, 1e-14);
      ASSERT_NEAR(edge.normal.dot(d), 0, 1e-9);
      ASSERT_NEAR(edge.normal.dot(c) - a.radius(edge.normal) - b.radius(edge.normal), 0, 1e-12 * size);
    }
    ASSERT_LE(s.psi(), pi);
  }
  EXPECT_GT(not_separated_by_centers, 20);
}

TEST(PlaneSector, ContainsTheSliceAndEqualsItForSpheres) {
  RandomBodies random(622);
  SCOPED_TRACE(random.trace());
  int strict = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vector3d across = random.direction();
    const auto [a, b] = random.scaled_from_touching(1, 10, random.uniform(1.05, 4));
    const PlaneSector exact = true_sector(a, b, across);
    const Slice slice = slice_sector(a, b, across);
    ASSERT_GE(exact.left.angle, slice.left * (1 - 1e-12)) << "case " << i;
    ASSERT_GE(exact.right.angle, slice.right * (1 - 1e-12)) << "case " << i;
    strict += exact.psi() > slice.psi() * 1.001;
    const double r1 = random.log_uniform(0.1, 10), r2 = random.log_uniform(0.1, 10);
    const Ellipsoid p = sphere(random.in_box(5), r1);
    const Ellipsoid q =
        sphere(p.center() + (r1 + r2) * (1 + random.log_uniform(1e-3, 1e6)) * random.direction(), r2);
    const double half = std::asin((r1 + r2) / (q.center() - p.center()).norm());
    const PlaneSector round = true_sector(p, q, across);
    ASSERT_NEAR(round.left.angle / half, 1, 1e-13) << "case " << i;
    ASSERT_NEAR(round.right.angle / half, 1, 1e-13) << "case " << i;
    ASSERT_NEAR(slice_sector(p, q, across).left / half, 1, 1e-12) << "case " << i;
  }
  EXPECT_GT(strict, 1000);
}

// Both bodies symmetric in the plane z = 0, turned together: there a contact outside the plane comes with its
// mirror image, and by convexity with one in the plane.
TEST(PlaneSector, EqualsTheSliceOnACommonPlaneOfSymmetry) {
  RandomBodies random(623);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 1000; ++i) {
    const Matrix3d r = random.rotation();
    const auto body = [&](const Vector3d& center) {
      const Vector3d axes(random.uniform(1, 5), random.uniform(1, 5), random.uniform(0.1, 20));
      return Ellipsoid::from_axes(r * center, axes, r * rotation_from_heading(random.uniform(-pi, pi), 0));
    };
    const double angle = random.uniform(-pi, pi);
    const Ellipsoid a = body({0, 0, 0}),
                    b = body(random.uniform(10.5, 30) * Vector3d(std::cos(angle), std::sin(angle), 0));
    const Vector3d across = r * Vector3d(-std::sin(angle), std::cos(angle), 0);
    const PlaneSector exact = true_sector(a, b, across);
    const Slice slice = slice_sector(a, b, across);
    ASSERT_NEAR(exact.left.angle, slice.left, 1e-12) << "case " << i;
    ASSERT_NEAR(exact.right.angle, slice.right, 1e-12) << "case " << i;
    ASSERT_NEAR(exact.left.normal.dot(r.col(2)), 0, 1e-6) << "case " << i;
  }
}

TEST(PlaneSector, Invariances) {
  RandomBodies random(624);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 1000; ++i) {
    const auto [a, b] = random.scaled_from_touching(1, 5, random.uniform(1.1, 3));
    const Vector3d across = random.direction();
    const PlaneSector s = true_sector(a, b, across);
    for (const double scale : {1e-100, 1e-6, 1e6, 1e100}) {
      const PlaneSector t = true_sector(a.scaled(scale), b.scaled(scale), across);
      ASSERT_NEAR(t.left.angle, s.left.angle, 1e-12) << "case " << i << " scale " << scale;
      ASSERT_NEAR(t.right.angle, s.right.angle, 1e-12) << "case " << i << " scale " << scale;
    }
    // The other way round it is seen with the line of sight reversed and the same plane.
    const PlaneSector swapped = true_sector(b, a, -across);
    ASSERT_NEAR(swapped.left.angle, s.left.angle, 1e-12) << "case " << i;
    const PlaneSector mirrored = true_sector(a, b, -across);
    ASSERT_NEAR(mirrored.left.angle, s.right.angle, 1e-12) << "case " << i;
    for (const double lean : {3.0, 1e6}) {
      const PlaneSector oblique = true_sector(a, b, s.across + lean * s.line_of_sight);
      ASSERT_NEAR(oblique.left.angle, s.left.angle, 1e-13 * (10 + lean)) << "case " << i;
      ASSERT_NEAR(oblique.across.dot(oblique.line_of_sight), 0, 1e-15) << "case " << i;
      const Slice slice = slice_sector(a, b, s.across + lean * s.line_of_sight);
      ASSERT_NEAR(slice.left, slice_sector(a, b, s.across).left, 1e-13 * (10 + lean)) << "case " << i;
    }
    const Vector3d by = random.in_box(100);
    const PlaneSector moved = true_sector(a.translated(by), b.translated(by), across);
    ASSERT_NEAR(moved.psi(), s.psi(), 1e-11) << "case " << i;
    ASSERT_NEAR(moved.theta_b(), s.theta_b(), 1e-11) << "case " << i;
  }
}

TEST(PlaneSector, AgreesWithTheTracedCone) {
  RandomBodies random(625);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 300; ++i) {
    const auto [a, b] = draw(random, i);
    const TrueCone cone = true_cone(a, b, 12);
    for (const BoundarySample& p : cone.boundary) {
      const PlaneSector s = true_sector(a, b, p.direction);
      const double angle = std::atan2(p.direction.cross(cone.axis).norm(), p.direction.dot(cone.axis));
      // The azimuth of a distant body's sample is as good as its direction, a rounded unit vector.
      ASSERT_NEAR(s.left.angle / angle, 1, 1e-10 + 1e-15 / angle / angle) << "case " << i;
    }
  }
}

TEST(PlaneSector, RefusesWhatHasNoSector) {
  const auto field = [](const Ellipsoid& a, const Ellipsoid& b, const Vector3d& across) -> std::string {
    try {
      true_sector(a, b, across);
    } catch (const InputError& error) {
      return error.field();
    }
    return "";
  };
  const Ellipsoid a = sphere({0, 0, 0}, 2);
  EXPECT_EQ(field(a, sphere({3, 4, 0}, 3), {0, 0, 1}), "bodies");
  EXPECT_EQ(field(a, sphere({0, 0, 0}, 3), {0, 0, 1}), "bodies");
  EXPECT_EQ(field(a, sphere({30, 40, 0}, 3), {3, 4, 0}), "across");
  EXPECT_EQ(field(a, sphere({30, 40, 0}, 3), {0, 0, 0}), "across");
  EXPECT_EQ(field(a, sphere({30, 40, 0}, 3), {0, std::nan(""), 1}), "across");
  EXPECT_EQ(field(a, sphere({30, 40, 0}, 3), {0, 0, 1}), "");
  EXPECT_THROW(slice_sector(a, sphere({30, 40, 0}, 3), {3, 4, 0}), InputError);
  EXPECT_THROW(slice_sector(a, sphere({30, 40, 0}, 3), {0, 0, 0}), InputError);
}

}  // namespace
}  // namespace vericone::plane_sector_test
