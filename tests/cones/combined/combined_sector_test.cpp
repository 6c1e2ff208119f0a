// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/internal/cones/combined/sector.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/campaign.h"
#include "support/random_combined.h"

namespace vericone::combined_sector_test {
namespace {

using Eigen::Matrix2d, Eigen::Vector2d;
using std::numbers::pi;
using testing::random_combined, testing::RandomBodies, testing::share;

double cross(const Vector2d& x, const Vector2d& y) { return x.x() * y.y() - x.y() * y.x(); }
double difference(double x, double y) { return std::abs(std::remainder(x - y, 2 * pi)); }

/// Both sides of the sector by all pairs of boundary points, as angles from the line of centres, and whether
/// some boundary point is in the other body.
struct Sampled {
  bool meet = false;
  double left = -9, right = -9;

  Sampled(const CombinedEllipse& a, const CombinedEllipse& b, int count) {
    const Vector2d c = b.center() - a.center();
    const auto boundary = [&](const CombinedEllipse& body) {
      std::vector<Vector2d> points;
      for (int i = 0; i < count; ++i) {
        const Vector2d u(std::cos(2 * pi * i / count), std::sin(2 * pi * i / count));
        points.push_back(u / body.gauge(u));
      }
      for (const Corner& corner : corners(body)) points.push_back(corner.point - body.center());
      return points;
    };
    const std::vector<Vector2d> of_a = boundary(a), of_b = boundary(b);
    for (const Vector2d& x : of_a) meet = meet || b.gauge(x - c) <= 1;
    for (const Vector2d& y : of_b) meet = meet || a.gauge(y + c) <= 1;
    for (const Vector2d& x : of_a)
      for (const Vector2d& y : of_b) {
        const Vector2d d = c + y - x;
        const double angle = std::atan2(cross(c, d), c.dot(d));
        left = std::max(left, angle);
        right = std::max(right, -angle);
      }
  }
};

TEST(CombinedSector, AgainstAllPairsOfBoundaryPoints) {
  RandomBodies random(5221);
  SCOPED_TRACE(random.trace());
  constexpr int kSamples = 240;
  int disjoint = 0, in_mouth = 0;
  for (int i = 0; i < share(1500); ++i) {
    const CombinedEllipse a = random_combined(random, Vector2d(random.uniform(-3, 3), random.uniform(-3, 3)));
    const CombinedEllipse b =
        random_combined(random, a.center() + random.uniform(0.3, 14) * random.direction_2d());
    const CombinedSector s = combined_sector(a, b);
    const Sampled sampled(a, b, kSamples);
    if (sampled.meet) {
      ASSERT_EQ(s.sector.relation, Relation::overlapping) << "case " << i;
    }
    if (s.sector.relation != Relation::disjoint) continue;
    ++disjoint;
    in_mouth += s.hulls_overlap;
    const Vector2d c = b.center() - a.center();
    const double at_centers = std::atan2(c.y(), c.x());
    const double left = std::remainder(s.sector.theta_b - at_centers, 2 * pi) + s.sector.psi / 2,
                 right = s.sector.psi - left;
    // Samples cannot lie outside; and steps of 1.5 degrees miss the extreme by a part of their square.
    ASSERT_GE(left, sampled.left - 1e-12) << "case " << i;
    ASSERT_GE(right, sampled.right - 1e-12) << "case " << i;
    ASSERT_LE(left, sampled.left + 0.03) << "case " << i;
    ASSERT_LE(right, sampled.right + 0.03) << "case " << i;
  }
  EXPECT_GT(disjoint, share(500));
  EXPECT_GT(in_mouth, 5);
}

/// The largest of the conics' values at a point, each relative to its terms: 0 on the boundary.
double boundary_value(const CombinedEllipse& body, const Vector2d& point) {
  const Vector2d y = point - body.center();
  const Vector2d u = body.ellipsoid().factor().inverse() * y;
  double largest = u.squaredNorm() - 1;
  for (const Delimiter<2>& d : body.delimiters())
    largest = std::max(largest, d.value(y) / (y.squaredNorm() * d.matrix.norm() + d.level));
  return largest;
}

/// What an edge must be: from a point of A to a point of B, at the angle that the sector says.
TEST(CombinedSector, EdgesJoinBoundaryPoints) {
  RandomBodies random(5222);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 5000; ++i) {
    const CombinedEllipse a = random_combined(random, Vector2d(random.uniform(-3, 3), random.uniform(-3, 3)));
    const CombinedEllipse b =
        random_combined(random, a.center() + random.uniform(3, 14) * random.direction_2d());
    const CombinedSector s = combined_sector(a, b);
    if (s.sector.relation != Relation::disjoint) continue;
    const auto check = [&](const SectorEdge& edge, const Touch& on_a, const Touch& on_b, double side) {
      ASSERT_NEAR(boundary_value(a, edge.point_on_a), 0, 1e-13);
      ASSERT_NEAR(boundary_value(b, edge.point_on_b), 0, 1e-13);
      ASSERT_NEAR(edge.direction.norm(), 1, 1e-15);
      ASSERT_NEAR(cross(edge.direction, edge.normal), -side, 1e-15);
      const Vector2d way = edge.point_on_b - edge.point_on_a;
      ASSERT_GT(way.dot(edge.direction), 0);
      ASSERT_NEAR(cross(way, edge.direction), 0, 1e-12 * (1 + way.norm()));
      const double angle = std::atan2(edge.direction.y(), edge.direction.x());
      ASSERT_LT(difference(angle, s.sector.theta_b + side * s.sector.psi / 2), 2e-15);
      ASSERT_LE(on_a.corner ? on_a.second : on_a.first, static_cast<int>(a.delimiters().size()));
      ASSERT_LE(on_b.corner ? on_b.second : on_b.first, static_cast<int>(b.delimiters().size()));
    };
    check(s.sector.left, s.left_a, s.left_b, 1);
    check(s.sector.right, s.right_a, s.right_b, -1);
    ASSERT_EQ(s.hulls_overlap, s.sector.psi > pi);
    if (HasFatalFailure()) FAIL() << "case " << i;
  }
}

/// Accuracy: equal to rounding when the plane is turned, mirrored, scaled, moved and the bodies exchanged.
TEST(CombinedSector, Laws) {
  RandomBodies random(5223);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 3000; ++i) {
    const CombinedEllipse a = random_combined(random, Vector2d::Zero());
    const CombinedEllipse b = random_combined(random, random.uniform(2, 14) * random.direction_2d());
    const CombinedSector s = combined_sector(a, b);
    if (s.sector.relation != Relation::disjoint) continue;
    const CombinedSector exchanged = combined_sector(b, a);
    ASSERT_EQ(exchanged.sector.relation, s.sector.relation) << "case " << i;
    ASSERT_NEAR(exchanged.sector.psi, s.sector.psi, 1e-13) << "case " << i;
    ASSERT_LT(difference(exchanged.sector.theta_b, s.sector.theta_b + pi), 1e-13) << "case " << i;

    const CombinedSector doubled = combined_sector(a.scaled(4), b.scaled(4));
    ASSERT_EQ(doubled.sector.psi, s.sector.psi) << "case " << i;
    ASSERT_EQ(doubled.sector.theta_b, s.sector.theta_b) << "case " << i;
    const Vector2d by(0.5, -0.25);
    const CombinedSector moved = combined_sector(a.translated(by), b.translated(by));
    ASSERT_NEAR(moved.sector.psi, s.sector.psi, 1e-13) << "case " << i;

    const double angle = random.uniform(-pi, pi);
    const bool mirror = random.coin();
    Matrix2d map = rotation_2d(angle);
    if (mirror) map.col(1) *= -1;
    const auto image = [&](const CombinedEllipse& body) {
      Matrix2d shape = map * body.ellipsoid().shape() * map.transpose();
      shape(1, 0) = shape(0, 1);
      std::vector<Delimiter<2>> delimiters = body.delimiters();
      for (Delimiter<2>& d : delimiters) {
        d.matrix = map * d.matrix * map.transpose();
        d.matrix(1, 0) = d.matrix(0, 1);
      }
      return CombinedEllipse::trusted(Ellipse::from_shape(map * body.center(), shape), delimiters);
    };
    const CombinedSector turned = combined_sector(image(a), image(b));
    ASSERT_EQ(turned.sector.relation, s.sector.relation) << "case " << i;
    ASSERT_NEAR(turned.sector.psi, s.sector.psi, 1e-11) << "case " << i;
    ASSERT_LT(difference(turned.sector.theta_b, (mirror ? -1 : 1) * s.sector.theta_b + angle), 1e-11)
        << "case " << i;
  }
}

/// Nothing is lost at 1e9 from the origin: the centres here differ by exact numbers.
TEST(CombinedSector, FarFromTheOrigin) {
  RandomBodies random(5225);
  SCOPED_TRACE(random.trace());
  const auto coarse = [](double x) { return std::round(x * 1024) / 1024; };
  for (int i = 0; i < 1000; ++i) {
    const CombinedEllipse a = random_combined(random, Vector2d::Zero());
    const Vector2d c = random.uniform(2, 14) * random.direction_2d();
    const CombinedEllipse b = random_combined(random, Vector2d(coarse(c.x()), coarse(c.y())));
    const Vector2d by(0x1p30, -0x1p29);
    const CombinedSector near = combined_sector(a, b),
                         far = combined_sector(a.translated(by), b.translated(by));
    ASSERT_EQ(far.sector.relation, near.sector.relation) << "case " << i;
    ASSERT_NEAR(far.sector.psi, near.sector.psi, 1e-13) << "case " << i;
    ASSERT_LT(difference(far.sector.theta_b, near.sector.theta_b), 1e-13) << "case " << i;
  }
}

TEST(CombinedSector, EllipsesAsBefore) {
  RandomBodies random(5224);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 200; ++i) {
    const auto [a, b] = random.planar_scaled_from_touching(1, 6, random.uniform(0.8, 3));
    const Sector plain = sector_by_support(a, b);
    const CombinedSector s = combined_sector(a, b);
    ASSERT_EQ(s.sector.relation, plain.relation);
    ASSERT_EQ(s.sector.psi, plain.psi);
    ASSERT_EQ(s.sector.theta_b, plain.theta_b);
    ASSERT_FALSE(s.hulls_overlap);
  }
}

/// A disc in the mouth: both edges run from the disc through the lips, (a_c, +-b_c sqrt(k)).
TEST(CombinedSector, InTheMouth) {
  const double a_c = 6, b_c = 2, k = 0.9, r = 0.25, x = 3.5;
  const CombinedEllipse b = dented_conic(Vector2d::Zero(), a_c, b_c, k, 0);
  const CombinedEllipse a = Ellipse::from_axes(Vector2d(x, 0), Vector2d::Constant(r));
  const CombinedSector s = combined_sector(a, b);
  ASSERT_EQ(s.sector.relation, Relation::disjoint);
  EXPECT_TRUE(s.hulls_overlap);
  // Seen from the disc's centre the lip is `distance` away, `lip` from the axis; the tangent is asin(r / d)
  // further.
  const double dx = a_c - x, dy = b_c * std::sqrt(k), distance = std::hypot(dx, dy);
  const double half = pi - std::atan2(dy, dx) + std::asin(r / distance);
  EXPECT_NEAR(s.sector.psi, 2 * half, 1e-14);
  EXPECT_NEAR(std::abs(s.sector.theta_b), pi, 1e-15);
  EXPECT_TRUE(s.left_b.corner);
  EXPECT_TRUE(s.right_b.corner);
  EXPECT_FALSE(s.left_a.corner);
  // One more step to the right and the disc is out, one to the left and it is stuck.
  EXPECT_EQ(combined_sector(a.translated(Vector2d(-1.6, 0)), b).sector.relation, Relation::overlapping);
  EXPECT_FALSE(combined_sector(a.translated(Vector2d(9, 0)), b).hulls_overlap);
}

/// Two bow ties whose necks cross away from both centres: only concave arcs cross.
TEST(CombinedSector, CrossedNecksOverlap) {
  const CombinedEllipse a(Ellipse::from_axes(Vector2d::Zero(), Vector2d(10, 10)),
                          {hyperbola(Vector2d(0.5, 3), 0)});
  const auto b = [&](double x, double y) {
    return CombinedEllipse(Ellipse::from_axes(Vector2d(x, y), Vector2d(10, 10)),
                           {hyperbola(Vector2d(0.5, 3), pi / 2)});
  };
  const CombinedSector s = combined_sector(a, b(1.2, 1.2));
  EXPECT_EQ(s.sector.relation, Relation::overlapping);
  EXPECT_EQ(s.sector.psi, 2 * pi);
}

/// The section of a cone (level 0) may be the centre alone.
TEST(CombinedSector, APointAmongBodies) {
  const CombinedEllipse point(Ellipse::from_axes(Vector2d(1, 2), Vector2d(3, 2)),
                              {{Vector2d(1, 4).asDiagonal().toDenseMatrix(), 0}});
  const CombinedEllipse disc = Ellipse::from_axes(Vector2d(1, 7), Vector2d(1.5, 1.5));
  const CombinedSector s = combined_sector(point, disc);
  ASSERT_EQ(s.sector.relation, Relation::disjoint);
  EXPECT_NEAR(s.sector.psi, 2 * std::asin(1.5 / 5), 1e-15);
  EXPECT_NEAR(s.sector.theta_b, pi / 2, 1e-15);
  EXPECT_EQ(combined_sector(point, disc.translated(Vector2d(0, -4))).sector.relation, Relation::overlapping);
}

/// An ellipse cut by another one is convex: its cone is the common part of the two ellipses' cones or
/// smaller, and goes through both kinds of arcs.
TEST(CombinedSector, CutByAnEllipse) {
  const Ellipse first = Ellipse::from_axes(Vector2d::Zero(), Vector2d(4, 1)),
                second = Ellipse::from_axes(Vector2d::Zero(), Vector2d(1, 4));
  Matrix2d m = Vector2d(1, 1.0 / 16).asDiagonal();
  const CombinedEllipse both(first, {{m, 1}});
  // From near by the corners, at 4 / sqrt(17) both ways, are the extremes; from far the upper arc is.
  const Ellipse near = Ellipse::from_axes(Vector2d(2.5, 0), Vector2d(0.1, 0.1));
  const CombinedSector s = combined_sector(both, near);
  const double at = 4 / std::sqrt(17.0), dx = 2.5 - at;
  EXPECT_TRUE(s.left_a.corner);
  EXPECT_NEAR(s.sector.psi, 2 * (std::atan2(at, dx) + std::asin(0.1 / std::hypot(at, dx))), 1e-14);
  const Ellipse far = near.translated(Vector2d(17.5, 0));
  EXPECT_NEAR(combined_sector(both, far).sector.psi, sector_by_support(first, far).psi, 1e-15);
  const Ellipse above = near.translated(Vector2d(-2.5, 20));
  EXPECT_EQ(combined_sector(both, above).left_a.first, 1);
  EXPECT_NEAR(combined_sector(both, above).sector.psi, sector_by_support(second, above).psi, 1e-15);
  const Ellipse slim = Ellipse::from_axes(Vector2d(0, 3), Vector2d(10, 0.1));
  const CombinedSector along = combined_sector(both, slim);
  EXPECT_LE(along.sector.psi, sector_by_support(first, slim).psi);
  // The body's top is on the first ellipse; from the slim one's ends the shoulders count.
  EXPECT_EQ(along.sector.relation, Relation::disjoint);
  EXPECT_EQ(sector_by_support(second, slim).relation, Relation::overlapping);
}

/// Source, 5.4.2 (errata, 4): F1 6 x 2 m at the origin, along its heading of 45 degrees, 25 m/s; F2 the conic
/// (5.5) with k = 1 at (45, 0), along its heading of 120 degrees, 20 m/s.
TEST(CombinedSector, OfTheSource) {
  const auto heading = [](double degrees) {
    return Vector2d(std::cos(degrees * pi / 180), std::sin(degrees * pi / 180));
  };
  const Ellipse f1 = Ellipse::from_axes(Vector2d::Zero(), Vector2d(6, 2), rotation_2d(pi / 4));
  const CombinedEllipse f2 = dented_conic(Vector2d(45, 0), 6, 2, 1, 2 * pi / 3);
  const CombinedSector s = combined_sector(f1, f2);
  EXPECT_NEAR(s.sector.psi * 180 / pi, 26.85, 0.005);
  const ConeFunction f = cone_function(s.sector.psi, s.sector.theta_b, 25 * heading(45), 20 * heading(120));
  EXPECT_NEAR(f.y, -0.05331, 5e-6);
  EXPECT_TRUE(f.colliding());
  // The ellipse around it would say -0.0669.
  const Sector around = sector_by_support(f1, f2.ellipsoid());
  EXPECT_NEAR(cone_function(around.psi, around.theta_b, 25 * heading(45), 20 * heading(120)).y, -0.0669,
              5e-5);
}

TEST(CombinedSector, ContinuousInK) {
  const Ellipse f1 = Ellipse::from_axes(Vector2d::Zero(), Vector2d(6, 2), rotation_2d(pi / 4));
  for (const double phi : {0.0, 0.5, 1.2, 2 * pi / 3, 2.8}) {
    const auto at = [&](double k) {
      return combined_sector(f1, dented_conic(Vector2d(45, 0), 6, 2, k, phi)).sector;
    };
    Sector last = at(0);
    for (int i = 1; i <= 100; ++i) {
      const Sector now = at(i / 100.0);
      // The longest dimension, 6 sqrt(1 + k), seen from 45 - 6 - 8.5: slopes below 0.3 a unit of k.
      EXPECT_LT(std::abs(now.psi - last.psi), 3e-3) << phi << " " << i;
      EXPECT_LT(std::abs(now.theta_b - last.theta_b), 3e-3) << phi << " " << i;
      last = now;
    }
    // At the ends, without a step: the dent closes and the pinch opens continuously.
    EXPECT_NEAR(at(1e-12).psi, at(0).psi, 1e-11);
    EXPECT_NEAR(at(1 - 1e-12).psi, at(1).psi, 1e-11);
  }
}

}  // namespace
}  // namespace vericone::combined_sector_test
