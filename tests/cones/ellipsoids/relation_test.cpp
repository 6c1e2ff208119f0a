// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/cones/ellipsoids/predicates.h>
#include <vericone/geometry/exact/rational.h>
#include <vericone/internal/cones/ellipsoids/contact_frame.h>
#include <vericone/internal/cones/ellipsoids/rungs.h>

#include <array>

#include "cones/ellipsoids/exact_tangency.h"
#include "cones/ellipsoids/print_answers.h"
#include "support/campaign.h"

namespace vericone::relation_test {
namespace {

using Eigen::Matrix2d, Eigen::Matrix3d, Eigen::Vector2d, Eigen::Vector3d;
using testing::ExactTangency, testing::moved_by_ulps, testing::RandomBodies, testing::share;

Ellipsoid sphere(const Vector3d& center, double radius) {
  return Ellipsoid::from_axes(center, Vector3d::Constant(radius));
}
Ellipse circle(const Vector2d& center, double radius) {
  return Ellipse::from_axes(center, Vector2d::Constant(radius));
}

/// Two solid spheres by integers or rationals only.
Relation relation_of_spheres(const Vector3d& a, double ra, const Vector3d& b, double rb) {
  using exact::Rational;
  Rational distance2 = 0, reach = Rational(ra) + Rational(rb);
  for (int i = 0; i < 3; ++i)
    distance2 += (Rational(b(i)) - Rational(a(i))) * (Rational(b(i)) - Rational(a(i)));
  const int sign = Rational(distance2 - reach * reach).sign();
  return sign > 0 ? Relation::disjoint : sign == 0 ? Relation::touching : Relation::overlapping;
}

/// Sign of n.(x - y), exactly.
int side(const Vector3d& n, const Vector3d& x, const Vector3d& y) {
  using exact::Rational;
  Rational sum = 0;
  for (int i = 0; i < 3; ++i) sum += Rational(n(i)) * (Rational(x(i)) - Rational(y(i)));
  return sum.sign();
}

TEST(Relation, SpheresOfEveryKind) {
  const Ellipsoid a = sphere({0, 0, 0}, 2);
  EXPECT_EQ(relation(a, sphere({3, 4, 0}, 3)), Relation::touching);
  EXPECT_EQ(relation(a, sphere({2, 3, 6}, 5)), Relation::touching);
  EXPECT_EQ(relation(a, sphere({3, 4, 0}, 2.999)), Relation::disjoint);
  EXPECT_EQ(relation(a, sphere({3, 4, 0}, 3.001)), Relation::overlapping);
  EXPECT_EQ(relation(a, sphere({0, 0, 0}, 3)), Relation::overlapping) << "concentric";
  EXPECT_EQ(relation(a, sphere({0, 0, 0}, 2)), Relation::overlapping) << "the same body";
  EXPECT_EQ(relation(a, sphere({0.5, 0, 0}, 0.25)), Relation::overlapping) << "nested";
  EXPECT_EQ(relation(a, sphere({3, 4, 0}, 7)), Relation::overlapping) << "touching from inside";
  EXPECT_EQ(relation(a, sphere({1, 0, 0}, 1)), Relation::overlapping) << "touching from inside";
  EXPECT_EQ(relation(a, sphere({1e9, 0, 0}, 3)), Relation::disjoint);
}

TEST(Relation, CirclesOfEveryKind) {
  const Ellipse a = circle({0, 0}, 2);
  EXPECT_EQ(relation(a, circle({3, 4}, 3)), Relation::touching);
  EXPECT_EQ(relation(a, circle({3, 4}, 3 - 0x1p-51)), Relation::disjoint);
  EXPECT_EQ(relation(a, circle({3, 4}, 3 + 0x1p-51)), Relation::overlapping);
  EXPECT_EQ(relation(a, circle({3, 4}, 7)), Relation::overlapping) << "touching from inside";
  EXPECT_EQ(relation(a, circle({0, 0}, 2)), Relation::overlapping);
  EXPECT_EQ(relation(circle({0, 0}, 3), circle({5, 12}, 10)), Relation::touching);
}

TEST(Relation, AlignedEllipsesThatTouch) {
  // Along x the half widths are the semi-axes.
  const auto ellipse = [](double x, double y, double a, double b) {
    return Ellipse::from_axes({x, y}, Vector2d(a, b));
  };
  EXPECT_EQ(relation(ellipse(0, 0, 6, 2), ellipse(9, 0, 3, 50)), Relation::touching);
  EXPECT_EQ(relation(ellipse(0, 0, 6, 2), ellipse(moved_by_ulps(9, 1), 0, 3, 50)), Relation::disjoint);
  EXPECT_EQ(relation(ellipse(0, 0, 6, 2), ellipse(moved_by_ulps(9, -1), 0, 3, 50)), Relation::overlapping);
  // The line x + y = const is a common tangent: half widths 5 and 13 (times sqrt 2 / 2 both).
  EXPECT_EQ(relation(ellipse(0, 0, 3, 4), ellipse(9. / 5 + 25. / 13, 16. / 5 + 144. / 13, 5, 12)),
            relation(ellipse(0, 0, 4, 3), ellipse(16. / 5 + 144. / 13, 9. / 5 + 25. / 13, 12, 5)))
      << "mirror image of rounded centres";
}

TEST(Relation, PythagoreanSpheresAndTheirNeighbours) {
  constexpr std::array<std::array<int, 4>, 6> kQuadruples = {
      {{1, 2, 2, 3}, {2, 3, 6, 7}, {1, 4, 8, 9}, {4, 4, 7, 9}, {2, 6, 9, 11}, {6, 10, 15, 19}}};
  int counts[3] = {};
  RandomBodies random(501);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < share(20000); ++i) {
    const auto& q = kQuadruples[random.integer(0, 5)];
    const int k = random.integer(1, 1000), r = random.integer(1, k * q[3] - 1);
    const double scale = std::ldexp(1.0, random.integer(-300, 300));
    const Vector3d home = random.integer(0, 1) * Vector3d(random.integer(-99, 99), 7, -3);
    Vector3d c = home + k * Vector3d(q[0], -q[1], q[2]);
    double ra = r, rb = k * q[3] - r;
    const int what = random.integer(0, 6);
    if (what > 0 && what < 4) c(what - 1) = moved_by_ulps(c(what - 1), random.coin() ? 1 : -1);
    if (what == 4) ra = moved_by_ulps(ra, random.coin() ? 1 : -1);
    if (what == 5) rb = moved_by_ulps(rb, random.coin() ? 1 : -1);
    const Relation expected = relation_of_spheres(home, ra, c, rb);
    ++counts[static_cast<int>(expected)];
    const Ellipsoid a = sphere(scale * home, scale * ra), b = sphere(scale * c, scale * rb);
    ASSERT_EQ(relation(a, b), expected) << "case " << i;
    ASSERT_EQ(exact_relation(a, b), expected) << "case " << i;
    if (what == 0 || what == 6) {
      ASSERT_EQ(expected, Relation::touching);
    }
  }
  for (const int count : counts) EXPECT_GT(count, share(2000));
}

TEST(Relation, TouchingEllipsoidsAndTheirNeighbours) {
  int counts[3] = {};
  for (const double stretch : {1.0, 0x1p6, 0x1p14})
    for (const double scale : {1.0, 0x1p332, 0x1p-332}) {
      RandomBodies random(502);
      SCOPED_TRACE(random.trace() + " stretch " + std::to_string(stretch));
      for (int i = 0; i < share(1000); ++i) {
        const ExactTangency t = ExactTangency::random(random, stretch, scale);
        const Ellipsoid &a = t.touching_a, &b = t.touching_b;
        ASSERT_EQ(relation(a, b), Relation::touching) << "case " << i;
        ASSERT_EQ(relation(b, a), Relation::touching) << "case " << i;
        ++counts[static_cast<int>(Relation::touching)];
        Vector3d moved = b.center();
        for (int j = 0; j < 3; ++j)
          if (moved(j) != 0) moved(j) = moved_by_ulps(moved(j), random.integer(-1, 1));
        if (moved == b.center()) continue;
        // Beyond the common tangent plane, or in it beside the only common point: apart. This side of it: the
        // bodies bulge by less than the move for as long as the move is small against their radii.
        const int s = side(t.normal, moved, b.center());
        const Relation expected = s < 0 ? Relation::overlapping : Relation::disjoint;
        if (s < 0 && stretch > 0x1p6) continue;
        ++counts[static_cast<int>(expected)];
        ASSERT_EQ(relation(a, b.translated(moved - b.center())), expected) << "case " << i;
      }
    }
  for (const int count : counts) EXPECT_GT(count, share(1000));
}

TEST(Relation, FactorDefinedEllipsoidThatTouchesASphere) {
  // For n = (1, 2, 2) the sphere of radius r has rho = 3 r; semi-axes (9, 3, 1) give |(9, 6, 2)| = 11.
  struct Case {
    Vector3d n, axes;
    double rho, length;
  };
  const Case cases[] = {
      {{1, 2, 2}, {9, 3, 1}, 11, 3}, {{1, 2, 2}, {1, 2, 4}, 9, 3}, {{1, 2, 2}, {3, 2, 6}, 13, 3}};
  for (const Case& c : cases) {
    const Vector3d sn = c.axes.cwiseProduct(c.axes).cwiseProduct(c.n);
    const double k = c.rho * c.length;  // lengths times k: c = k (S_A n / rho + r n / |n|) is whole
    for (const int r : {1, 2, 5, 1000}) {
      const Ellipsoid a = Ellipsoid::from_axes({0, 0, 0}, k * c.axes), b = sphere({0, 0, 0}, k * r);
      const Vector3d at = c.length * sn + c.rho * r * c.n;
      EXPECT_EQ(relation(a, b.translated(at)), Relation::touching);
      EXPECT_EQ(relation(b.translated(at), a), Relation::touching);
      for (int j = 0; j < 3; ++j) {
        Vector3d away = at, closer = at;
        away(j) = moved_by_ulps(at(j), 1);
        closer(j) = moved_by_ulps(at(j), -1);
        EXPECT_EQ(relation(a, b.translated(away)), Relation::disjoint);
        EXPECT_EQ(relation(a, b.translated(closer)), Relation::overlapping);
      }
    }
  }
}

TEST(Relation, DoesNotDependOnTheContactFrameGiven) {
  RandomBodies random(503);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 2000; ++i) {
    const auto [a, b] =
        random.scaled_from_touching(0.1, 3, 1 + (random.coin() ? 1 : -1) * random.log_uniform(1e-16, 0.5));
    const Relation expected = exact_relation(a, b);
    const auto [other_a, other_b] = random.scaled_from_touching(0.1, 3, random.uniform(0.5, 2));
    ASSERT_EQ(relation(a, b, ContactFrame<3>(other_a, other_b)), expected) << "case " << i;
    ASSERT_EQ(relation(a, b, ContactFrame<3>(a, b)), expected) << "case " << i;
  }
}

}  // namespace
}  // namespace vericone::relation_test
