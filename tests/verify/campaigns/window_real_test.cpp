// SPDX-License-Identifier: GPL-3.0-or-later
//
// Windows cut into meshes as people publish them.
#include <gtest/gtest.h>
#include <vericone/cones/mesh_window.h>
#include <vericone/geometry/boundary_loops.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>
#include <vector>

#include "verify/campaigns/real_data.h"

namespace vericone::verify::window_real_test {
namespace {

using Eigen::Vector3d;

class RealWindows : public ::testing::TestWithParam<const char*> {};

/// All triangles near a line through the middle are cut out: windows on both sides, that one flies through.
TEST_P(RealWindows, AreFlownThrough) {
  const auto real = real_mesh(GetParam());
  if (!real) GTEST_SKIP() << not_here(GetParam());
  Vector3d low = real->points.front(), high = low;
  for (const Vector3d& x : real->points) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  const Vector3d middle = 0.5 * (low + high), line = Vector3d(0.3, 0.1, 1).normalized();
  const double size = (high - low).norm(), radius = 0.06 * size;
  const std::size_t before = boundary_loops(real->points, real->triangles).size();
  std::vector<Assembly::Triangle> kept;
  for (const auto& t : real->triangles) {
    const bool near = std::any_of(t.begin(), t.end(), [&](std::uint32_t i) {
      return (real->points[i] - middle).cross(line).norm() < radius;
    });
    if (!near) kept.push_back(t);
  }
  ASSERT_LT(kept.size(), real->triangles.size());
  const auto loops = boundary_loops(real->points, kept);
  std::cout << "[ loops    ] " << GetParam() << ": " << before << " before, " << loops.size() << " after, of "
            << kept.size() << " triangles\n";
  const Ellipsoid ball = Ellipsoid::from_axes(middle - size * line, Vector3d::Constant(0.5 * radius));
  int windows = 0;
  for (std::size_t i = 0; i < std::min<std::size_t>(loops.size(), 40); ++i) {
    const MeshWindow window(real->points, kept, i);
    const int crossings = window.crossings_along(ball.center(), line);
    if (crossings == 0) continue;
    ++windows;
    EXPECT_EQ(window.transit(Placed(ball), line), Transit::passes);
    EXPECT_EQ(window.transit(Placed(ball), -line), Transit::blocked);
    // One that is larger than what was cut out does not pass; the flat opening is about as wide as that.
    EXPECT_EQ(
        window.transit(Placed(Ellipsoid::from_axes(ball.center(), Vector3d::Constant(1.5 * radius))), line),
        Transit::blocked);
    const PlacedOpening flat = window.flat();
    EXPECT_GT(flat.opening.depth(flat.opening.deepest()), 0.5 * radius);
  }
  EXPECT_GE(windows, 2) << "in and out";
  EXPECT_EQ(windows % 2, 0);
}

INSTANTIATE_TEST_SUITE_P(Meshes, RealWindows,
                         ::testing::Values("stanford-bunny.obj", "data/meshes/refined_elephant.off",
                                           "data/meshes/armadillo.off");

}  // namespace
}  // namespace vericone::verify::window_real_test
