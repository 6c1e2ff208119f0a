// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <vericone/verify/minkowski_bounds.h>
#include <vericone/verify/seeded_random.h>
#include <vericone/verify/spatial_families.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>
#include <numbers>

namespace vericone::verify::minkowski_bounds_test {
namespace {

using Eigen::Vector3d;
constexpr double kPi = std::numbers::pi;

TEST(GeodesicSphere, IsAClosedSurfaceSeenFromOutside) {
  for (int level = 0; level < 3; ++level) {
    const GeodesicSphere sphere(level);
    EXPECT_EQ(sphere.vertices.size(), 10u * (1u << (2 * level)) + 2);
    EXPECT_EQ(sphere.facets.size(), 2 * sphere.vertices.size() - 4);  // Euler
    double volume = 0;
    for (const Eigen::Vector3i& f : sphere.facets) {
      Eigen::Matrix3d m;
      m << sphere.vertices[f(0)], sphere.vertices[f(1)], sphere.vertices[f(2)];
      EXPECT_GT(m.determinant(), 0);
      volume += m.determinant() / 6;
    }
    EXPECT_LT(volume, 4 * kPi / 3);
    EXPECT_GT(volume, 2.5);
  }
}

TEST(MinkowskiSum, OfTwoBoxesIsABox) {
  std::vector<Vector3d> box;
  for (const double x : {-1, 1})
    for (const double y : {-2, 2})
      for (const double z : {-3, 3}) box.emplace_back(x, y, z);
  const std::vector<Vector3d> sum = minkowski_sum_vertices(box, box);
  ASSERT_EQ(sum.size(), 8);
  for (const Vector3d& p : sum) EXPECT_EQ(p.cwiseAbs(), Vector3d(2, 4, 6));
}

TEST(MinkowskiBounds, ConesOfSpheresAreRight) {
  // The cone of two spheres has the half opening asin((r1 + r2) / d).
  for (std::uint64_t index = 0; index < 20; ++index) {
    SCOPED_TRACE(index);
    const auto [a, b] = spatial_pair(SpatialFamily::spheres, 3, index);
    const Vector3d c = b.center() - a.center();
    const double sine = (a.semi_axes().x() + b.semi_axes().x()) / c.norm();
    const auto cap = [](double s) { return 2 * kPi * (1 - std::sqrt(1 - s * s)); };
    for (int level = 1; level < 3; ++level) {
      const MinkowskiBounds bounds = minkowski_bounds(a, b, level);
      EXPECT_LT(bounds.scale, level == 1 ? 1.08 : 1.02);
      EXPECT_LT(bounds.inner.solid_angle(), cap(sine));
      EXPECT_GT(bounds.inner.solid_angle(), cap(sine / bounds.scale));
      EXPECT_GT(bounds.outer.solid_angle(), cap(sine));
      EXPECT_LT(bounds.outer.solid_angle(), cap(sine * bounds.scale));
      SeededRandom random(410, 3, index);
      for (int i = 0; i < 50; ++i) {
        const double aside = random.uniform(0, 2);
        const Vector3d w = c.normalized() + aside * random.direction<3>();
        const double off = std::atan2(w.cross(c).norm(), w.dot(c));
        if (bounds.inner.contains(w)) {
          EXPECT_LT(off, std::asin(sine));
        }
        if (!bounds.outer.contains(w)) {
          EXPECT_GT(off, std::asin(sine));
        }
      }
    }
  }
}

TEST(MinkowskiBounds, EdgesAreInTheClosedConeAndStepsOutsideAreNot) {
  for (std::uint64_t index = 0; index < 20; ++index) {
    SCOPED_TRACE(index);
    const auto [a, b] = spatial_pair(SpatialFamily::regular, 3, index);
    const MinkowskiBounds bounds = minkowski_bounds(a, b, 1);
    const Vector3d c = (b.center() - a.center()).normalized();
    EXPECT_TRUE(bounds.inner.contains(c));
    EXPECT_FALSE(bounds.outer.contains(-c));
    EXPECT_FALSE(bounds.outer.contains(Vector3d::Zero()));
    for (const Vector3d& e : bounds.inner.edges()) {
      EXPECT_TRUE(bounds.inner.contains(e + 1e-12 * (c - e)));
      EXPECT_FALSE(bounds.inner.contains(e - 1e-12 * (c - e)));
      EXPECT_TRUE(bounds.outer.contains(e));
    }
  }
}

TEST(MinkowskiBounds, NearBodiesHaveNoOuterCone) {
  const Ellipsoid a = Ellipsoid::from_axes({0, 0, 0}, {1, 1, 1}),
                  b = Ellipsoid::from_axes({2.001, 0, 0}, {1, 1, 1});
  const MinkowskiBounds bounds = minkowski_bounds(a, b, 1);
  EXPECT_FALSE(bounds.inner.everything());
  EXPECT_TRUE(bounds.outer.everything());
  EXPECT_EQ(bounds.outer.solid_angle(), 4 * kPi);
  EXPECT_TRUE(bounds.outer.contains({-1, 0, 0}));
}

}  // namespace
}  // namespace vericone::verify::minkowski_bounds_test
