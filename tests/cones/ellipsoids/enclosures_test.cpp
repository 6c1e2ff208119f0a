// SPDX-License-Identifier: BSD-3-Clause
//
// Enclosures against exact predicates: what lies between two doubles is proved by moving a body by each of
// them and asking, without rounding, whether there still is a collision.
#include <gtest/gtest.h>
#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/cones/planar/sector.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/planar/enclose_sector.h>
#include <vericone/testing/random_bodies.h>

#include <iostream>

namespace vericone::enclosures_test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::RandomBodies;

Ellipsoid sphere(const Vector3d& center, double r) { return Ellipsoid::from_axes(center, {r, r, r}); }

TEST(EncloseClearance, SpheresInClosedForm) {
  // c = (5, 0, 0): the line along (3, 4, 0) passes the centre at distance 4, along (4, 3, 0) at 3.
  const Ellipsoid a = sphere({0, 0, 0}, 1);
  struct Case {
    Vector3d w;
    double radius, clearance;
  };
  for (const Case& c : {Case{{3, 4, 0}, 2, 1}, Case{{4, 3, 0}, 2, 0}, Case{{4, 3, 0}, 3.5, -1.5},
                        Case{{1, 0, 0}, 2, -3}, Case{{-3, 4, 0}, 2, 1}, Case{{3e200, 4e200, 0}, 2, 1}}) {
    const Interval m = enclose_clearance(a, sphere({5, 0, 0}, c.radius), c.w);
    EXPECT_TRUE(m.contains(c.clearance)) << m.lo() << " " << m.hi() << " for " << c.clearance;
    EXPECT_LT(m.hi() - m.lo(), c.clearance > 0 ? 3e-14 : c.w.y() == 0 ? 1e-2 : 1e-10);
  }
  // Along the line of centres of spheres all normals are equally good: the branch and bound has to look at
  // all of them closely, and stops at a wider interval.
  EXPECT_TRUE(enclose_clearance(a, sphere({5, 0, 0}, 1), {1, 0, 0}).contains(-2));
  EXPECT_THROW(enclose_clearance(a, a, {0, 0, 0}), InputError);
}

TEST(EncloseClearance, IsProvedByMovingTheBody) {
  RandomBodies random(611);
  SCOPED_TRACE(random.trace());
  double widest_positive = 0, widest_negative = 0;
  int positive = 0, negative = 0;
  for (int i = 0; i < 600; ++i) {
    const double low = i % 3 == 0 ? 1e-3 : 1;
    const auto [a, b] = random.scaled_from_touching(low, 10, random.uniform(1.05, 3));
    const Vector3d towards = (b.center() - a.center()).normalized();
    const Vector3d w = towards + random.uniform(0, 1.5) * random.direction();
    const Clearance near = clearance(a, b, w);
    const Interval m = enclose_clearance(a, b, w);
    ASSERT_TRUE(m.finite()) << i;
    ASSERT_LE(m.lo(), m.hi());
    // Moving B by s along the normal, which is perpendicular to w to rounding only: a margin for that.
    const double margin = 1e-13 * ((b.center() - a.center()).norm() + 10);
    const auto moved = [&, &a = a, &b = b](double s) { return ConeOracle(a, b.translated(s * near.normal)); };
    const auto hits = [&](const ConeOracle& oracle) {
      return oracle.relation() != Relation::disjoint || oracle.passage(w) != Passage::never;
    };
    if (m.positive()) {
      ++positive;
      ASSERT_FALSE(hits(moved(-m.lo() + margin))) << i;
      ASSERT_TRUE(hits(moved(-m.hi() - margin))) << i;
      widest_positive = std::max(widest_positive, m.hi() - m.lo());
    } else if (m.negative()) {
      ++negative;
      ASSERT_FALSE(hits(moved(-m.lo() + margin))) << i;
      // No shift that is smaller than the depth helps, in no direction.
      for (int k = 0; k < 10; ++k) {
        const Vector3d d = w.cross(random.direction()).normalized();
        ASSERT_TRUE(hits(ConeOracle(a, b.translated((-m.hi() - margin) * d)))) << i;
      }
      ASSERT_TRUE(hits(moved(-m.hi() - margin))) << i;
      widest_negative = std::max(widest_negative, m.hi() - m.lo());
    }
    ASSERT_LE(m.lo(), near.distance + margin);
    ASSERT_GE(m.hi(), near.distance - margin);
  }
  std::cout << "[ widths   ] clearance: " << positive << " misses within " << widest_positive << " m, "
            << negative << " hits within " << widest_negative << " m\n";
  EXPECT_GT(positive, 100);
  EXPECT_GT(negative, 100);
  EXPECT_LT(widest_positive, 1e-11);
  EXPECT_LT(widest_negative, 1e-9);
}

TEST(EncloseSeparation, IsProvedByMovingTheBody) {
  EXPECT_TRUE(enclose_separation(sphere({0, 0, 0}, 1), sphere({3, 4, 0}, 2)).contains(2));
  EXPECT_EQ(enclose_separation(sphere({0, 0, 0}, 3), sphere({3, 4, 0}, 2)).hi(), 0);
  EXPECT_EQ(enclose_separation(sphere({0, 0, 0}, 4), sphere({3, 4, 0}, 2)).hi(), 0);
  RandomBodies random(612);
  SCOPED_TRACE(random.trace());
  double widest = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto [a, b] =
        random.scaled_from_touching(i % 3 == 0 ? 1e-3 : 1, 10, 1 + random.log_uniform(1e-9, 3));
    const Interval d = enclose_separation(a, b);
    if (relation<3>(a, b) != Relation::disjoint) continue;
    const Vector3d n = separation(a, b).normal;
    const double margin = 1e-14 * ((b.center() - a.center()).norm() + 10);
    ASSERT_EQ(relation<3>(a, b.translated((margin - d.lo()) * n)), Relation::disjoint) << i;
    ASSERT_EQ(relation<3>(a, b.translated((-margin - d.hi()) * n)), Relation::overlapping) << i;
    widest = std::max(widest, d.hi() - d.lo());
  }
  std::cout << "[ widths   ] separation within " << widest << " m\n";
  EXPECT_LT(widest, 1e-10);
}

TEST(EncloseSector, EdgesAreBetweenExactMembers) {
  RandomBodies random(613);
  SCOPED_TRACE(random.trace());
  double widest = 0;
  int sectors = 0;
  for (int i = 0; i < 4000; ++i) {
    const double low = i % 4 == 0 ? 1e-6 : 1, far = i % 4 == 1   ? random.log_uniform(10, 1e9)
                                                    : i % 4 == 2 ? 1 + random.log_uniform(1e-14, 1e-3)
                                                                 : random.uniform(1.01, 3);
    const auto [a, b] = random.planar_scaled_from_touching(low, 10, far);
    const auto enclosure = enclose_sector(a, b);
    const SectorOracle oracle(a, b);
    ASSERT_EQ(enclosure.has_value(), oracle.relation() == Relation::disjoint) << i;
    if (!enclosure) continue;
    ++sectors;
    const Vector2d still(0, 0);
    EXPECT_NE(oracle.exact_membership(enclosure->left.from, still), Membership::out);
    EXPECT_NE(oracle.exact_membership(enclosure->left.to, still), Membership::in);
    EXPECT_NE(oracle.exact_membership(enclosure->right.to, still), Membership::out);
    EXPECT_NE(oracle.exact_membership(enclosure->right.from, still), Membership::in);
    const Sector sector = sector_by_support(a, b);
    ASSERT_NEAR(enclosure->psi.mid(), sector.psi, enclosure->psi.rad() + 1e-15) << i;
    const double turned = std::remainder(enclosure->theta_b.mid() - sector.theta_b, 2 * std::numbers::pi);
    ASSERT_NEAR(turned, 0, enclosure->theta_b.rad() + 2e-15) << i;
    if (i % 4 == 3) widest = std::max(widest, enclosure->psi.hi() - enclosure->psi.lo());
  }
  std::cout << "[ widths   ] " << sectors << " sectors; psi of ordinary pairs within " << widest << " rad\n";
  EXPECT_GT(sectors, 3500);
  EXPECT_LT(widest, 1e-14);
}

TEST(EnclosePlaneSector, SpheresAndRandomPairs) {
  // sin(edge) = 3 / 5.
  const auto spheres = enclose_plane_sector(sphere({0, 0, 0}, 1), sphere({5, 0, 0}, 2), {0, 1, 0});
  ASSERT_TRUE(spheres);
  EXPECT_LE(static_cast<long double>(spheres->left.lo()), std::asin(0.6L));
  EXPECT_GE(static_cast<long double>(spheres->left.hi()), std::asin(0.6L));
  RandomBodies random(614);
  SCOPED_TRACE(random.trace());
  double widest = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto [a, b] = random.scaled_from_touching(1, 10, random.uniform(1.05, 3));
    const Vector3d across = random.direction();
    const PlaneSector sector = true_sector(a, b, across);
    const auto enclosure = enclose_plane_sector(a, b, across);
    ASSERT_TRUE(enclosure) << i;
    EXPECT_TRUE(enclosure->left.contains(sector.left.angle));
    EXPECT_NEAR(enclosure->psi().mid(), sector.psi(), enclosure->psi().rad());
    EXPECT_NEAR(enclosure->theta_b().mid(), sector.theta_b(), enclosure->theta_b().rad());
    widest = std::max(widest, enclosure->psi().hi() - enclosure->psi().lo());
    // Independent of the intervals: beyond each end of the bracket, by far more than rounding, the exact
    // predicate says in and out.
    const ConeOracle oracle(a, b);
    const double room = 1e-14;
    const auto at = [&](double phi) {
      return Vector3d(std::cos(phi) * sector.line_of_sight + std::sin(phi) * sector.across);
    };
    EXPECT_EQ(oracle.exact_membership(at(enclosure->left.lo() - room), {0, 0, 0}), Membership::in);
    EXPECT_EQ(oracle.exact_membership(at(enclosure->left.hi() + room), {0, 0, 0}), Membership::out);
    EXPECT_EQ(oracle.exact_membership(at(-enclosure->right.lo() + room), {0, 0, 0}), Membership::in);
    EXPECT_EQ(oracle.exact_membership(at(-enclosure->right.hi() - room), {0, 0, 0}), Membership::out);
  }
  std::cout << "[ widths   ] psi on a plane within " << widest << " rad\n";
  EXPECT_LT(widest, 1e-9);
}

}  // namespace
}  // namespace vericone::enclosures_test
