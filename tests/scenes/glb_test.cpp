// SPDX-License-Identifier: BSD-3-Clause
//
// Surfaces for GLB files: hulls against closed forms and against the points, and what a file refuses. What
// the files hold: tests/cli/glb_test.py.
#include <gtest/gtest.h>
#include <vericone/geometry/error.h>
#include <Eigen/Geometry>
#include <cmath>
#include <map>

#include "glb/body_surface.h"
#include "glb/glb_file.h"
#include "glb/hull_surface.h"
#include "support/random.h"

namespace vericone::glb_test {
namespace {

using Eigen::Vector3d;
using glb::Drawn;

double volume(const Drawn& drawn) {
  double sum = 0;
  for (const auto& t : drawn.triangles)
    sum += drawn.points[t[0]].dot(drawn.points[t[1]].cross(drawn.points[t[2]])) / 6;
  return sum;
}

double area(const Drawn& drawn) {
  double sum = 0;
  for (const auto& t : drawn.triangles)
    sum +=
        (drawn.points[t[1]] - drawn.points[t[0]]).cross(drawn.points[t[2]] - drawn.points[t[0]]).norm() / 2;
  return sum;
}

void expect_closed(const Drawn& drawn) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& t : drawn.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(edges.count({edge.second, edge.first}), 1U);
  }
  EXPECT_EQ(drawn.points.size() + drawn.triangles.size() - edges.size() / 2, 2U);
}

TEST(HullSurface, HoldsAllPointsAndHasTheirs) {
  testing::Random random(40);
  for (const int count : {4, 5, 8, 30, 300, 5000}) {
    std::vector<Vector3d> points;
    for (int i = 0; i < count; ++i)
      points.emplace_back(random.normal(), 2 * random.normal(), 1000 + random.normal());
    const Drawn drawn = glb::hull_surface(points);
    expect_closed(drawn);
    EXPECT_GT(volume(drawn), 0);
    double farthest_out = 0;
    for (const auto& t : drawn.triangles) {
      const Vector3d n =
          (drawn.points[t[1]] - drawn.points[t[0]]).cross(drawn.points[t[2]] - drawn.points[t[0]]);
      if (n.norm() < 1e-9) continue;
      for (const Vector3d& x : points)
        farthest_out = std::max(farthest_out, n.normalized().dot(x - drawn.points[t[0]]));
    }
    EXPECT_LE(farthest_out, count <= 2000 ? 1e-8 : 0.2) << count;
  }
}

TEST(HullSurface, OfFlatPointsIsTheirPolygon) {
  const Drawn square =
      glb::hull_surface({{0, 0, 1}, {2, 0, 1}, {2, 2, 1}, {0, 2, 1}, {1, 1, 1}, {1, 0, 1}, {2, 2, 1}});
  EXPECT_DOUBLE_EQ(area(square), 4);
  EXPECT_EQ(square.triangles.size(), 2U);
  const Drawn line = glb::hull_surface({{0, 0, 0}, {1, 1, 1}, {3, 3, 3}});
  EXPECT_TRUE(line.line && line.triangles.empty());
  EXPECT_EQ((line.points[1] - line.points[0]).norm(), std::sqrt(27.));
  EXPECT_EQ(glb::hull_surface({{1, 2, 3}, {1, 2, 3}}).points.size(), 1U);
}

TEST(BodySurface, OfFlatBodiesHasTheirArea) {
  EXPECT_NEAR(area(glb::body_surface(Convex::disc(2), Vector3d::Zero())), 4 * M_PI, 0.1);
  const CombinedEllipse ellipse = Ellipse::from_axes({3, 4}, {2, 1}, Eigen::Matrix2d::Identity());
  EXPECT_NEAR(area(glb::flat_surface(ellipse)), 2 * M_PI, 0.01);
}

TEST(BodySurface, OfDentedBodiesIsThatOfTheirQuadrics) {
  const CombinedEllipsoid dented(Ellipsoid::from_axes({1, 2, 3}, {3, 2, 1}, Eigen::Matrix3d::Identity()),
                                 {hyperboloid(2, {1, 1, 1}, Eigen::Matrix3d::Identity())});
  const Drawn drawn = glb::body_surface(dented, dented.center());
  EXPECT_GT(drawn.triangles.size(), 500U);
  for (const Vector3d& x : drawn.points) EXPECT_NEAR(dented.gauge(x), 1, 1e-9);
}

TEST(GlbFile, RefusesWhatNoFloatHolds) {
  glb::GlbFile file(nullptr);
  EXPECT_THROW(file.mesh("x", {{{1e39, 0, 0}}, {}}, glb::color_of(0)), InputError);
  EXPECT_THROW(file.node("x", 0, {{0, 1e300, 0}, Eigen::Matrix3d::Identity()}), InputError);
}

}  // namespace
}  // namespace vericone::glb_test
