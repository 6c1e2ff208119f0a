// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/cones/ellipsoids/true_cone.h>
#include <vericone/geometry/error.h>
#include <vericone/testing/random_bodies.h>
#include <Eigen/LU>

#include <iostream>
#include <numbers>

#include "cones/ellipsoids/cone_by_bisection.h"

namespace vericone::true_cone_test {
namespace {

using Eigen::Matrix3d, Eigen::Vector2d, Eigen::Vector3d, Eigen::Vector4d;
using std::numbers::pi;
using testing::RandomBodies, testing::solid_angle_by_bisection;

Ellipsoid sphere(const Vector3d& center, double radius) {
  return Ellipsoid::from_axes(center, Vector3d::Constant(radius));
}

double gap(const Ellipsoid& a, const Ellipsoid& b, const Vector3d& n) {
  return n.dot(b.center() - a.center()) - a.radius(n) - b.radius(n);
}

TEST(TrueCone, OfSpheresIsCircular) {
  RandomBodies random(571);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 500; ++i) {
    const double r1 = random.log_uniform(0.01, 10), r2 = random.log_uniform(0.01, 10);
    const Vector3d home = random.in_box(5);
    const Ellipsoid a = sphere(home, r1),
                    b = sphere(home + (r1 + r2) * (1 + random.log_uniform(1e-2, 1e9)) * random.direction(),
                               r2);
    const Vector3d c = b.center() - a.center();
    const double s = (r1 + r2) / c.norm(), one_minus_cos = s * s / (1 + std::sqrt((1 - s) * (1 + s)));
    const TrueCone cone = true_cone(a, b, random.integer(12, 64));
    ASSERT_EQ(cone.relation, Relation::disjoint);
    ASSERT_NEAR(cone.solid_angle / (2 * pi * one_minus_cos), 1, 1e-13) << "case " << i;
    ASSERT_NEAR(cone.cross_section_area / (pi * s * s / ((1 - s) * (1 + s))), 1, 1e-13) << "case " << i;
    for (const BoundarySample& p : cone.boundary)
      ASSERT_NEAR(p.direction.cross(c.normalized()).norm() / s, 1, 1e-13 + 1e-15 / s) << "case " << i;
  }
}

TEST(TrueCone, TouchingAndOverlapping) {
  const TrueCone touching = true_cone(sphere({0, 0, 0}, 2), sphere({3, 4, 0}, 3), 32);
  EXPECT_EQ(touching.relation, Relation::touching);
  EXPECT_EQ(touching.solid_angle, 2 * pi);
  EXPECT_TRUE(std::isinf(touching.cross_section_area));
  EXPECT_TRUE(touching.boundary.empty());
  const TrueCone over = true_cone(sphere({0, 0, 0}, 2), sphere({0, 0, 0}, 3), 32);
  EXPECT_EQ(over.relation, Relation::overlapping);
  EXPECT_EQ(over.solid_angle, 4 * pi);
  EXPECT_TRUE(over.boundary.empty());
  // Almost touching: almost a half-space.
  EXPECT_NEAR(true_cone(sphere({0, 0, 0}, 2), sphere({3, 4, 0}, 3 - 1e-9), 64).solid_angle, 2 * pi, 2e-4);
}

TEST(TrueCone, RefusesTooFewSamples) {
  for (const int samples : {2, 0, -5, 1'000'001}) {
    try {
      true_cone(sphere({0, 0, 0}, 1), sphere({5, 0, 0}, 1), samples);
      FAIL() << samples;
    } catch (const InputError& error) {
      EXPECT_EQ(error.field(), "samples");
      EXPECT_EQ(error.value(), std::to_string(samples));
    }
  }
}

RandomBodies::Pair draw(RandomBodies& random, int kind) {
  switch (kind % 5) {
    case 0:
      return random.scaled_from_touching(1, 10, random.uniform(1.05, 3));
    case 1:
      return random.scaled_from_touching(1, 10, 1 + random.log_uniform(1e-6, 1e-2));
    case 2:
      return random.scaled_from_touching(1e-3, 1, random.uniform(1.05, 2));
    case 3:
      return random.scaled_from_touching(1e-6, 1, random.uniform(1.05, 2));
    default:
      return random.scaled_from_touching(1, 10, random.log_uniform(10, 1e9));
  }
}

TEST(TrueCone, SamplesAreOnTheBoundaryInOrder) {
  RandomBodies random(572);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 2000; ++i) {
    constexpr int kCounts[] = {3, 4, 5, 7, 8, 11, 12, 13, 64};
    const int count = kCounts[random.integer(0, 8)];
    const auto [a, b] = draw(random, i);
    const TrueCone cone = true_cone(a, b, count);
    SCOPED_TRACE("case " + std::to_string(i) + ", " + std::to_string(count) + " samples");
    ASSERT_EQ(static_cast<int>(cone.boundary.size()), count);
    const ConeOracle oracle(a, b);
    const Vector3d c = b.center() - a.center();
    const double rounding = i % 5 == 3 ? 1e-11 : 1e-13;  // thin bodies map with a condition of up to 1e6
    double azimuths = 0;
    for (int j = 0; j < count; ++j) {
      const BoundarySample &s = cone.boundary[j], &next = cone.boundary[(j + 1) % count];
      ASSERT_NEAR(s.direction.norm(), 1, 1e-14);
      ASSERT_NEAR(s.normal.norm(), 1, 1e-14);
      // The rounding of g(n) is that of its terms.
      const Vector3d m = s.normal.cwiseAbs();
      const double size = m.dot(c.cwiseAbs()) + (a.factor().cwiseAbs().transpose() * m).norm() +
                          (b.factor().cwiseAbs().transpose() * m).norm();
      ASSERT_NEAR(gap(a, b, s.normal), 0, rounding * size);
      ASSERT_NEAR(s.normal.dot(s.direction), 0, rounding * (1 + size / s.contact.norm()));
      const Vector3d contact =
          c + b.support_point(-s.normal) - b.center() - (a.support_point(s.normal) - a.center());
      ASSERT_NEAR((s.contact - contact).norm(), 0, 1e-7 * contact.norm() + (i % 5 == 3 ? 1e-9 : 0));
      ASSERT_NEAR(s.contact.cross(s.direction).norm(), 0, 1e-13 * s.contact.norm());
      ASSERT_GT(s.contact.dot(s.direction), 0);
      // Counter-clockwise about the axis, once around.
      const Vector3d p = s.direction - s.direction.dot(cone.axis) * cone.axis,
                     q = next.direction - next.direction.dot(cone.axis) * cone.axis;
      const double turn = std::atan2(cone.axis.dot(p.cross(q)), p.dot(q));
      azimuths += turn;
      if (count >= 64) {
        ASSERT_GT(turn, 0);
      }
      if (i % 5 != 4) {
        ASSERT_EQ(oracle.membership(s.direction + 1e-7 * s.normal), Membership::in);
        ASSERT_EQ(oracle.membership(s.direction - 1e-7 * s.normal), Membership::out);
      }
      // Distant bodies have narrow cones: relative to the opening.
      const double opening = s.direction.cross(cone.axis).norm();
      ASSERT_EQ(oracle.membership(s.direction - 1e-6 * opening * s.normal), Membership::out);
    }
    if (count >= 12) {
      ASSERT_NEAR(azimuths, 2 * pi, 1e-9);
    }
  }
}

TEST(TrueCone, InvariantUnderRotationAndScale) {
  RandomBodies random(573);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 1000; ++i) {
    const auto [a, b] = random.scaled_from_touching(1, 4, random.uniform(1.2, 3));
    const TrueCone cone = true_cone(a, b, 96);
    const double scale = i % 4 == 0 ? 1e-100 : i % 4 == 1 ? 1e100 : random.log_uniform(1e-6, 1e6);
    const Matrix3d r = random.rotation();
    const auto image = [&](const Ellipsoid& e) {
      return Ellipsoid::from_axes(scale * (r * e.center()), scale * e.semi_axes(),
                                  r * e.axis_directions() * (e.axis_directions().determinant() > 0 ? 1 : -1));
    };
    const TrueCone turned = true_cone(image(a), image(b), 96);
    ASSERT_NEAR(turned.solid_angle / cone.solid_angle, 1, 1e-10) << "case " << i;
    if (std::isfinite(cone.cross_section_area) && cone.cross_section_area < 100) {
      ASSERT_NEAR(turned.cross_section_area / cone.cross_section_area, 1, 1e-8) << "case " << i;
    }
    const TrueCone swapped = true_cone(b, a, 96);
    ASSERT_NEAR(swapped.solid_angle / cone.solid_angle, 1, 1e-10) << "case " << i;
  }
}

/// Long thin crossed bodies side by side: no plane across the line of centres separates them.
TEST(TrueCone, LineOfCentersThatDoesNotSeparate) {
  RandomBodies random(574);
  SCOPED_TRACE(random.trace());
  int found = 0, unbounded = 0;
  for (int i = 0; found < 40 && i < 10000; ++i) {
    const auto [a, b] = random.scaled_from_touching(0.4, 4, random.uniform(1.02, 1.5));
    if (separates<3>(a, b, b.center() - a.center())) continue;
    ++found;
    const TrueCone cone = true_cone(a, b, 256);
    ASSERT_EQ(cone.relation, Relation::disjoint);
    const double expected = solid_angle_by_bisection(ConeOracle(a, b), 512);
    ASSERT_NEAR(cone.solid_angle / expected, 1, 1e-5) << "case " << i;
    ASSERT_LT(cone.solid_angle, 2 * pi);
    unbounded += std::isinf(cone.cross_section_area);
  }
  EXPECT_EQ(found, 40);
  EXPECT_EQ(unbounded, 40) << "a normal along the axis would bound the section and separate";
}

TEST(TrueCone, SolidAngleAgreesWithMembershipAlone) {
  RandomBodies random(575);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 60; ++i) {
    const auto [a, b] = random.separated_along_centers(1, 5, random.uniform(1.2, 3));
    const TrueCone cone = true_cone(a, b, 128);
    ASSERT_NEAR(cone.solid_angle / solid_angle_by_bisection(ConeOracle(a, b), 256), 1, 1e-9) << "case " << i;
  }
}

/// Similar parallel ellipsoids: K is the ellipsoid with M = ((1 + k)^2 S)^{-1} about c, and w is in the cone
/// iff (c.Mw)^2 >= (w.Mw)(c.Mc - 1). With w = axis + y this is an ellipse in the plane of y.
double section_area_of_similar(const Matrix3d& m, const Vector3d& c) {
  const AxisFrame frame(c);
  const Vector3d mc = m * c;
  const Matrix3d q = (c.dot(mc) - 1) * m - mc * mc.transpose();  // w.q w <= 0
  Matrix3d basis;
  basis << frame.e1, frame.e2, frame.axis;
  const Matrix3d p = basis.transpose() * q * basis;
  const Eigen::Matrix2d h = p.topLeftCorner<2, 2>();
  const Vector2d g = p.topRightCorner<2, 1>();
  const double level = g.dot(h.inverse() * g) - p(2, 2);
  return pi * level / std::sqrt(h.determinant());
}

TEST(TrueCone, OfSimilarEllipsoidsIsElliptic) {
  RandomBodies random(576);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 500; ++i) {
    const double k = random.log_uniform(0.1, 10);
    const Ellipsoid a = random.ellipsoid({0, 0, 0}, 1, 5);
    const Vector3d d = random.direction();
    const Ellipsoid b = a.scaled(k).translated(a.radius(d) * (1 + k) * random.uniform(1.2, 3) * d);
    const Matrix3d m = ((1 + k) * (1 + k) * a.shape()).inverse();
    const double expected = section_area_of_similar(m, b.center());
    ASSERT_NEAR(true_cone(a, b, 96).cross_section_area / expected, 1, 1e-9) << "case " << i;
  }
}

/// Far away the cone is narrow and its section is the shadow of K: area = 1/2 integral of h^2 - h'^2.
TEST(TrueCone, OfDistantBodiesIsTheShadow) {
  RandomBodies random(577);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 200; ++i) {
    const double distance = 1e9;
    const Ellipsoid a = random.ellipsoid({0, 0, 0}, 1, 5),
                    b = random.ellipsoid(distance * random.direction(), 1, 5);
    const AxisFrame frame(b.center());
    double area = 0;
    constexpr int kCount = 512;
    for (int j = 0; j < kCount; ++j) {
      const double t = 2 * pi * j / kCount;
      const Vector3d n = std::cos(t) * frame.e1 + std::sin(t) * frame.e2,
                     n_t = -std::sin(t) * frame.e1 + std::cos(t) * frame.e2;
      const double h = a.radius(n) + b.radius(n);
      const double h_t = n_t.dot(a.shape() * n) / a.radius(n) + n_t.dot(b.shape() * n) / b.radius(n);
      area += 0.5 * (h * h - h_t * h_t) * 2 * pi / kCount;
    }
    const TrueCone cone = true_cone(a, b, 128);
    ASSERT_NEAR(cone.cross_section_area * distance * distance / area, 1, 1e-9) << "case " << i;
    ASSERT_NEAR(cone.solid_angle * distance * distance / area, 1, 1e-9) << "case " << i;
  }
}

TEST(TrueCone, Converges) {
  RandomBodies random(578);
  SCOPED_TRACE(random.trace());
  std::vector<double> at_48;
  double worst = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto [a, b] = random.separated_along_centers(1, 10, random.uniform(1.5, 3));
    const double truth = true_cone(a, b, 1024).cross_section_area;
    const auto error = [&, &a = a, &b = b](int samples) {
      return std::abs(true_cone(a, b, samples).cross_section_area / truth - 1);
    };
    if (i < 200) at_48.push_back(error(48));
    worst = std::max(worst, error(96));
  }
  std::nth_element(at_48.begin(), at_48.begin() + 100, at_48.end());
  std::cout << "[ accuracy ] median of 200 at 48 samples " << at_48[100] << ", worst of 2000 at 96 " << worst
            << "\n";
  EXPECT_LT(at_48[100], 1e-12);
  EXPECT_LT(worst, 1e-6);
}

// Needles and discs: the samples are right, and the area converges although slowly.
/// The hardest of the benchmark's 2000 pairs: two thin bodies that cross at an angle. Nodes that also follow
/// the azimuth itself are off by 1.6e-6 and 3.6e-6.
TEST(TrueCone, ThinBodiesThatCross) {
  const Vector4d attitude_a(0.0079, 0.8771, 0.4405, -0.1911), attitude_b(-0.004, -0.5302, 0.6529, -0.541);
  const Ellipsoid a =
      Ellipsoid::from_axes({0, 0, 0}, {7.679, 1.054, 8.731}, rotation_3d(attitude_a.normalized()));
  const Ellipsoid b = Ellipsoid::from_axes({-7.164, 9.137, -17.068}, {1.827, 1.186, 9.206},
                                           rotation_3d(attitude_b.normalized()));
  const double truth = true_cone(a, b, 2000).cross_section_area;
  EXPECT_NEAR(true_cone(a, b, 999).cross_section_area / truth, 1, 1e-13);
  for (const int samples : {96, 97})
    EXPECT_NEAR(true_cone(a, b, samples).cross_section_area / truth, 1, 5e-7);
}

TEST(TrueCone, AxisRatioOfAMillion) {
  RandomBodies random(579);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 100; ++i) {
    const Ellipsoid a = Ellipsoid::from_axes(
        {0, 0, 0}, i % 2 ? Vector3d(1, 1e-6, 1e-6) : Vector3d(1, 1, 1e-6), random.rotation());
    const Vector3d d = random.direction();
    const Ellipsoid b = a.translated(2 * std::max(a.radius(d), 1e-3) * random.uniform(1.2, 2) * d);
    // In the axes of A, scaled to the unit ball, it is an elliptic cone about the image of c.
    const Matrix3d t = a.factor();
    const Vector3d c = t.inverse() * b.center();
    const Matrix3d m = 0.25 * Matrix3d::Identity();
    ASSERT_GT(c.norm(), 2);
    const TrueCone cone = true_cone(a, b, 64);
    for (const BoundarySample& s : cone.boundary) {
      const Vector3d w = (t.inverse() * s.contact).normalized();
      const double on = std::pow(c.dot(m * w), 2) - w.dot(m * w) * (c.dot(m * c) - 1);
      ASSERT_NEAR(on / (c.dot(m * c) * w.dot(m * w)), 0, 1e-9) << "case " << i;
    }
  }
}

}  // namespace
}  // namespace vericone::true_cone_test
