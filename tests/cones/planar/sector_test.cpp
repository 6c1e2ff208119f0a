// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/cones/planar/sector.h>
#include <vericone/internal/cones/planar/cone_function.h>
#include <vericone/testing/random_bodies.h>

#include <cmath>
#include <numbers>

namespace vericone::sector_test {
namespace {

using Eigen::Vector2d;
using std::numbers::pi;
using testing::RandomBodies;

constexpr double kDegree = pi / 180;

Ellipse circle(const Vector2d& center, double radius) {
  return Ellipse::from_axes(center, Vector2d::Constant(radius));
}

double turn_between(double x, double y) { return std::abs(std::remainder(x - y, 2 * pi)); }

TEST(Sector, Circles) {
  RandomBodies random(541);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 2000; ++i) {
    const double r1 = random.log_uniform(1e-3, 1e3), r2 = random.log_uniform(1e-3, 1e3);
    const Vector2d home(random.uniform(-5, 5), random.uniform(-5, 5));
    const double d = (r1 + r2) * (1 + random.log_uniform(1e-6, 1e6));
    const Ellipse a = circle(home, r1), b = circle(home + d * random.direction_2d(), r2);
    const Vector2d c = b.center() - a.center();
    const double s = (r1 + r2) / c.norm(), psi = 2 * std::asin(s), theta_b = std::atan2(c.y(), c.x());
    const double tolerance = 8e-16 * (1 + 1 / std::sqrt((1 - s) * (1 + s)));
    const Sector support = sector_by_support(a, b), conics = sector_by_degenerate_conics(a, b).value();
    ASSERT_EQ(support.relation, Relation::disjoint);
    ASSERT_NEAR(support.psi / psi, 1, tolerance) << "case " << i;
    ASSERT_LE(turn_between(support.theta_b, theta_b), tolerance) << "case " << i;
    ASSERT_NEAR(conics.psi / psi, 1, 1e-9) << "case " << i;
    ASSERT_LE(turn_between(conics.theta_b, theta_b), 1e-12) << "case " << i;
  }
}

/// Numbers of bodies so far apart that squared lengths are no doubles are absent, not wrong.
TEST(Sector, FarApart) {
  for (const double distance : {1e100, 1e140, 1e150})
    EXPECT_NEAR(sector_by_support(circle({0, 0}, 1), circle({distance, 0}, 1)).psi * distance, 4, 1e-12);
  for (const double distance : {1e160, 1e200, 1e300}) {
    const double psi = sector_by_support(circle({0, 0}, 1), circle({distance, 0}, 1)).psi;
    EXPECT_TRUE(std::isnan(psi) || std::abs(psi * distance - 4) < 1e-12) << psi;
  }
}

TEST(Sector, TouchingAndOverlapping) {
  for (const auto& method :
       {+[](const Ellipse&a, const Ellipse&b) { return sector_by_support(a, b); },
        +[](const Ellipse&a, const Ellipse&b) { return sector_by_degenerate_conics(a, b).value(); }}) {
    const Sector touching = method(circle({1, 1}, 2), circle({4, 5}, 3));
    EXPECT_EQ(touching.relation, Relation::touching);
    EXPECT_EQ(touching.psi, pi);
    EXPECT_NEAR(touching.theta_b, std::atan2(4, 3), 1e-15);
    EXPECT_LT((touching.left.direction - Vector2d(-0.8, 0.6)).norm(), 1e-15);
    EXPECT_LT((touching.right.direction - Vector2d(0.8, -0.6)).norm(), 1e-15);
    EXPECT_LT((touching.left.point_on_a - Vector2d(2.2, 2.6)).norm(), 1e-15);
    // S n / rho is (1, 2) and (-2, 3) for n = (0, 1): the centres lie off the common normal.
    const auto shape = [](double xx, double xy, double yy) {
      return (Eigen::Matrix2d() << xx, xy, xy, yy).finished();
    };
    const Sector oblique =
        method(Ellipse::from_shape({0, 0}, shape(5, 2, 4)), Ellipse::from_shape({-1, 5}, shape(10, -6, 9)));
    EXPECT_EQ(oblique.relation, Relation::touching);
    EXPECT_NEAR(oblique.theta_b, pi / 2, 1e-15);
    const Sector over = method(circle({0, 0}, 2), circle({0, -1}, 2));
    EXPECT_EQ(over.relation, Relation::overlapping);
    EXPECT_EQ(over.psi, 2 * pi);
    EXPECT_EQ(over.theta_b, -pi / 2);
    EXPECT_EQ(method(circle({0, 0}, 2), circle({0, 0}, 1)).theta_b, 0) << "concentric";
    EXPECT_EQ(method(circle({0, 0}, 2), circle({0, 0}, 1)).psi, 2 * pi);
  }
}

TEST(Sector, OfAPairWithAxesAlongTheLineOfCenters) {
  // For n = (cos b, sin b): L cos b = sqrt(a^2 cos^2 b + b^2 sin^2 b) + the same; congruent bodies give
  // tan^2 b = (L^2 / 4 - a^2) / b^2, and psi = pi - 2 |b|.
  for (const double length : {12.5, 20.0, 1e6}) {
    const Ellipse a = Ellipse::from_axes({0, 0}, Vector2d(6, 2)),
                  b = Ellipse::from_axes({length, 0}, Vector2d(6, 2));
    const double psi = 2 * std::atan2(2, std::sqrt(length * length / 4 - 36));
    for (const Sector& s : {sector_by_support(a, b), sector_by_degenerate_conics(a, b).value()}) {
      EXPECT_NEAR(s.psi / psi, 1, 4e-15);
      EXPECT_NEAR(s.theta_b, 0, 1e-15 * psi);
      EXPECT_LT((s.left.point_on_a + s.left.point_on_b - Vector2d(length, 0)).norm(), 1e-14 * length);
    }
  }
}

/// Source, 5.4.1: F1 at the origin with 25 m/s, F2 at (45, 0) with 20 m/s; errata, 4.2 for the readings of
/// what it does not print.
struct Reading {
  double heading_1, axis_x, axis_y, heading_2;  // degrees and metres
  double y, y_digits, psi, psi_digits;
};

TEST(Sector, TheSourcesExample) {
  const Reading readings[] = {
      {45, 6, 2, 120, -0.04525, 5e-6, 24.65, 5e-3}, {45, 6, 2, 0, -0.0212, 5e-5, 17.0, 0.05},
      {45, 6, 2, 30, -0.0306, 5e-5, 20.8, 0.05},    {45, 6, 2, 90, -0.0516, 5e-5, 26.5, 0.05},
      {0, 6, 2, 120, -0.0275, 5e-5, 19.1, 0.05},    {45, 6, 3, 120, -0.0465, 5e-5, 25.0, 0.05},
      {45, 5, 2, 120, -0.0379, 5e-5, 22.6, 0.05}};
  const auto velocity = [](double speed, double heading) {
    return Vector2d(speed * std::cos(heading * kDegree), speed * std::sin(heading * kDegree));
  };
  const Vector2d v1 = velocity(25, 45), v2 = velocity(20, 120);
  for (const Reading& r : readings) {
    const Ellipse a = Ellipse::from_axes({0, 0}, {6, 2}, rotation_2d(r.heading_1 * kDegree));
    const Ellipse b = Ellipse::from_axes({45, 0}, {r.axis_x, r.axis_y}, rotation_2d(r.heading_2 * kDegree));
    for (const Sector& s : {sector_by_support(a, b), sector_by_degenerate_conics(a, b).value()}) {
      EXPECT_NEAR(s.psi / kDegree, r.psi, r.psi_digits);
      const ConeFunction f = cone_function(s.psi, s.theta_b, v1, v2);
      EXPECT_NEAR(f.y, r.y, r.y_digits);
      EXPECT_TRUE(f.colliding());
      if (&r != &readings[0]) continue;
      EXPECT_NEAR(s.psi / kDegree, 24.646, 5e-4);
      EXPECT_NEAR(s.theta_b / kDegree, -0.2527, 5e-5);
      EXPECT_NEAR(f.v_r_hat, -27.676, 5e-4);
      EXPECT_NEAR(f.v_theta_hat, -0.479, 5e-4);
    }
  }
}

TEST(ConeFunction, BothFormsAgree) {
  RandomBodies random(542);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 2000; ++i) {
    const double psi = random.uniform(0, pi), theta_b = random.uniform(-pi, pi),
                 theta = random.uniform(-pi, pi);
    const Vector2d v_a = 30 * random.uniform() * random.direction_2d(),
                   v_b = 30 * random.uniform() * random.direction_2d();
    const Vector2d v = v_b - v_a, u(std::cos(theta), std::sin(theta));
    const double v_r = v.dot(u), v_theta = u.x() * v.y() - u.y() * v.x();
    const ConeFunction f = cone_function(psi, theta_b, v_a, v_b);
    ASSERT_NEAR(f.y, cone_function_y(v_r, v_theta, theta, theta_b, psi), 1e-14);
    ASSERT_NEAR(std::hypot(f.v_r_hat, f.v_theta_hat), v.norm(), 1e-13);
    // The angle between -V and the bisector against psi / 2.
    const double off = turn_between(std::atan2(-v.y(), -v.x()), theta_b);
    if (std::abs(off - psi / 2) > 1e-6 && std::abs(off - pi / 2) > 1e-6) {
      ASSERT_EQ(f.colliding(), off < psi / 2) << "case " << i;
    }
  }
}

TEST(ConeFunction, WithoutRelativeMotion) {
  const ConeFunction f = cone_function(1, 0.3, {2, 1}, {2, 1});
  EXPECT_EQ(f.y, -std::pow(std::sin(0.5), 2));
  EXPECT_FALSE(f.colliding());
  EXPECT_EQ(cone_function_y(0, 0, 1, 2, 1), f.y);
}

// A line along w misses B - A iff one of the two normals to w separates the shadows; what is hit lies ahead
// iff w points from A to B across any separating line.
TEST(ConeFunction, CollidingAgreesWithTheRay) {
  RandomBodies random(543);
  SCOPED_TRACE(random.trace());
  int hits = 0, behind = 0, misses = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto [a, b] = random.planar_scaled_from_touching(0.1, 3, random.uniform(1.01, 4));
    const Vector2d v_a = random.direction_2d(), v_b = 0.5 * random.direction_2d(), w = v_a - v_b;
    const Vector2d c = b.center() - a.center(), n = Vector2d(-w.y(), w.x()).normalized();
    const double miss = std::abs(n.dot(c)) - a.radius(n) - b.radius(n);
    if (std::abs(miss) < 1e-9) continue;
    const Sector s = sector_by_support(a, b);
    const bool ahead = s.left.normal.dot(w) > 0 || s.right.normal.dot(w) > 0;
    const bool hit = miss < 0 && ahead;
    ASSERT_EQ(cone_function(s.psi, s.theta_b, v_a, v_b).colliding(), hit) << "case " << i;
    (hit ? hits : miss < 0 ? behind : misses)++;
  }
  EXPECT_GT(hits, 1000);
  EXPECT_GT(behind, 1000);
  EXPECT_GT(misses, 1000);
}

}  // namespace
}  // namespace vericone::sector_test
