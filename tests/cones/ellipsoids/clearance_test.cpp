// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/cones/cone_geometry.h>
#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/geometry/error.h>
#include <vericone/testing/random_bodies.h>
#include <Eigen/Geometry>

#include <cmath>
#include <limits>
#include <numbers>

#include "cones/ellipsoids/richardson.h"
#include "support/campaign.h"

namespace vericone::clearance_test {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;
using testing::RandomBodies, testing::richardson_derivative, testing::share;

const Vector3d kStill(0, 0, 0);

Ellipsoid sphere(const Vector3d& center, double radius) {
  return Ellipsoid::from_axes(center, Vector3d::Constant(radius));
}

double gap(const Ellipsoid& a, const Ellipsoid& b, const Vector3d& n) {
  return n.dot(b.center() - a.center()) - a.radius(n) - b.radius(n);
}

/// The definition of m(w) on a grid, each of the best points refined by a golden section.
double clearance_by_brute_force(const Ellipsoid& a, const Ellipsoid& b, const Vector3d& w, int count) {
  const AxisFrame frame(w);
  const auto g = [&](double t) { return gap(a, b, std::cos(t) * frame.e1 + std::sin(t) * frame.e2); };
  double best = g(0), at = 0;
  for (int i = 1; i < count; ++i)
    if (const double t = 2 * pi * i / count, value = g(t); value > best) {
      best = value;
      at = t;
    }
  double lo = at - 2 * pi / count, hi = at + 2 * pi / count;
  for (int i = 0; i < 60; ++i) {
    const double x = hi - 0.618034 * (hi - lo), y = lo + 0.618034 * (hi - lo);
    (g(x) < g(y) ? lo : hi) = g(x) < g(y) ? x : y;
  }
  return std::max(best, g(0.5 * (lo + hi)));
}

TEST(Clearance, OfSpheres) {
  RandomBodies random(601);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 3000; ++i) {
    const double r1 = random.log_uniform(0.01, 10), r2 = random.log_uniform(0.01, 10);
    const Vector3d home = random.in_box(5), c = (r1 + r2) * random.uniform(0, 5) * random.direction(),
                   w = random.log_uniform(1e-3, 1e3) * random.direction();
    const Ellipsoid a = sphere(home, r1), b = sphere(home + c, r2);
    const Clearance m = clearance(a, b, w);
    ASSERT_NEAR(m.distance, c.cross(w).norm() / w.norm() - r1 - r2, 1e-13 * (c.norm() + r1 + r2 + 5))
        << "case " << i;
    ASSERT_NEAR(m.time, c.dot(w) / w.squaredNorm(), 1e-13 * (1 + c.norm()) / w.norm()) << "case " << i;
    ASSERT_NEAR(m.normal.dot(w), 0, 1e-14 * w.norm());
    ASSERT_NEAR(m.normal.norm(), 1, 1e-14);
    ASSERT_GE(m.normal.dot(c), -1e-13 * c.norm()) << "from A towards B";
    const Separation s = separation(a, b);
    const double apart = c.norm() - r1 - r2;
    if (apart > 1e-12) {
      ASSERT_NEAR(s.distance, apart, 1e-13 * (c.norm() + 5)) << "case " << i;
      ASSERT_LT((s.normal - (b.center() - a.center()).normalized()).norm(), 1e-14) << "case " << i;
    } else if (apart < -1e-12) {
      ASSERT_EQ(s.distance, 0);
      ASSERT_EQ(s.normal, kStill);
    }
  }
}

TEST(Clearance, OfConcentricAndOfTouchingSpheres) {
  EXPECT_NEAR(clearance(sphere({1, 2, 3}, 2), sphere({1, 2, 3}, 3), {0, 0, 7}).distance, -5, 1e-14);
  const Separation touching = separation(sphere({0, 0, 0}, 2), sphere({3, 4, 0}, 3));
  EXPECT_EQ(touching.distance, 0);
  EXPECT_LT((touching.normal - Vector3d(0.6, 0.8, 0)).norm(), 1e-8);
  EXPECT_NEAR(clearance(sphere({0, 0, 0}, 1), sphere({5, 0, 0}, 2), {4, 3, 0}).distance, 0, 1e-14)
      << "grazing";
}

TEST(Clearance, RefusesNoDirection) {
  for (const Vector3d& w : {Vector3d(0, 0, 0), Vector3d(1, std::nan(""), 0)}) {
    try {
      clearance(sphere({0, 0, 0}, 1), sphere({5, 0, 0}, 1), w);
      FAIL();
    } catch (const InputError& error) {
      EXPECT_EQ(error.field(), "relative_velocity");
    }
  }
}

TEST(Clearance, IsTheLargestGapOverAllNormals) {
  RandomBodies random(602);
  SCOPED_TRACE(random.trace());
  int negative = 0;
  for (int i = 0; i < share(400); ++i) {
    const double low = i % 4 == 0 ? 1e-3 : i % 4 == 1 ? 0.05 : 1;
    const auto [a, b] = random.scaled_from_touching(low, i % 4 < 2 ? 1 : 10, random.uniform(0, 2));
    const Vector3d w = random.direction();
    const double size = a.factor().norm() + b.factor().norm() + (b.center() - a.center()).norm();
    const Clearance m = clearance(a, b, w);
    const double brute = clearance_by_brute_force(a, b, w, i % 4 == 0 ? 100000 : 20000);
    ASSERT_NEAR(m.distance, brute, 1e-10 * size) << "case " << i;
    ASSERT_NEAR(gap(a, b, m.normal), m.distance, 1e-13 * size);
    negative += m.distance < 0;
  }
  EXPECT_GT(negative, share(100));
  EXPECT_LT(negative, 300);
}

TEST(Clearance, GradientsAndTime) {
  RandomBodies random(603);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 1000; ++i) {
    const auto [a, b] = random.scaled_from_touching(1, 4, random.uniform(1.1, 3));
    const Vector3d w = random.uniform(0.5, 3) * random.direction(), d = random.direction();
    const Clearance m = clearance(a, b, w);
    if (m.distance < 0.05) continue;  // smooth where it is positive
    const double by_center = richardson_derivative(
        [&, &a = a, &b = b](double t) { return clearance(a, b.translated(t * d), w).distance; }, 0.01);
    ASSERT_NEAR(m.gradient_center().dot(d), by_center, 1e-8) << "case " << i;
    const double by_velocity = richardson_derivative(
        [&, &a = a, &b = b](double t) { return clearance(a, b, w + t * d).distance; }, 0.01 * w.norm());
    const double scale = 1 + std::abs(m.time);
    ASSERT_NEAR(m.gradient_velocity().dot(d), by_velocity, 1e-7 * scale) << "case " << i;
    // The supporting points pass each other: their difference at that time is along the normal.
    const Vector3d between = b.support_point(-m.normal) - a.support_point(m.normal) - m.time * w;
    ASSERT_LT((between - m.distance * m.normal).norm(), 1e-6 * (1 + between.norm())) << "case " << i;
  }
}

TEST(Clearance, IsConstantAlongTheMotion) {
  RandomBodies random(604);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 2000; ++i) {
    const auto [a, b] = random.scaled_from_touching(1, 4, random.uniform(1.05, 3));
    const Vector3d w = random.direction();
    const double t = random.uniform(-20, 20);
    const Clearance now = clearance(a, b, w), later = clearance(a.translated(t * w), b, w);
    ASSERT_NEAR(later.distance, now.distance, 1e-12) << "case " << i;
    if (now.distance > 0.01) {
      ASSERT_NEAR(later.time, now.time - t, 1e-11) << "case " << i;
    }
    ASSERT_NEAR(clearance(a, b, 8 * w).distance, now.distance, 1e-13);
    ASSERT_NEAR(clearance(a, b, -w).distance, now.distance, 1e-12) << "the line, not the ray";
    ASSERT_NEAR(clearance(b, a, w).distance, now.distance, 1e-12);
  }
}

TEST(Separation, AgreesWithBruteForce) {
  RandomBodies random(605);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 60; ++i) {
    const auto [a, b] = random.scaled_from_touching(i % 2 ? 0.3 : 1, i % 2 ? 3 : 4, random.uniform(1.01, 3));
    const Separation s = separation(a, b);
    const double size = a.factor().norm() + b.factor().norm();
    ASSERT_NEAR(gap(a, b, s.normal), s.distance, 1e-13 * size);
    ASSERT_NEAR(s.normal.norm(), 1, 1e-14);
    // The gap of no other normal is larger, and the closest points are that far apart.
    for (int j = 0; j < 20000; ++j) ASSERT_LE(gap(a, b, random.direction()), s.distance + 1e-13 * size);
    const Vector3d p = a.support_point(s.normal), q = b.support_point(-s.normal);
    ASSERT_LT((q - p - s.distance * s.normal).norm(), 1e-9 * size) << "case " << i;
  }
}

TEST(Separation, OfThinDistantAndCloseBodies) {
  RandomBodies random(606);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 3000; ++i) {
    const int kind = i % 4;
    const auto [a, b] = kind == 0   ? random.scaled_from_touching(1e-5, 1, random.uniform(1.01, 3))
                        : kind == 1 ? random.scaled_from_touching(1, 10, random.log_uniform(10, 1e8))
                        : kind == 2 ? random.scaled_from_touching(1, 10, 1 + random.log_uniform(1e-9, 1e-2))
                                    : random.scaled_from_touching(1e-3, 1e3, random.uniform(1.01, 3));
    const Separation s = separation(a, b);
    const double size = a.factor().norm() + b.factor().norm() + (b.center() - a.center()).norm();
    ASSERT_GT(s.distance, 0) << "case " << i;
    // Optimal: the closest points differ by the distance along the normal.
    const Vector3d p = a.support_point(s.normal), q = b.support_point(-s.normal);
    ASSERT_LT((q - p - s.distance * s.normal).norm(), 1e-6 * size) << "case " << i;
    ASSERT_NEAR(separation(b, a).distance, s.distance, 1e-12 * size) << "case " << i;
    // Shrunk towards each other along the normal they touch.
    ASSERT_EQ(relation(a, b.translated(-(s.distance + 1e-9 * size) * s.normal)), Relation::overlapping)
        << "case " << i;
    ASSERT_EQ(relation(a, b.translated(-(s.distance - 1e-9 * size) * s.normal)), Relation::disjoint)
        << "case " << i;
    // Moving straight across the gap passes at exactly the separation, never at more.
    const Vector3d w = s.normal.cross(random.direction());
    ASSERT_NEAR(clearance(a, b, w).distance, s.distance, 1e-9 * size) << "case " << i;
    ASSERT_LE(clearance(a, b, random.direction()).distance, s.distance + 1e-12 * size) << "case " << i;
  }
}

TEST(ClearanceAhead, SignIsThatOfTheVerdict) {
  RandomBodies random(607);
  SCOPED_TRACE(random.trace());
  int counts[5] = {};
  for (int i = 0; i < 10000; ++i) {
    const auto [a, b] = random.scaled_from_touching(1, 4, random.uniform(0.9, 2));
    const ConeOracle oracle(a, b);
    for (int j = 0; j < 10; ++j) {
      const Vector3d v_a = random.direction(),
                     v_b = random.integer(0, 20) == 0 ? v_a : Vector3d(0.7 * random.direction());
      const double ahead = clearance_ahead(oracle, v_a, v_b);
      const Verdict verdict = oracle.verdict(v_a, v_b);
      ++counts[static_cast<int>(verdict)];
      switch (verdict) {
        case Verdict::in:
          ASSERT_LT(ahead, 0);
          break;
        case Verdict::out:
          ASSERT_GT(ahead, 0);
          break;
        case Verdict::on:
        case Verdict::touching:
          ASSERT_EQ(ahead, 0);
          break;
        case Verdict::overlapping:
          ASSERT_LE(ahead, 0);
          break;
        case Verdict::undecided:
          FAIL() << "two ellipsoids are decided";
      }
    }
  }
  EXPECT_GT(counts[static_cast<int>(Verdict::in)], 10000);
  EXPECT_GT(counts[static_cast<int>(Verdict::out)], 10000);
  EXPECT_GT(counts[static_cast<int>(Verdict::overlapping)], 3000);
}

TEST(ClearanceAhead, KnownCases) {
  const ConeOracle apart(sphere({0, 0, 0}, 1), sphere({5, 0, 0}, 2));
  EXPECT_NEAR(clearance_ahead(apart, {-1, 0, 0}, kStill), 2, 1e-14) << "moving apart: the present distance";
  EXPECT_NEAR(clearance_ahead(apart, kStill, kStill), 2, 1e-14);
  EXPECT_NEAR(clearance_ahead(apart, {0, 1, 0}, kStill), 2, 1e-14);
  EXPECT_EQ(clearance_ahead(apart, {4, 3, 0}, kStill), 0) << "grazing";
  EXPECT_EQ(clearance_ahead(apart, {4, 3, 0}, {0, 0x1p-80, 0}), -std::numeric_limits<double>::min());
  EXPECT_GT(clearance_ahead(apart, {4, 3, 0}, {0, -0x1p-80, 0}), 0);
  EXPECT_NEAR(clearance_ahead(apart, {1, 0, 0}, kStill), -3, 1e-14);
  EXPECT_NEAR(clearance_ahead(apart, {3, 4, 0}, kStill), 1, 1e-14) << "5 . 4 / 5 - 3";
}

TEST(ClearanceAhead, IsTheLeastSeparationOnTheWay) {
  RandomBodies random(608);
  SCOPED_TRACE(random.trace());
  int misses = 0;
  for (int i = 0; i < 300; ++i) {
    const auto [a, b] = random.scaled_from_touching(1, 3, random.uniform(1.1, 3));
    const Vector3d v_a = random.direction(), v_b = 0.5 * random.direction(), w = v_a - v_b;
    const ConeOracle oracle(a, b);
    if (oracle.verdict(v_a, v_b) != Verdict::out) continue;
    const double ahead = clearance_ahead(oracle, v_a, v_b);
    double least = separation(a, b).distance;
    const double span = 3 * ((b.center() - a.center()).norm() + 6) / w.norm();
    for (int j = 0; j <= 400; ++j)
      least = std::min(least, separation(a.translated(j * span / 400 * w), b).distance);
    ASSERT_GE(least, ahead - 1e-10) << "case " << i;
    // The distance is 1-Lipschitz along the way and flat at its minimum.
    ASSERT_LE(least, ahead + 1e-2) << "case " << i;
    ++misses;
  }
  EXPECT_GT(misses, 100);
}

TEST(LengthsAndTimes, AtTheEndsOfTheDoubles) {
  const Ellipsoid a = sphere(kStill, 1);
  const double share_across = 1 / std::sqrt(17.0);  // of a distance along x, across (4, 1, 0)
  for (const double x : {1e100, 1e139, 1e141, 1e155, 1e160, 1e200, 1e300, 1.7e308}) {
    SCOPED_TRACE(x);
    for (const double radius : {2.0, 1e-3 * x}) {
      if (radius > 1e149) continue;  // no such body
      const Ellipsoid b = sphere({x, 0, 0}, radius);
      const ConeOracle oracle(a, b);
      ASSERT_EQ(oracle.membership({4, 1, 0}), Membership::out);
      EXPECT_NEAR(clearance_ahead(oracle, {4, 1, 0}, kStill) / (x * share_across - radius), 1, 1e-14);
      EXPECT_NEAR(separation(a, b).distance / (x - radius), 1, 1e-14);
      EXPECT_NEAR(separation(a, b).normal.x(), 1, 1e-15);
      EXPECT_NEAR(clearance_ahead(oracle, {-4, 1, 0}, kStill) / (x - radius), 1, 1e-14) << "now nearest";
      ASSERT_EQ(oracle.membership({1, 0, 0}), Membership::in);
      EXPECT_NEAR(*time_to_contact(oracle, {1, 0, 0}, kStill) / (x - radius), 1, 1e-14);
      EXPECT_NEAR(clearance_ahead(oracle, {1, 0, 0}, kStill) / (1 + radius), -1, 1e-14);
    }
  }
  // Bodies of 1e149 m, ten of them apart.
  const Ellipsoid big_a = sphere(kStill, 1e149), big_b = sphere({1e150, 0, 0}, 2e149);
  EXPECT_NEAR(separation(big_a, big_b).distance, 7e149, 1e136);
}

TEST(LengthsAndTimes, OfSpeedsAtTheEndsOfTheDoubles) {
  const ConeOracle oracle(sphere(kStill, 1), sphere({5, 0, 0}, 2));
  for (const double speed : {1e-300, 1e-160, 1e-100, 1e100, 1e155, 1e200, 1e300}) {
    SCOPED_TRACE(speed);
    EXPECT_NEAR(*time_to_contact(oracle, {speed, 0, 0}, kStill) * speed, 2, 1e-14);
    EXPECT_NEAR(clearance_ahead(oracle, {speed, 0, 0}, kStill), -3, 1e-14);
    EXPECT_NEAR(clearance_ahead(oracle, {3 * speed, 4 * speed, 0}, kStill), 1, 1e-14);
  }
  EXPECT_TRUE(std::isinf(*time_to_contact(oracle, {5e-324, 0, 0}, kStill))) << "4e323 s";
  // The difference is no double, the answers are.
  const Vector3d fast(1.7e308, 0, 0);
  EXPECT_NEAR(clearance_ahead(oracle, fast, -fast), -3, 1e-14);
  EXPECT_NEAR(*time_to_contact(oracle, fast, -fast) * 1.7e308, 1, 1e-14);
  EXPECT_NEAR(clearance_ahead(oracle, {1.5e308, 1.7e308, 0}, {-1.5e308, -1.7e308, 0}),
              5 * 1.7 / std::hypot(1.5, 1.7) - 3, 1e-14);
}

TEST(LengthsAndTimes, OfAGapBelowRounding) {
  // One unit in the last place of 3 apart: the time is not zero.
  const double x = std::nextafter(3.0, 4.0);
  const ConeOracle oracle(sphere(kStill, 1), sphere({x, 0, 0}, 2));
  ASSERT_EQ(oracle.relation(), Relation::disjoint);
  EXPECT_NEAR(*time_to_contact(oracle, {1, 0, 0}, kStill) / (x - 3), 1, 1e-12);
}

TEST(Clearance, OfVeryThinDiscs) {
  // The disc's plane holds x; across (4, 3, 0) its thin direction is z, where both are one unit wide.
  for (double length = 1e3; length < 1e60; length *= 10) {
    const Ellipsoid disc = Ellipsoid::from_axes({5, 0, 0}, {length, 1e-3, 1});
    const ConeOracle oracle(sphere(kStill, 1), disc);
    ASSERT_EQ(oracle.relation(), Relation::overlapping);
    EXPECT_NEAR(clearance_ahead(oracle, {4, 3, 0}, kStill), -2, 2e-5) << length;
  }
  // Turned, no double is the normal: a depth that is not there, or right.
  RandomBodies random(612);
  SCOPED_TRACE(random.trace());
  int absent = 0;
  for (int i = 0; i < 200; ++i) {
    const double length = random.log_uniform(1e3, 1e30);
    const Eigen::Matrix3d rotation = random.rotation();
    const Ellipsoid disc = Ellipsoid::from_axes(kStill, {length, 1e-3, 1}, rotation);
    const Vector3d w = random.direction(), z = rotation.col(0).cross(w).normalized();
    // Normals across w and the long axis are the only ones that are not wide.
    const double depth = -1 - std::hypot(1e-3 * rotation.col(1).dot(z), rotation.col(2).dot(z));
    const double found = clearance(sphere(kStill, 1), disc, w).distance;
    absent += std::isnan(found);
    if (!std::isnan(found)) {
      ASSERT_NEAR(found, depth, 1e-4) << length;
    }
  }
  EXPECT_LT(absent, 150);
}

TEST(Clearance, IsTheSameWhereverTheVelocityLies) {
  RandomBodies random(613);
  SCOPED_TRACE(random.trace());
  alignas(64) double room[8];
  for (int i = 0; i < 2000; ++i) {
    const Ellipsoid a = sphere(kStill, 1), b = sphere(random.in_box(9), random.uniform(0.1, 3));
    const Vector3d w = random.direction();
    auto* const even = new (room) Vector3d(w);
    const Clearance here = clearance(a, b, *even);
    auto* const odd = new (room + 1) Vector3d(w);
    const Clearance there = clearance(a, b, *odd);
    ASSERT_EQ(there.distance, here.distance);
    ASSERT_EQ(there.time, here.time);
    ASSERT_EQ(there.normal, here.normal);
  }
}

}  // namespace
}  // namespace vericone::clearance_test
