// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/lidar/visible_part.h>

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

}  // namespace
}  // namespace vericone::lidar::visible_part_test
