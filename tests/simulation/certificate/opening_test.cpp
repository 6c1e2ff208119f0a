// SPDX-License-Identifier: BSD-3-Clause
//
// Holes in walls that certificates state in place of openings: within them, around their middles, where the
// openings are; and points of bodies with the weights that say so. tests/cli/certify/bodies_test.py has
// whole certificates read by the checker.
#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <cmath>
#include <string>
#include <vector>

#include "certificate/near_points.h"
#include "certificate/opening.h"
#include "certificate/solid.h"
#include "certificate/tube.h"
#include "simulation/moving_pairs.h"
#include "simulation/random.h"

namespace vericone::simulation::opening_test {
namespace {

using namespace certified;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Corners and middles of edges are in the opening, and the ring's outer edge beyond what is cut off.
void expect_within(const Opening& opening) {
  const auto hole = star_shaped_within(opening);
  ASSERT_TRUE(hole);
  const std::size_t n = hole->outline.size();
  double turned = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const Vector2d &v = hole->outline[k], &next = hole->outline[(k + 1) % n];
    EXPECT_GT(opening.depth(hole->center + v), 0);
    EXPECT_GE(opening.depth(hole->center + 0.5 * (v + next)), 0);
    EXPECT_GT(cross(v, next), 0);
    EXPECT_GE(cross(v, next), hole->inner * (next - v).norm() * (1 - 1e-12));
    turned += std::atan2(cross(v, next), v.dot(next));
    // What is beyond the outer edge is outside of the opening: the rim is in the ring.
    EXPECT_LT(opening.depth(hole->center + kRim * v), 0);
    EXPECT_LE(opening.depth(hole->center + 0.5 * kRim * (v + next)), 1e-12);
  }
  EXPECT_NEAR(turned, 2 * M_PI, 1e-9);
  const Solid solid = ring(*hole, 8);
  ASSERT_EQ(solid.size(), n);
  for (std::size_t k = 0; k < n; ++k) {  // as the format says, exactly
    const Vector2d corner = solid.points[solid.pieces[k][3]].head<2>();
    EXPECT_EQ(corner, Vector2d(8 * hole->outline[k]));
    EXPECT_EQ(solid.points[solid.pieces[k][0]].head<2>(), hole->outline[k]);
  }
}

TEST(OpeningCertificate, HolesAreWithinOpenings) {
  Random random(51);
  expect_within(Opening::circle(0.37));
  expect_within(Opening::ellipse({3, 0.1}));
  expect_within(Opening::polygon({{-0.9, -0.6}, {0.9, -0.6}, {0.9, 0.6}, {0, 0.2}, {-0.9, 0.6}}));
  expect_within(Opening::polygon({{0, 0}, {2, 0}, {2, 1}, {0, 1}}));  // about its deepest point
  for (int i = 0; i < 100; ++i) {
    std::vector<Vector2d> star;
    const int n = 3 + i % 9;
    for (int k = 0; k < n; ++k) {
      const double angle = 2 * M_PI * (k + random.uniform(-0.2, 0.2)) / n;
      star.push_back(random.uniform(0.3, 2) * Vector2d(std::cos(angle), std::sin(angle)));
    }
    expect_within(Opening::polygon(star));
  }
}

TEST(OpeningCertificate, OfAnOutlineThatIsNotStarShapedThereIsNone) {
  EXPECT_FALSE(
      star_shaped_within(Opening::polygon({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 3}, {3, 3}, {3, 1}, {0, 1}})));
}

TEST(OpeningCertificate, TheHoleMovesAsTheOpening) {
  Random random(52);
  for (int i = 0; i < 30; ++i) {
    MovingOrifice orifice;
    orifice.opening = i % 2 ? Opening::ellipse({1, 0.4}) : Opening::polygon({{1, 1}, {3, 1}, {3, 2}, {1, 2}});
    orifice.position = random.vector(3);
    orifice.velocity = random.vector(1);
    orifice.rotation = random.rotation();
    if (i % 2) orifice.spin = random.vector(0.3);
    orifice.appears = 2;
    const auto hole = star_shaped_within(orifice.opening);
    ASSERT_TRUE(hole);
    const auto track = hole_track(orifice, *hole, 9);
    ASSERT_TRUE(track);
    for (double t = 2; t <= 9; t += 0.5) {
      const PlacedOpening now = orifice.at(t).opening;
      const Motion at = track->motion(t);
      EXPECT_LT((now.at(hole->center) - at.position).norm(), 1e-11);
      EXPECT_LT((now.normal() - at.rotation.col(2)).norm(), 1e-11);
      EXPECT_LT((now.axes - at.rotation.leftCols<2>()).norm(), 1e-11);
    }
    orifice.spin = {0, 0, 1};
    EXPECT_EQ(hole_track(orifice, *hole, 9).has_value(), i % 2 == 1);  // not about a point beside its origin
  }
}

/// Two capsules, whose distance is that of their segments less both radii.
TEST(NearPoints, AreAsFarApartAsTheBodies) {
  const ShapeInTime capsule = RigidShape{Placed(vericone::Convex::capsule(0.25, 2))};
  const Track a(capsule, {{0, 0, 0}, {0, 0, 0}, Matrix3d::Identity()}, Orientation::fixed, 0);
  Track b(capsule,
          {{1.5, 0, 0}, {0, 0, 0}, Eigen::AngleAxisd(M_PI / 2, Vector3d::UnitX()).toRotationMatrix()},
          Orientation::fixed, 0);
  const Solid solid = in_own_frame(capsule, 0, 1).solid;
  const TubeQuestion asked{0, 1, 1e-4, 1.5, true, 1e-8};
  const auto of_a = tube(a, asked), of_b = tube(b, asked);
  const double radii = of_a->radius + of_b->radius;
  const auto found = near_points({solid, solid, *of_a, *of_b, 1.1, 0, 1}, 0.5);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->room, 1.1 - (1.5 - 0.5) - radii, 1e-7);
  EXPECT_NE(found->proof.find("agent_weights"), std::string::npos);
  EXPECT_LT(near_points({solid, solid, *of_a, *of_b, 0.99, 0, 1}, 0.5)->room, 0);
  // Into each other by 0.1: half of that is the ball's radius about the common point, in each.
  Track c(capsule, {{0.4, 0, 0}, {0, 0, 0}, b.motion(0).rotation}, Orientation::fixed, 0);
  const auto of_c = tube(c, asked);
  const auto inside = near_points({solid, solid, *of_a, *of_c, 0, 0, 1}, 0.5);
  ASSERT_TRUE(inside);
  EXPECT_NEAR(inside->room, 0.1 - of_a->radius - of_c->radius, 1e-7);
  EXPECT_NE(inside->proof.find("agent_depth"), std::string::npos);
}

}  // namespace
}  // namespace vericone::simulation::opening_test
