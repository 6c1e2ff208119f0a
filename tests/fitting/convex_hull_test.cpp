// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/fitting/convex_hull.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/meshes.h"
#include "support/random.h"

namespace vericone::fitting::convex_hull_test {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;
using testing::Random;

double support(const std::vector<Vector3d>& points, const Vector3d& direction) {
  double most = -1e300;
  for (const Vector3d& p : points) most = std::max(most, p.dot(direction));
  return most;
}

/// Everything that makes it the hull: closed, seen from outside, no point beyond a facet, and as wide as the
/// points in every direction. `factor` takes points that are about round to these.
void expect_hull(const std::vector<Vector3d>& points, const ConvexHull& hull, const Matrix3d& factor,
                 Random& random) {
  ASSERT_TRUE(std::is_sorted(hull.vertices.begin(), hull.vertices.end()));
  ASSERT_EQ(hull.triangles.size(), 2 * hull.vertices.size() - 4);  // Euler's formula for a sphere
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> passed;
  for (const auto& t : hull.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++passed[{t[k], t[(k + 1) % 3]}];
  for (const auto& [edge, times] : passed) {
    EXPECT_EQ(times, 1);
    EXPECT_EQ(passed.count({edge.second, edge.first}), 1);
  }
  // Where the points are as round as they can be made.
  const Matrix3d to_round = factor.inverse();
  std::vector<Vector3d> all, corners;
  for (const Vector3d& p : points) all.push_back(to_round * (p - points[0]));
  for (const std::uint32_t v : hull.vertices) corners.push_back(all[v]);
  for (int k = 0; k < 2000; ++k) {
    const Vector3d n = random.vector<3>().normalized();
    EXPECT_NEAR(support(corners, n), support(all, n), 1e-9);
  }
  for (std::size_t t = 0; t < hull.triangles.size(); t += 1 + hull.triangles.size() / 100) {
    const auto [a, b, c] = hull.triangles[t];
    const Vector3d normal = (all[b] - all[a]).cross(all[c] - all[a]);
    if (normal.norm() < 1e-6) continue;  // a sliver has no direction
    EXPECT_LT(support(all, normal.normalized()) - all[a].dot(normal.normalized()), 1e-8);
  }
}

TEST(ConvexHull, HasTheWidthsOfItsPoints) {
  for (int k = 0; k < 12; ++k) {
    Random random(700 + static_cast<std::uint64_t>(k));
    SCOPED_TRACE(random.trace());
    Matrix3d factor = random.rotation<3>() * Vector3d(1, 0.4, k % 3 == 2 ? 1e-5 : 0.2).asDiagonal();
    factor *= std::pow(10, random.uniform(-3, 3));
    const Vector3d center = 10 * factor.norm() * random.vector<3>();
    std::vector<Vector3d> points;
    const int count = random.integer(4, 3000);
    for (int i = 0; i < count; ++i) {
      Vector3d x = random.vector<3>();
      if (k % 2) x.normalize();
      points.emplace_back(center + factor * x);
    }
    expect_hull(points, convex_hull(points), factor, random);
  }
}

TEST(ConvexHull, OfSolidsWithFacetsOfManyCorners) {
  Random random(720);
  // A cube with points all over it and its inside.
  std::vector<Vector3d> grid;
  for (int i = 0; i <= 10; ++i)
    for (int j = 0; j <= 10; ++j)
      for (int k = 0; k <= 10; ++k) grid.emplace_back(i, j, k);
  const ConvexHull cube = convex_hull(grid);
  EXPECT_EQ(cube.vertices.size(), 8);
  EXPECT_NEAR(cube.volume, 1000, 1e-9);
  expect_hull(grid, cube, 10 * Matrix3d::Identity(), random);

  // A prism over a regular polygon: two facets of 60 corners.
  std::vector<Vector3d> prism;
  for (int k = 0; k < 60; ++k)
    for (const double z : {0.0, 3.0})
      prism.emplace_back(std::cos(k * std::numbers::pi / 30), std::sin(k * std::numbers::pi / 30), z);
  const ConvexHull hull = convex_hull(prism);
  EXPECT_EQ(hull.vertices.size(), 120);
  EXPECT_NEAR(hull.volume, 3 * 30 * std::sin(std::numbers::pi / 30), 1e-12);

  const ConvexHull icosahedron = convex_hull(testing::sphere(0).points);
  const double edge = 1 / std::sin(2 * std::numbers::pi / 5);
  EXPECT_NEAR(icosahedron.volume, 5.0 / 12 * (3 + std::sqrt(5)) * edge * edge * edge, 1e-14);
}

TEST(ConvexHull, RepeatedPointsChangeNothing) {
  Random random(730);
  std::vector<Vector3d> points;
  for (int i = 0; i < 300; ++i) points.push_back(random.vector<3>());
  const ConvexHull once = convex_hull(points);
  std::vector<Vector3d> twice = points;
  twice.insert(twice.end(), points.begin(), points.end());
  const ConvexHull again = convex_hull(twice);
  EXPECT_EQ(again.vertices.size(), once.vertices.size());
  EXPECT_NEAR(again.volume, once.volume, 1e-13 * once.volume);
}

TEST(ConvexHull, VolumeOfATetrahedronFarAway) {
  // Coordinates that are exact far away.
  for (const double far : {0.0, 1048576.0}) {
    const Vector3d at(far, -far, 2 * far);
    EXPECT_DOUBLE_EQ(
        convex_hull({at, at + Vector3d(1, 0, 0), at + Vector3d(0, 2, 0), at + Vector3d(0, 0, 4)}).volume,
        8.0 / 6);
  }
}

TEST(ConvexHull, RefusesFlatPoints) {
  const auto field = [](const std::vector<Vector3d>& points) -> std::string {
    try {
      convex_hull(points);
    } catch (const InputError& error) {
      return error.field();
    }
    return "none";
  };
  EXPECT_EQ(field({}), "points");
  EXPECT_EQ(field({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), "points");
  EXPECT_EQ(field({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.3, 0.2, 0}}), "points");
  EXPECT_EQ(field({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {5, 5, 5}}), "points");
  EXPECT_EQ(field(std::vector<Vector3d>(10, Vector3d(1, 2, 3))), "points");
  EXPECT_EQ(field({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, NAN}}), "points");
  EXPECT_EQ(field({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}), "none");
}

}  // namespace
}  // namespace vericone::fitting::convex_hull_test
