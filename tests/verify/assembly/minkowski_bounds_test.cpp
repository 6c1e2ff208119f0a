// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <vericone/internal/verify/seeded_random.h>
#include <vericone/internal/verify/spatial/minkowski_bounds.h>
#include <vericone/verify/spatial/campaign.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
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

/// In every direction the sum reaches as far as both bodies together, and it has no other vertices than sums
/// of theirs. Points and directions on grids: nothing is rounded. The campaigns ask CGAL's Nef polyhedra.
TEST(MinkowskiSum, ReachesAsFarAsBothBodies) {
  SeededRandom random(421, 1, 0);
  const auto cloud = [&](int count) {
    std::vector<Vector3d> points;
    for (int i = 0; i < count; ++i)
      points.push_back((random.direction<3>() * 0x1p20).array().round() * 0x1p-20);
    return points;
  };
  const std::vector<Vector3d> first = cloud(12), second = cloud(20),
                              sum = minkowski_sum_vertices(first, second);
  const auto farthest = [](const std::vector<Vector3d>& points, const Vector3d& n) {
    double most = points.front().dot(n);
    for (const Vector3d& p : points) most = std::max(most, p.dot(n));
    return most;
  };
  std::vector<bool> reached(sum.size());
  for (int k = 0; k < 20'000; ++k) {
    const Vector3d n = (random.direction<3>() * 0x1p10).array().round();
    const double most = farthest(sum, n);
    ASSERT_EQ(most, farthest(first, n) + farthest(second, n)) << n.transpose();
    for (std::size_t i = 0; i < sum.size(); ++i) reached[i] = reached[i] || sum[i].dot(n) == most;
  }
  EXPECT_GT(sum.size(), 40);
  // All but vertices that nearly are none.
  EXPECT_GT(std::count(reached.begin(), reached.end(), true), 0.9 * static_cast<double>(sum.size()));
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
