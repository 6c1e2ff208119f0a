// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/cones/ellipsoids/predicates.h>
#include <vericone/geometry/error.h>
#include <vericone/geometry/exact/rational.h>

#include <limits>

#include "cones/ellipsoids/exact_tangency.h"
#include "support/campaign.h"

namespace vericone::membership_test {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;
using exact::Rational;
using testing::ExactTangency, testing::moved_by_ulps, testing::RandomBodies, testing::share;

Ellipsoid sphere(const Vector3d& center, double radius) {
  return Ellipsoid::from_axes(center, Vector3d::Constant(radius));
}

Rational dot(const exact::RationalVector<3>& x, const exact::RationalVector<3>& y) {
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

/// |c x w|^2 = |c|^2 |w|^2 - (c.w)^2 against (r_A + r_B)^2 |w|^2.
Membership membership_of_spheres(const Vector3d& center, const Rational& reach, const Vector3d& v_a,
                                 const Vector3d& v_b) {
  const auto c = exact::to_rational<3>(center);
  auto w = exact::to_rational<3>(v_a);
  for (int i = 0; i < 3; ++i) w[i] -= Rational(v_b(i));
  const Rational ww = dot(w, w), cw = dot(c, w);
  if (cw.sign() <= 0) return Membership::out;
  const int sign = Rational(dot(c, c) * ww - cw * cw - reach * reach * ww).sign();
  return sign > 0 ? Membership::out : sign == 0 ? Membership::on : Membership::in;
}

TEST(Membership, SpheresThatGraze) {
  // |c x w| / |w| = 5 . 3 / 5 = 3 = 1 + 2.
  const ConeOracle oracle(sphere({0, 0, 0}, 1), sphere({5, 0, 0}, 2));
  EXPECT_EQ(oracle.membership({4, 3, 0}), Membership::on);
  EXPECT_EQ(oracle.membership({4, 0, -3}), Membership::on);
  EXPECT_EQ(oracle.membership({20, 9, 12}), Membership::on) << "|(9, 12)| = 15 = 20 . 3 / 4";
  EXPECT_EQ(oracle.membership({-4, -3, 0}), Membership::out) << "behind";
  EXPECT_EQ(oracle.membership({-4, 0, 0}), Membership::out) << "behind";
  EXPECT_EQ(oracle.membership({0, 0, 0}), Membership::out);
  EXPECT_EQ(oracle.membership({1, 0, 0}), Membership::in);
  EXPECT_EQ(oracle.membership({0, 1, 0}), Membership::out);
  EXPECT_EQ(oracle.membership({4, moved_by_ulps(3, 1), 0}), Membership::out);
  EXPECT_EQ(oracle.membership({4, moved_by_ulps(3, -1), 0}), Membership::in);
  EXPECT_EQ(oracle.membership({moved_by_ulps(4, 1), 3, 0}), Membership::in);
  EXPECT_EQ(oracle.membership({moved_by_ulps(4, -1), 3, 0}), Membership::out);
  EXPECT_EQ(oracle.membership({4, 3, 5e-324}), Membership::out) << "tangentially off a strictly convex cone";
}

TEST(Membership, OfADifferenceThatRoundsOntoTheBoundary) {
  const ConeOracle oracle(sphere({0, 0, 0}, 1), sphere({5, 0, 0}, 2));
  // v_A - v_B is (4, 3 +- 2^-80, 0) and rounds to (4, 3, 0).
  for (const double sign : {1.0, -1.0}) {
    const Vector3d v_a(4, 3, 0), v_b(0, sign * 0x1p-80, 0);
    ASSERT_EQ(v_a - v_b, Vector3d(4, 3, 0));
    EXPECT_EQ(oracle.membership(Vector3d(v_a - v_b)), Membership::on);
    EXPECT_EQ(oracle.membership(v_a, v_b), sign > 0 ? Membership::in : Membership::out);
    EXPECT_EQ(oracle.verdict(v_a, v_b), sign > 0 ? Verdict::in : Verdict::out);
  }
  // Both large: the rounded difference is off the boundary, the exact one is on it. (1e3 + 4, 3 - 2^-52, 0) -
  // (1e3, -2^-52, 0) is another spelling of (4, 3, 0).
  EXPECT_EQ(oracle.membership({1004, 3 - 0x1p-51, 0}, {1000, -0x1p-51, 0}), Membership::on);
  EXPECT_EQ(oracle.membership({0, 0, 0}, {-4, -3, 0}), Membership::on);
  EXPECT_EQ(oracle.membership({1e300, 0, 0}, {1e300, 0, 0}), Membership::out) << "no relative motion";
  // The difference overflows; its direction does not.
  const double big = std::numeric_limits<double>::max();
  EXPECT_EQ(oracle.membership({big, 0, 0}, {-big, 0, 0}), Membership::in);
  EXPECT_EQ(oracle.membership({-big, 0, 0}, {big, 0, 0}), Membership::out);
  EXPECT_EQ(oracle.membership({big, big, 0}, {-big, -big, 0}), Membership::out);
  EXPECT_EQ(oracle.membership({5e-324, 0, 0}), Membership::in);
  EXPECT_EQ(oracle.membership({-5e-324, 0, 0}), Membership::out);
}

TEST(Membership, VerdictsOfBodiesThatAreNotApart) {
  const Ellipsoid a = sphere({0, 0, 0}, 2);
  const Vector3d w(1, 2, 3), none(0, 0, 0);
  EXPECT_EQ(ConeOracle(a, sphere({3, 4, 0}, 3)).verdict(w, none), Verdict::touching);
  EXPECT_EQ(ConeOracle(a, sphere({3, 4, 0}, 4)).verdict(w, none), Verdict::overlapping);
  EXPECT_EQ(ConeOracle(a, a).verdict(none, none), Verdict::overlapping);
  EXPECT_EQ(ConeOracle(a, sphere({3, 4, 0}, 1)).verdict(none, none), Verdict::out);
}

TEST(Membership, RefusesVelocitiesThatAreNotNumbers) {
  const ConeOracle oracle(sphere({0, 0, 0}, 1), sphere({5, 0, 0}, 2));
  try {
    oracle.membership({1, std::nan(""), 0}, {0, 0, 0});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.field(), "agent_velocity[1]");
  }
  try {
    oracle.verdict({1, 0, 0}, {0, 0, -std::numeric_limits<double>::infinity()});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.field(), "obstacle_velocity[2]");
  }
}

TEST(Membership, SpheresByRationalsAlone) {
  RandomBodies random(511);
  SCOPED_TRACE(random.trace());
  int counts[3] = {};
  for (int i = 0; i < share(20000); ++i) {
    // w = (4, 3, 0) k turned by a signed permutation grazes c = 5 j e_x for reach 3 j.
    const int j = random.integer(1, 1000), k = random.integer(1, 1000), first = random.integer(0, 2);
    const int r = random.integer(1, 3 * j - 1);
    const double scale = std::ldexp(1.0, random.integer(-300, 300)),
                 speed = std::ldexp(k, random.integer(-300, 300));
    const Vector3d c = 5 * j * Vector3d::Unit(first);
    Vector3d w = 4 * Vector3d::Unit(first);
    w((first + random.integer(1, 2)) % 3) = random.coin() ? 3 : -3;
    w = speed * (random.integer(0, 9) == 0 ? -1 : 1) * random.ulps(w, random.integer(0, 2));
    const ConeOracle oracle(sphere({0, 0, 0}, scale * r), sphere(scale * c, scale * (3 * j - r)));
    const Membership expected = membership_of_spheres(c, Rational(3 * j), w, {0, 0, 0});
    ++counts[static_cast<int>(expected)];
    ASSERT_EQ(oracle.membership(w), expected) << "case " << i;
    ASSERT_EQ(oracle.exact_membership(w, {0, 0, 0}), expected) << "case " << i;
    const auto triage = oracle.triage_membership(w);
    ASSERT_TRUE(!triage || *triage == expected) << "case " << i;
  }
  for (const int count : counts) EXPECT_GT(count, share(2000));
}

// Bodies whose gap is below the rounding of the centres: the cone is a half-space to 1e-8, and its edge is
// decided by the gap itself.
TEST(Membership, SpheresCloserThanRounding) {
  RandomBodies random(512);
  SCOPED_TRACE(random.trace());
  int certified = 0, counts[3] = {};
  for (int i = 0; i < 4000; ++i) {
    const int k = random.integer(1, 100), moved = random.integer(0, 2);
    const double by = std::ldexp(1.0, random.integer(-42, -40));
    Vector3d c = k * Vector3d(2, 3, 6);
    const double gap = by * c(moved) / (7 * k);
    c(moved) += by;
    const double ra = random.integer(1, 7 * k - 1), rb = 7 * k - ra;
    const ConeOracle oracle(sphere({0, 0, 0}, ra), sphere(c, rb));
    ASSERT_EQ(oracle.relation(), Relation::disjoint);
    certified += oracle.normal_certified();
    // Nearly in the common tangent plane, leaning to either side by about sqrt(2 gap / reach).
    const double lean = random.uniform(-2, 2) * std::sqrt(2 * gap / (7 * k));
    const Vector3d w = c.cross(random.direction()).normalized() + lean * c.normalized() +
                       random.log_uniform(1e-17, 1e-9) * random.direction();
    for (const Vector3d& v : {w, Vector3d(-w), c, Vector3d(-c)}) {
      const Membership expected = membership_of_spheres(c, Rational(7 * k), v, {0, 0, 0});
      ++counts[static_cast<int>(expected)];
      ASSERT_EQ(oracle.membership(v), expected) << "case " << i;
    }
  }
  EXPECT_GT(certified, 3900) << "normals that the exact maximiser should still supply";
  EXPECT_GT(counts[static_cast<int>(Membership::in)], 4500);
  EXPECT_GT(counts[static_cast<int>(Membership::out)], 4500);
}

/// Sign of n.(x - y), and whether its size is clear of the curvature of the cone over the move.
int side(const Vector3d& n, const Vector3d& x, const Vector3d& y, bool& clear) {
  Rational sum = 0;
  for (int i = 0; i < 3; ++i) sum += Rational(n(i)) * (Rational(x(i)) - Rational(y(i)));
  clear = std::abs(static_cast<double>(sum)) > 1e-6 * n.norm() * (x - y).norm();
  return sum.sign();
}

TEST(Membership, GeneralEllipsoidsThatGraze) {
  int counts[3] = {}, undecided = 0, asked = 0;
  for (const double stretch : {1.0, 0x1p6, 0x1p14})
    for (const double scale : {1.0, 0x1p332, 0x1p-332}) {
      RandomBodies random(513);
      SCOPED_TRACE(random.trace() + " stretch " + std::to_string(stretch));
      for (int i = 0; i < share(700); ++i) {
        const ExactTangency t = ExactTangency::random(random, stretch, scale);
        const ConeOracle oracle(t.a, t.b), swapped(t.b, t.a);
        ASSERT_EQ(oracle.relation(), Relation::disjoint) << "case " << i;
        ASSERT_EQ(oracle.membership(t.w), Membership::on) << "case " << i;
        ASSERT_EQ(oracle.membership(-t.w), Membership::out) << "case " << i;
        ASSERT_EQ(swapped.membership(-t.w), Membership::on) << "case " << i;
        ASSERT_FALSE(oracle.triage_membership(t.w).has_value()) << "case " << i;
        ++counts[static_cast<int>(Membership::on)];
        for (int j = 0; j < 3; ++j) {
          Vector3d moved = t.w;
          for (int l = 0; l < 3; ++l)
            if (moved(l) != 0) moved(l) = moved_by_ulps(moved(l), random.integer(-1, 1));
          if (moved.cross(t.w).isZero(0)) continue;
          bool clear = false;
          const int s = side(t.normal, moved, t.w, clear);
          // The plane n.x = 0 supports the cone: nothing of it lies beyond, only the ray of w within.
          if (s > 0 && (!clear || stretch > 0x1p6)) continue;
          const Membership expected = s > 0 ? Membership::in : Membership::out;
          ++counts[static_cast<int>(expected)];
          ++asked;
          undecided += !oracle.triage_membership(moved).has_value();
          ASSERT_EQ(oracle.membership(moved), expected) << "case " << i;
        }
      }
    }
  for (const int count : counts) EXPECT_GT(count, share(2000));
  EXPECT_GT(undecided, asked / 2) << "neighbours of the boundary are what the last rung is for";
}

}  // namespace
}  // namespace vericone::membership_test
