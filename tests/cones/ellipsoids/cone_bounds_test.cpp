// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/cones/ellipsoids/true_cone.h>
#include <vericone/internal/cones/cone_size.h>
#include <vericone/testing/random_bodies.h>

#include <numbers>

#include "support/campaign.h"

namespace vericone::cone_bounds_test {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;
using testing::RandomBodies, testing::share;

TEST(PolygonMeasures, OfKnownCones) {
  const Vector3d z(0, 0, 1);
  const std::vector<Vector3d> square = {{1, 1, 1}, {-1, 1, 1}, {-1, -1, 1}, {1, -1, 1}};
  EXPECT_NEAR(polygon_section_area(z, square), 4, 1e-15);
  EXPECT_NEAR(polygon_solid_angle(z, square), 4 * pi / 6, 1e-15) << "one face of a cube";
  const std::vector<Vector3d> octant = {{1, 0, 0}, {0, 3, 0}, {0, 0, 2}};
  EXPECT_NEAR(polygon_solid_angle({1, 1, 1}, octant), pi / 2, 1e-15);
  EXPECT_NEAR(polygon_solid_angle({5, 1, 2}, octant), pi / 2, 1e-15) << "whatever axis inside";
  // The plane x + y + z = sqrt 3 cuts the octant in a triangle of side sqrt 6.
  EXPECT_NEAR(polygon_section_area({1, 1, 1}, octant), 6 * std::sqrt(3) / 4, 1e-14);
  EXPECT_TRUE(std::isinf(polygon_section_area(z, octant)));
  const std::vector<Vector3d> wide = {{1, 0, -0.1}, {0, 1, -0.1}, {-1, 0, -0.1}, {0, -1, -0.1}};
  EXPECT_GT(polygon_solid_angle(z, wide), 2 * pi) << "more than a half-space";
  EXPECT_TRUE(std::isinf(polygon_section_area(z, wide)));
}

TEST(AxisFrame, IsRightHandedAndOrthonormal) {
  RandomBodies random(581);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 1000; ++i) {
    const Vector3d d = random.log_uniform(1e-100, 1e100) * random.direction();
    const AxisFrame f(i == 0 ? Vector3d(0, 0, -2) : d);
    ASSERT_LT((f.e1.cross(f.e2) - f.axis).norm(), 1e-15);
    ASSERT_NEAR(f.e1.norm(), 1, 1e-15);
    ASSERT_NEAR(f.e2.norm(), 1, 1e-15);
  }
}

/// Normals of the faces of a polyhedral cone, towards its inside. Differences keep the digits of narrow
/// cones.
std::vector<Vector3d> faces(const PolyhedralCone& cone) {
  std::vector<Vector3d> n;
  for (std::size_t i = 0; i < cone.directions.size(); ++i) {
    const Vector3d& d = cone.directions[i];
    n.push_back(d.cross(cone.directions[(i + 1) % cone.directions.size()] - d).normalized());
  }
  return n;
}

struct Kind {
  const char* name;
  double low, high, nearest, farthest;
};

class ConeBoundsOf : public ::testing::TestWithParam<Kind> {};

TEST_P(ConeBoundsOf, HoldTheTrueConeBetweenThem) {
  RandomBodies random(582);
  SCOPED_TRACE(random.trace());
  const Kind& kind = GetParam();
  for (int i = 0; i < 300; ++i) {
    constexpr int kCounts[] = {3, 4, 5, 7, 12, 24, 48, 96};
    const int count = kCounts[random.integer(0, 7)];
    const auto [a, b] =
        random.scaled_from_touching(kind.low, kind.high, random.log_uniform(kind.nearest, kind.farthest));
    SCOPED_TRACE("case " + std::to_string(i) + ", " + std::to_string(count) + " samples");
    const TrueCone cone = true_cone(a, b, count);
    const ConeBounds bounds = cone_bounds(cone, a, b);
    const ConeOracle oracle(a, b);
    ASSERT_EQ(static_cast<int>(bounds.inner.directions.size()), count);
    ASSERT_LE(static_cast<int>(bounds.outer.directions.size()), std::max(count, 4));

    // Inner: all of it collides, by the exact predicate. Sums without rounding: membership(v, -w) is that of
    // v + w.
    for (int j = 0; j < 20; ++j) {
      const Vector3d& d = bounds.inner.directions[random.integer(0, count - 1)];
      const Vector3d& e = bounds.inner.directions[random.integer(0, count - 1)];
      ASSERT_EQ(oracle.membership(std::ldexp(1.0, random.integer(-5, 5)) * d, -e), Membership::in);
    }
    for (const Vector3d& d : bounds.inner.directions)
      ASSERT_EQ(oracle.exact_membership(d, {0, 0, 0}), Membership::in);

    // Outer: what collides is in it. The faces are rebuilt from rounded edges, hence the slack.
    const std::vector<Vector3d> outer = faces(bounds.outer);
    const double opening = cone.boundary[0].direction.cross(cone.axis).norm();
    for (const BoundarySample& s : cone.boundary)
      for (const Vector3d& n : outer) ASSERT_GT(n.dot(s.direction), -1e-12);
    for (int j = 0; j < 20; ++j) {
      const Vector3d w = bounds.outer.directions[random.integer(0, count - 1)] +
                         random.uniform(-0.3, 0.3) * opening * random.direction();
      if (oracle.membership(w) == Membership::out) continue;
      for (const Vector3d& n : outer) ASSERT_GT(n.dot(w.normalized()), -1e-12);
    }

    // Sizes, and the promise about the error.
    const TrueCone truth = true_cone(a, b, 2048);
    ASSERT_LE(bounds.inner.solid_angle, truth.solid_angle * (1 + 1e-9));
    ASSERT_GE(bounds.outer.solid_angle, truth.solid_angle * (1 - 1e-9));
    ASSERT_LE(std::abs(bounds.solid_angle - truth.solid_angle),
              bounds.solid_angle_error + 1e-9 * truth.solid_angle);
    if (std::isfinite(truth.cross_section_area)) {
      ASSERT_LE(bounds.inner.cross_section_area, truth.cross_section_area * (1 + 1e-7));
      ASSERT_GE(bounds.outer.cross_section_area, truth.cross_section_area * (1 - 1e-7));
    }
    if (std::isfinite(bounds.cross_section_area_error)) {
      ASSERT_LE(std::abs(bounds.cross_section_area - truth.cross_section_area),
                bounds.cross_section_area_error + 1e-7 * truth.cross_section_area);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Pairs, ConeBoundsOf,
                         ::testing::Values(Kind{"ordinary", 1, 10, 1.05, 4},
                                           Kind{"close", 1, 5, 1.0001, 1.01}, Kind{"distant", 1, 10, 10, 1e6},
                                           Kind{"thin", 1e-2, 1, 1.1, 3}),
                         [](const auto& kind) { return std::string(kind.param.name); });

// The exact rung knows them to be apart where the contact function, in floating point, does not.
TEST(ConeBounds, OfBodiesCloserThanRounding) {
  RandomBodies random(584);
  SCOPED_TRACE(random.trace());
  int cases = 0, unseen = 0;
  for (int i = 0; i < share(800); ++i) {
    const auto [a, b] = random.scaled_from_touching(1, 10, 1 + random.uniform(-3e-16, 6e-16));
    const int count = random.integer(3, 64);
    if (relation(a, b) != Relation::disjoint) continue;
    SCOPED_TRACE("case " + std::to_string(i) + ", " + std::to_string(count) + " samples");
    ++cases;
    unseen += !(ContactFrame<3>(a, b).contact > 1);
    const TrueCone cone = true_cone(a, b, count);
    const Vector3d normal = ContactFrame<3>(a, b).separating_normal().normalized();
    for (const BoundarySample& s : cone.boundary) {
      ASSERT_NEAR(s.direction.norm(), 1, 1e-14);
      ASSERT_NEAR(s.direction.dot(normal), 0, 1e-5) << "nearly the half-space of the common normal";
      ASSERT_LT((s.normal - normal).norm(), 1e-5);
    }
    ASSERT_TRUE(std::isfinite(cone.solid_angle));
    const ConeBounds bounds = cone_bounds(cone, a, b);
    const ConeOracle oracle(a, b);
    for (const Vector3d& d : bounds.inner.directions) ASSERT_EQ(oracle.membership(d), Membership::in);
    ASSERT_LE(bounds.inner.solid_angle, 2 * pi);
    ASSERT_LE(bounds.outer.solid_angle, 2 * pi);
    ASSERT_NEAR(bounds.outer.solid_angle, 2 * pi, 1e-5);
    ASSERT_GE(bounds.solid_angle + bounds.solid_angle_error, 2 * pi - 1e-5);
    ASSERT_LE(bounds.solid_angle - bounds.solid_angle_error, 2 * pi);
  }
  EXPECT_GT(cases, share(300));
  EXPECT_GT(unseen, share(40));
}

TEST(ConeBounds, GapFallsWithTheSquareOfTheSamples) {
  RandomBodies random(583);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 100; ++i) {
    const auto [a, b] = random.separated_along_centers(1, 4, random.uniform(1.5, 3));
    double last = 0;
    for (const int samples : {64, 128, 256}) {
      const ConeBounds bounds = cone_bounds(true_cone(a, b, samples), a, b);
      const double width = bounds.outer.solid_angle - bounds.inner.solid_angle;
      ASSERT_GT(width, 0);
      if (last > 0) {
        ASSERT_NEAR(last / width, 4, 0.4) << "case " << i;
      }
      last = width;
    }
  }
}

}  // namespace
}  // namespace vericone::cone_bounds_test
