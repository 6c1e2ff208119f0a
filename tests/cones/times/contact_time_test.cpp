// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/testing/random_bodies.h>

#include "cones/ellipsoids/exact_tangency.h"

namespace vericone::contact_time_test {
namespace {

using Eigen::Vector3d;
using testing::ExactTangency, testing::moved_by_ulps, testing::RandomBodies;

Ellipsoid sphere(const Vector3d& center, double radius) {
  return Ellipsoid::from_axes(center, Vector3d::Constant(radius));
}

TEST(ContactTime, KnownCases) {
  const Ellipsoid a = sphere({0, 0, 0}, 1), b = sphere({5, 0, 0}, 2);
  EXPECT_NEAR(time_to_contact(a, b, {4, 0, 0}).value(), 0.5, 1e-15);
  EXPECT_FALSE(time_to_contact(a, b, {-4, 0, 0}).has_value());
  EXPECT_FALSE(time_to_contact(a, b, {0, 4, 0}).has_value());
  EXPECT_FALSE(time_to_contact(a, b, {0, 0, 0}).has_value());
  EXPECT_EQ(time_to_contact(a, sphere({3, 0, 0}, 2), {-1, 0, 0}), 0.0) << "touching now";
  EXPECT_EQ(time_to_contact(a, sphere({1, 0, 0}, 2), {-1, 0, 0}), 0.0) << "overlapping now";
  EXPECT_NEAR(time_to_contact(a, b, {4, 3, 0}).value(), 0.8, 1e-15) << "grazing: c.w / |w|^2";
  EXPECT_FALSE(time_to_contact(a, b, {4, moved_by_ulps(3, 1), 0}).has_value());
  const ConeOracle oracle(a, b);
  EXPECT_TRUE(time_to_contact(oracle, {4, 3, 0}, {0, 0x1p-80, 0}).has_value());
  EXPECT_FALSE(time_to_contact(oracle, {4, 3, 0}, {0, -0x1p-80, 0}).has_value());
}

TEST(ContactTime, OfSpheres) {
  RandomBodies random(611);
  SCOPED_TRACE(random.trace());
  int hits = 0;
  for (int i = 0; i < 20000; ++i) {
    const double r1 = random.log_uniform(0.1, 10), r2 = random.log_uniform(0.1, 10), reach = r1 + r2;
    const Vector3d c = reach * (1 + random.log_uniform(1e-3, 1e6)) * random.direction();
    const double speed = random.log_uniform(1e-3, 1e3), offset = random.uniform(0, 1.2) * reach;
    const Vector3d w = speed * (c + offset * c.cross(random.direction()).normalized()).normalized();
    const auto time = time_to_contact(sphere({0, 0, 0}, r1), sphere(c, r2), w);
    // |c - w t| = reach, the smaller root, without cancellation: t = (|c|^2 - reach^2) / (c.w + root).
    const double miss = c.cross(w).norm() / w.norm();
    if (std::abs(miss - reach) < 1e-9 * reach + 1e-14 * c.norm()) continue;
    ASSERT_EQ(time.has_value(), miss < reach) << "case " << i;
    if (!time) continue;
    ++hits;
    const double root = std::sqrt((reach - miss) * (reach + miss)) * w.norm();
    const double expected = (c.norm() - reach) * (c.norm() + reach) / (c.dot(w) + root);
    const double grazing = reach / (reach - miss), far = c.norm() / (c.norm() - reach);
    ASSERT_NEAR(*time / expected, 1, 4e-15 * (1 + std::sqrt(grazing)) * (1 + far)) << "case " << i;
  }
  EXPECT_GT(hits, 5000);
}

RandomBodies::Pair draw(RandomBodies& random, int kind) {
  switch (kind % 4) {
    case 0:
      return random.scaled_from_touching(1, 10, random.uniform(1.01, 3));
    case 1:
      return random.scaled_from_touching(1e-3, 1, random.uniform(1.1, 3));
    case 2:
      return random.scaled_from_touching(1, 10, random.log_uniform(10, 1e6));
    default:
      return random.scaled_from_touching(1e-2, 1e2, random.uniform(1.1, 3));
  }
}

TEST(ContactTime, IsWhenTheRelationChanges) {
  RandomBodies random(612);
  SCOPED_TRACE(random.trace());
  int hits = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto [a, b] = draw(random, i);
    const Vector3d n = random.direction();
    // Towards some point of B's surface or inside.
    const Vector3d target = b.center() + random.uniform(0, 0.99) * (b.support_point(n) - b.center());
    const Vector3d w = random.log_uniform(0.01, 100) * (target - a.center());
    const auto time = time_to_contact(a, b, w);
    ASSERT_TRUE(time.has_value()) << "case " << i;
    ++hits;
    ASSERT_EQ(relation(a.translated(*time * (1 - 1e-9) * w), b), Relation::disjoint) << "case " << i;
    ASSERT_EQ(relation(a.translated(*time * (1 + 1e-9) * w), b), Relation::overlapping) << "case " << i;
    // Both bodies seen from the other: the same.
    ASSERT_NEAR(time_to_contact(b, a, -w).value() / *time, 1, 1e-9) << "case " << i;
  }
  EXPECT_EQ(hits, 20000);
}

TEST(ContactTime, AgreesWithAMarch) {
  RandomBodies random(613);
  SCOPED_TRACE(random.trace());
  int hits = 0, misses = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto [a, b] = random.scaled_from_touching(1, 4, random.uniform(1.05, 2));
    const Vector3d w = (b.center() - a.center()).normalized() + 0.8 * random.direction();
    if (w.norm() < 0.3) continue;
    const auto time = time_to_contact(a, b, w);
    // Conservative advancement: never past the first contact, since the separation is the room there is.
    double t = 0;
    bool met = false;
    for (int step = 0; step < 2000; ++step) {
      const double room = separation(a.translated(t * w), b).distance;
      if (room < 1e-10) {
        met = true;
        break;
      }
      t += room / w.norm();
      if (t * w.norm() > 40) break;
    }
    if (time) {
      ++hits;
      ASSERT_LE(t, *time * (1 + 1e-9)) << "case " << i;
      if (met) {
        ASSERT_NEAR(t, *time, 2e-5) << "case " << i;
      }
    } else {
      ++misses;
      ASSERT_FALSE(met) << "case " << i;
    }
  }
  EXPECT_GT(hits, 400);
  EXPECT_GT(misses, 200);
}

// Grazing exactly: the bodies meet when the supporting points do, w t = c - S_A n / rho_A - S_B n / rho_B,
// and ExactTangency has w = k_A k_B times that.
TEST(ContactTime, OfAGrazingVelocity) {
  RandomBodies random(614);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 1000; ++i) {
    const ExactTangency t = ExactTangency::random(random);
    const auto time = time_to_contact(t.a, t.b, t.w);
    ASSERT_TRUE(time.has_value()) << "case " << i;
    const Vector3d n = t.normal.normalized();
    const Vector3d between = t.b.support_point(-n) - t.a.support_point(n);
    ASSERT_NEAR(*time, between.dot(t.w) / t.w.squaredNorm(), 1e-9 * (1 + *time)) << "case " << i;
    ASSERT_EQ(clearance_ahead(ConeOracle(t.a, t.b), t.w, {0, 0, 0}), 0);
    ASSERT_NEAR(clearance(t.a, t.b, t.w).distance, 0, 1e-12 * (1 + (t.b.center() - t.a.center()).norm()))
        << "case " << i;
  }
}

TEST(ContactTime, AndClearanceAtEveryScale) {
  RandomBodies random(615);
  SCOPED_TRACE(random.trace());
  for (const double scale : {0x1p-400, 1e-100, 1e-9, 1e9, 1e100, 0x1p400}) {
    for (int i = 0; i < 300; ++i) {
      const auto [a, b] =
          random.scaled_from_touching(i % 2 ? 1 : 1e-2, i % 2 ? 10 : 1, random.uniform(1.05, 3));
      const Ellipsoid p = a.scaled(scale), q = b.scaled(scale);
      const Vector3d w =
          b.center() - a.center() + 0.7 * (b.center() - a.center()).norm() * random.direction();
      ASSERT_NEAR(clearance(p, q, w).distance / scale, clearance(a, b, w).distance, 1e-12)
          << "case " << i << " scale " << scale;
      const Separation s = separation(a, b), t = separation(p, q);
      ASSERT_NEAR(t.distance / scale / s.distance, 1, 1e-9) << "case " << i << " scale " << scale;
      ASSERT_LT((t.normal - s.normal).norm(), 1e-9) << "case " << i << " scale " << scale;
      const auto now = time_to_contact(a, b, w), scaled = time_to_contact(p, q, w);
      ASSERT_EQ(now.has_value(), scaled.has_value()) << "case " << i << " scale " << scale;
      if (now) {
        ASSERT_NEAR(*scaled / scale / *now, 1, 1e-9) << "case " << i << " scale " << scale;
      }
    }
  }
}

}  // namespace
}  // namespace vericone::contact_time_test
