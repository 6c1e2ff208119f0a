// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vericone/cones/slices/visible_cone.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/slices/visible_sector.h>
#include <vericone/testing/random_bodies.h>

#include <cmath>
#include <numbers>

#include "geometry/meshes.h"

namespace vericone::visible_cone_test {
namespace {

using Eigen::Vector3d;
using testing::Mesh;
using testing::RandomBodies;

TEST(VisibleCone, MeshOfAnEllipsoidGivesTheSlicesOfTheEllipsoid) {
  RandomBodies random(7701);
  SCOPED_TRACE(random.trace());
  const Mesh coarse = testing::sphere(3), fine = testing::sphere(5);
  for (int i = 0; i < 20; ++i) {
    const auto [a, b] = random.scaled_from_touching(0.5, 2, random.uniform(1.5, 3));
    const SliceCone exact = slice_cone(a, b, 12);
    double off[2];
    for (int k = 0; k < 2; ++k) {
      const Mesh mesh = (k ? fine : coarse).mapped(b.factor(), b.center());
      const Mesh agent_mesh = (k ? fine : coarse).mapped(a.factor(), a.center());
      const VisibleCone cone =
          visible_cone(a, mesh_section_points(mesh.points, mesh.triangles), b.center(), 12);
      const VisibleCone direct = visible_cone(a, mesh_section_points(mesh.points, mesh.triangles), b.center(),
                                              12, {.search = {}, .by_search = false});
      // The agent as a mesh too (6.3.4).
      const VisibleCone both =
          visible_cone(a.center(), mesh_section_points(agent_mesh.points, agent_mesh.triangles),
                       mesh_section_points(mesh.points, mesh.triangles), b.center(), 12);
      off[k] = 0;
      ASSERT_EQ(cone.planes.size(), 12U);
      EXPECT_EQ(cone.planes_without_answer() + both.planes_without_answer(), 0U);
      for (int j = 0; j < 12; ++j) {
        const Slice &expected = exact.slices[j], &got = *cone.planes[j].slice;
        EXPECT_NEAR(got.azimuth, expected.azimuth, 1e-15);
        for (const double missing :
             {expected.left - got.left, expected.right - got.right, got.left - both.planes[j].slice->left,
              got.right - both.planes[j].slice->right}) {
          EXPECT_GT(missing, -1e-12);  // inscribed
          off[k] = std::max(off[k], missing);
        }
        EXPECT_NEAR(direct.planes[j].slice->left, got.left, 1e-11);
        EXPECT_NEAR(direct.planes[j].slice->right, got.right, 1e-11);
      }
      EXPECT_LE(cone.polyhedral().solid_angle, exact.polyhedral().solid_angle * (1 + 1e-12));
    }
    // Edges a quarter as long: a sixteenth of the error, up to chance.
    EXPECT_LT(off[1], off[0] / 4);
    EXPECT_LT(off[1], 3e-3);
  }
}

TEST(VisibleCone, PointsNearAPlaneConvergeWithTheirNumber) {
  // Both balls: the cone is known, asin((r + s) / d) on every plane.
  const Ellipsoid agent = Ellipsoid::from_axes({1, 2, 3}, {0.5, 0.5, 0.5});
  const Vector3d center(5, 2, 3);
  const double exact = std::asin(1.5 / 4);
  for (const int times : {3, 4, 5, 6}) {
    const Mesh ball = testing::sphere(times).mapped(Eigen::Matrix3d::Identity(), center);
    const double edge = 1.1 / std::pow(2, times);
    const VisibleCone cone = visible_cone(agent, points_near_plane(ball.points, 0.5 * edge), center, 12);
    double worst = 0;
    ASSERT_EQ(cone.planes_without_answer(), 0U);
    for (const VisiblePlane& plane : cone.planes)
      worst = std::max({worst, std::abs(plane.slice->left - exact), std::abs(plane.slice->right - exact)});
    EXPECT_LT(worst, 0.6 * edge * edge) << times;  // quadratic: the tangents touch where the slope is nil
  }
}

TEST(VisibleCone, PlanesWithoutAnswerAreSaid) {
  const Ellipsoid agent = Ellipsoid::from_axes({0, 0, 0}, {1, 1, 1});
  // Points of one plane only.
  const std::vector<Vector3d> cloud{{4, -1, 0}, {4, 0, 0}, {4, 1, 0}};
  const VisibleCone cone = visible_cone(agent, points_near_plane(cloud, 0.01), {4, 0, 0}, 4);
  EXPECT_EQ(cone.planes_without_answer(), 0U);  // the middle one is on the axis
  const std::vector<Vector3d> off{{4, -1, 0}, {4, 1, 0}};
  const VisibleCone gaps = visible_cone(agent, points_near_plane(off, 0.01), {4, 0, 0}, 4);
  EXPECT_EQ(gaps.planes_without_answer(), 3U);
  for (const VisiblePlane& plane : gaps.planes)
    if (!plane.slice) {
      EXPECT_EQ(plane.reason, NoSector::no_points);
    }
  EXPECT_TRUE(std::isnan(gaps.polyhedral().solid_angle));
  const std::vector<Vector3d> inside{{0.5, 0, 0}};
  EXPECT_EQ(visible_cone(agent, points_near_plane(inside, 0.01), {4, 0, 0}, 1).planes[0].reason,
            NoSector::inside_agent);
  EXPECT_THROW(visible_cone(agent, points_near_plane(off, 0.01), {0, 0, 0}, 4), InputError);
  EXPECT_THROW(visible_cone(agent, points_near_plane(off, 0.01), {4, 0, 0}, 0), InputError);
  EXPECT_NEAR(slab_half_thickness(off, {0, 0, 0}, 0.01), 0.005 * std::sqrt(17), 1e-15);
}

}  // namespace
}  // namespace vericone::visible_cone_test
