// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/cones/mesh_window.h>
#include <vericone/geometry/error.h>
#include <vericone/geometry/mesh/surface.h>
#include <vericone/internal/cones/map/classifiers.h>
#include <vericone/testing/random_bodies.h>
#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "support/campaign.h"

namespace vericone::mesh_window_test {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;
using testing::RandomBodies, testing::share;

/// docs/examples/window.obj: a wall of 8 m x 5 m at x = 4 m, a window of 2 m x 1.5 m.
const std::vector<Vector3d> kPoints{{4, -4, -2},     {4, 4, -2},     {4, 4, 3},   {4, -4, 3},
                                    {4, -0.5, -0.5}, {4, 1.5, -0.5}, {4, 1.5, 1}, {4, -0.5, 1}};
const std::vector<Assembly::Triangle> kTriangles{{0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5},
                                                 {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};

TEST(MeshWindow, AFlatOneIsItsPolygon) {
  const MeshWindow window(kPoints, kTriangles, 1);
  ASSERT_EQ(window.rim().size(), 4u);
  const PlacedOpening flat = window.flat();
  EXPECT_TRUE(flat.opening.convex());
  EXPECT_NEAR(std::abs(flat.normal().x()), 1, 1e-15);
  EXPECT_NEAR(flat.opening.depth(flat.axes.transpose() * (Vector3d(4, 0.5, 0.25) - flat.center)), 0.75,
              1e-12);
  // The polygon itself, exactly.
  const PlacedOpening polygon{Opening::polygon({{-0.5, -0.5}, {1.5, -0.5}, {1.5, 1}, {-0.5, 1}}),
                              {4, 0, 0},
                              (Eigen::Matrix<double, 3, 2>() << 0, 0, 1, 0, 0, 1).finished()};
  RandomBodies random(1940);
  SCOPED_TRACE(random.trace());
  std::array<int, 3> seen{};
  for (int i = 0; i < share(1200); ++i) {
    const Ellipsoid agent = random.ellipsoid(random.in_box(1.5), 0.05, 0.4);
    const OrificeOracle oracle(agent, polygon);
    const Pair pair(Placed(agent), window.mesh());
    // At the wall, not beside it.
    const Vector3d w = Vector3d(4, random.uniform(-2, 2), random.uniform(-1, 2)) - agent.center();
    const auto transit = window.transit(pair, w);
    ASSERT_TRUE(transit);
    ASSERT_EQ(*transit, oracle.transit(w)) << "case " << i;
    ++seen[static_cast<int>(*transit)];
    EXPECT_EQ(window.transit(pair, -w), Transit::blocked);
  }
  EXPECT_GT(seen[0], share(150));
  EXPECT_GT(seen[2], share(150));
  const Ellipsoid ball = Ellipsoid::from_axes({0, 0.5, 0}, {0.5, 0.5, 0.5});
  EXPECT_EQ(window.transit(Placed(ball), {1, 0, 0}), Transit::grazes);
  EXPECT_EQ(window.transit(Placed(ball), {1, 2, 0}), Transit::blocked) << "past the wall";
  EXPECT_EQ(window.transit(Placed(ball), {0, 0, 0}), Transit::blocked);
}

TEST(MeshWindow, ItsConeIsThePolygons) {
  const MeshWindow window(kPoints, kTriangles, 1);
  const PlacedOpening polygon{Opening::polygon({{-0.5, -0.5}, {1.5, -0.5}, {1.5, 1}, {-0.5, 1}}),
                              {4, 0, 0},
                              (Eigen::Matrix<double, 3, 2>() << 0, 0, 1, 0, 0, 1).finished()};
  const Ellipsoid agent = Ellipsoid::from_axes({0, 0, 0}, {0.4, 0.4, 0.15});
  const Vector3d through(4, 0.5, 0.25);
  ConeMapOptions options;
  options.resolution = 0.01;
  const auto cone = window.cone(Placed(agent), through, options);
  ASSERT_TRUE(cone);
  const auto flat = region_around(cone_map(OrificeClassifier(agent, polygon), options), through);
  ASSERT_TRUE(flat);
  // Both bracket the same solid angle.
  EXPECT_LE(cone->region.solid_angle, flat->most_solid_angle);
  EXPECT_LE(flat->solid_angle, cone->region.most_solid_angle);
  EXPECT_GT(cone->region.solid_angle, 0.8 * flat->solid_angle);
  EXPECT_FALSE(window.cone(Placed(agent), {4, 3, 0}, options)) << "the wall";
  EXPECT_FALSE(window.cone(Placed(agent), {-4, 0, 0}, options)) << "away";
}

/// A wall that is bent along the window's middle by an angle, and placed.
MeshWindow bent(double angle, const Pose& pose = {}) {
  std::vector<Vector3d> points{{-4, -3, 0}, {0, -3, 0}, {4, -3, 0}, {-4, 3, 0}, {0, 3, 0}, {4, 3, 0},
                               {-1, -1, 0}, {0, -1, 0}, {1, -1, 0}, {-1, 1, 0}, {0, 1, 0}, {1, 1, 0}};
  for (Vector3d& x : points) x = Vector3d(std::cos(angle) * x.x(), x.y(), std::sin(angle) * std::abs(x.x()));
  return {points,
          {{0, 1, 7},
           {0, 7, 6},
           {1, 2, 8},
           {1, 8, 7},
           {2, 5, 11},
           {2, 11, 8},
           {5, 4, 10},
           {5, 10, 11},
           {4, 3, 9},
           {4, 9, 10},
           {3, 0, 6},
           {3, 6, 9}},
          1,
          pose};
}

TEST(MeshWindow, BentWindows) {
  RandomBodies random(1941);
  SCOPED_TRACE(random.trace());
  for (const double angle : {0.2, 0.8, 1.4}) {
    const Pose pose{random.in_box(5), random.rotation()};
    const MeshWindow window = bent(angle, pose);
    ASSERT_EQ(window.rim().size(), 6u);
    const Ellipsoid agent = Ellipsoid::from_axes(pose.to_world({0, 0, -3}), {0.1, 0.1, 0.1});
    EXPECT_EQ(window.transit(Placed(agent), pose.rotation * Vector3d(0, 0, 1)), Transit::passes) << angle;
    EXPECT_EQ(window.transit(Placed(agent), pose.rotation * Vector3d(0, 0, -1)), Transit::blocked);
    EXPECT_EQ(window.transit(Placed(agent), pose.rotation * Vector3d(0, 2, 3)), Transit::blocked)
        << "the wall";
    const PlacedOpening flat = window.flat();
    EXPECT_NEAR(std::abs(flat.normal().dot(pose.rotation * Vector3d(0, 0, 1))), angle < 1 ? 1 : 0, 1e-9);
  }
}

TEST(MeshWindow, CrossingsOfClosedWaysAreLinks) {
  // A closed way of many straight parts: it crosses the fan as often as it is linked with the rim, by the
  // double integral of Gauss over both.
  RandomBodies random(1942);
  SCOPED_TRACE(random.trace());
  int linked = 0;
  for (int i = 0; i < share(200); ++i) {
    const MeshWindow window = bent(random.uniform(0, 1.2), {random.in_box(2), random.rotation()});
    const auto& rim = window.rim();
    std::vector<Vector3d> way(static_cast<std::size_t>(random.integer(3, 6)));
    for (Vector3d& x : way) x = window.flat().center + random.in_box(2.5);
    int crossings = 0;
    for (std::size_t k = 0; k < way.size(); ++k)
      crossings += window.crossings(way[k], way[(k + 1) % way.size()]);
    double turns = 0;
    // Of two straight parts: the solid angle of their differences, a skew parallelogram in two triangles.
    const auto solid = [](const Vector3d& a, const Vector3d& b, const Vector3d& c) {
      const double x = a.norm(), y = b.norm(), z = c.norm();
      return 2 * std::atan2(a.dot(b.cross(c)), x * y * z + a.dot(b) * z + a.dot(c) * y + b.dot(c) * x);
    };
    for (std::size_t k = 0; k < way.size(); ++k)
      for (std::size_t j = 0; j < rim.size(); ++j) {
        const Vector3d &a = way[k], &b = way[(k + 1) % way.size()], &c = rim[j],
                       &d = rim[(j + 1) % rim.size()];
        turns += solid(c - a, d - a, d - b) + solid(c - a, d - b, c - b);
      }
    const double link = turns / (4 * std::numbers::pi);
    ASSERT_NEAR(std::abs(link), std::abs(std::round(link)), 1e-6) << "case " << i;
    ASSERT_EQ(std::abs(crossings), std::abs(std::lround(link))) << "case " << i;
    linked += crossings != 0;
  }
  EXPECT_GT(linked, share(20));
}

TEST(MeshWindow, ARimThatIsNotSimpleSeenFlat) {
  // A rim that turns back on itself when seen along the normal of its plane of least squares.
  std::vector<Vector3d> rim{{-2, -2, 0},     {2, -2, 0},    {2, 2, 0},       {0.5, 2, 0.3},
                            {-1.5, 1, -0.3}, {1.5, 1, 0.3}, {-0.5, 2, -0.3}, {-2, 2, 0}};
  std::vector<Vector3d> points = rim;
  for (const Vector3d& x : rim) points.push_back(2 * x);
  std::vector<Assembly::Triangle> triangles;
  const auto n = static_cast<std::uint32_t>(rim.size());
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    triangles.push_back({n + i, n + j, j});
    triangles.push_back({n + i, j, i});
  }
  const MeshWindow window(points, triangles, 1);
  const PlacedOpening flat = window.flat();
  EXPECT_TRUE(flat.opening.convex());
  EXPECT_GT(flat.opening.depth(flat.opening.deepest()), 0.8);
  // No part of the rim is within.
  for (std::size_t i = 0; i < rim.size(); ++i)
    for (int k = 0; k < 100; ++k) {
      const Vector3d x = rim[i] + 0.01 * k * (rim[(i + 1) % rim.size()] - rim[i]);
      EXPECT_LT(flat.opening.depth(flat.axes.transpose() * (x - flat.center)), 1e-9);
    }
}

TEST(MeshWindow, BadInput) {
  const auto field = [](const auto& call) -> std::string {
    try {
      call();
    } catch (const InputError& e) {
      return e.field();
    }
    return "none";
  };
  EXPECT_EQ(field([] { MeshWindow(kPoints, kTriangles, 2); }), "loop");
  EXPECT_EQ(field([] {
              MeshWindow({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                         {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}, 0);
            }),
            "loop");
  EXPECT_EQ(field([] { MeshWindow(kPoints, {{0, 1, 99}}, 0); }), "triangles[0][2]");
  Pose skew;
  skew.rotation *= 2;
  EXPECT_EQ(field([&] { MeshWindow(kPoints, kTriangles, 1, skew); }), "pose.rotation");
}

}  // namespace
}  // namespace vericone::mesh_window_test
