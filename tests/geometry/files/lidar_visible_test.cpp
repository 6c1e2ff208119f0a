// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/lidar/lidar.h>

#include <cmath>
#include <numbers>

#include "geometry/meshes.h"

namespace vericone::lidar::visible_part_test {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

Lidar at(const Vector3d& position) {
  Lidar lidar;
  lidar.pose.translation() = position;
  lidar.beams = raster(3, 3, pi / 2, pi / 2);
  return lidar;
}

SurfacePart seen(const testing::Mesh& mesh, const std::vector<Lidar>& lidars,
                 const Eigen::Isometry3d& agent = Eigen::Isometry3d::Identity()) {
  return visible_part(MeshScene(mesh.points, mesh.triangles), mesh.points, mesh.triangles, lidars, agent,
                      0.02);
}

/// Of a ball of radius 1 an eye at the distance d sees the cap 2 pi (1 - 1/d).
TEST(VisiblePart, OfABallIsTheCapThatFacesTheSensor) {
  const testing::Mesh ball = testing::sphere(5);
  for (const double d : {2.0, 4.0, 20.0}) {
    const SurfacePart part = seen(ball, {at(Vector3d(-d, 0, 0))});
    EXPECT_NEAR(part.area, 2 * pi * (1 - 1 / d), 0.02 * 4 * pi) << d;
    for (const Vector3d& p : part.points) EXPECT_LT(p.x(), -1 / d + 0.05);
  }
}

TEST(VisiblePart, TwoSensorsSeeWhatEitherSees) {
  const testing::Mesh ball = testing::sphere(4);
  Lidar behind = at(Vector3d(4, 0, 0));
  behind.pose.linear() = Eigen::AngleAxisd(pi, Vector3d::UnitZ()).toRotationMatrix();
  const double before = seen(ball, {at(Vector3d(-4, 0, 0))}).area, after = seen(ball, {behind}).area;
  EXPECT_NEAR(seen(ball, {at(Vector3d(-4, 0, 0)), behind}).area, before + after, 1e-9);
}

TEST(VisiblePart, IsNothingBehindSomethingOutOfRangeOrOutsideTheView) {
  const testing::Mesh ball = testing::sphere(3);
  testing::Mesh hidden = ball;
  hidden.append(ball.mapped(3 * Eigen::Matrix3d::Identity(), Vector3d(-8, 0, 0)));
  const std::vector<Lidar> lidars{at(Vector3d(-20, 0, 0))};
  for (const Vector3d& p : seen(hidden, lidars).points) EXPECT_LT(p.x(), -5);
  Lidar short_sighted = lidars[0];
  short_sighted.max_range = 18;
  EXPECT_EQ(seen(ball, {short_sighted}).area, 0);
  const Eigen::Isometry3d away(Eigen::Translation3d(0, 100, 0));
  EXPECT_EQ(seen(ball, lidars, away).area, 0);
  EXPECT_GT(seen(ball, lidars).area, 0);
}

/// A rectangle of n x n squares, each of two triangles.
testing::Mesh wall(const Vector3d& corner, const Vector3d& u, const Vector3d& v, int n) {
  testing::Mesh m;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) m.points.emplace_back(corner + (i * u + j * v) / n);
  const auto at = [&](int i, int j) { return std::uint32_t(i * (n + 1) + j); };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      m.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      m.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return m;
}

testing::Mesh room(int n) {
  testing::Mesh m;
  for (int k = 0; k < 3; ++k)
    for (const double side : {-1.0, 1.0}) {
      Vector3d corner(-5, -4, -1.5), u = Vector3d::Zero(), v = Vector3d::Zero();
      const Vector3d size = -2 * corner;
      u((k + 1) % 3) = size((k + 1) % 3);
      v((k + 2) % 3) = size((k + 2) % 3);
      if (side > 0) corner(k) = -corner(k);
      m.append(wall(corner, u, v, n));
    }
  return m;
}

/// A post before a wall.
testing::Mesh post(int n) {
  testing::Mesh m = wall({4, -3, -3}, {0, 6, 0}, {0, 0, 6}, 4 * n);
  m.append(wall({1, -0.1, -3}, {0, 0.2, 0}, {0, 0, 6}, n));
  return m;
}

double distance_to(const SurfacePart& part, const Vector3d& x) {
  double least = 1e300;
  for (const auto& t : part.triangles) {
    const Vector3d &a = part.points[t[0]], u = part.points[t[1]] - a, v = part.points[t[2]] - a,
                   normal = u.cross(v);
    const double whole = normal.squaredNorm(), at_u = (x - a).cross(v).dot(normal) / whole,
                 at_v = u.cross(x - a).dot(normal) / whole;
    if (at_u > -1e-9 && at_v > -1e-9 && at_u + at_v < 1 + 1e-9)
      least = std::min(least, std::abs((x - a).dot(normal)) / normal.norm());
  }
  return least;
}

/// All that beams hit is there, and how the surface is cut into triangles changes the rim only.
TEST(VisiblePart, DoesNotDependOnTheTriangles) {
  Lidar rings = at(Vector3d(0.5, 0.25, 0));
  rings.beams = spinning({-0.2, 0, 0.2}, 360);
  Lidar narrow = at(Vector3d::Zero());
  narrow.beams = raster(21, 21, 0.6, 0.6);
  Lidar far_only = narrow;
  far_only.min_range = 1.5;
  struct Case {
    testing::Mesh coarse, fine;
    Lidar lidar;
  };
  for (const Case& c :
       {Case{room(1), room(30), rings}, Case{post(1), post(20), narrow}, Case{post(1), post(20), far_only},
        Case{wall({1.5, -50, -50}, {0, 100, 0}, {0, 0, 100}, 1),
             wall({1.5, -2, -2}, {0, 4, 0}, {0, 0, 4}, 60), narrow}}) {
    const SurfacePart coarse = seen(c.coarse, {c.lidar}), fine = seen(c.fine, {c.lidar});
    EXPECT_NEAR(coarse.area / fine.area, 1, 0.05);
    EXPECT_LT(coarse.triangles.size(), 2 * fine.triangles.size() + 20'000);
    const Scan scan = lidar::scan(MeshScene(c.coarse.points, c.coarse.triangles), c.lidar,
                                  Eigen::Isometry3d::Identity(), 1);
    EXPECT_GT(scan.returns.size(), 200U);
    for (std::size_t i = 0; i < scan.returns.size(); i += 7)
      ASSERT_LT(distance_to(coarse, scan.returns[i].in_world), 1e-9);
  }
}

/// Of the wall behind the post the middle is hidden, although its triangles' corners and middles are not.
TEST(VisiblePart, LeavesOutWhatIsHiddenWithinATriangle) {
  Lidar lidar = at(Vector3d::Zero());
  lidar.beams = raster(21, 21, 0.6, 0.6);
  for (const auto& p : seen(post(1), {lidar}).points)
    if (p.x() > 3) {
      EXPECT_GT(std::abs(p.y()), 0.4 - 0.03);
    }
}

}  // namespace
}  // namespace vericone::lidar::visible_part_test
