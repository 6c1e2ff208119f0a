// SPDX-License-Identifier: GPL-3.0-or-later
//
// Windows cut into meshes as people publish them.
#include <gtest/gtest.h>
#include <vericone/cones/mesh_window.h>
#include <vericone/geometry/mesh/surface.h>
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
int windows_along(const RealMesh& real, const Vector3d& line, const char* name) {
  Vector3d low = real.points.front(), high = low;
  for (const Vector3d& x : real.points) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  const Vector3d middle = 0.5 * (low + high);
  const double size = (high - low).norm(), radius = 0.06 * size;
  std::vector<Assembly::Triangle> kept;
  for (const auto& t : real.triangles)
    if (std::none_of(t.begin(), t.end(),
                     [&](std::uint32_t i) { return (real.points[i] - middle).cross(line).norm() < radius; }))
      kept.push_back(t);
  const auto loops = boundary_loops(real.points, kept);
  const Ellipsoid ball = Ellipsoid::from_axes(middle - size * line, Vector3d::Constant(0.5 * radius)),
                  large = Ellipsoid::from_axes(ball.center(), Vector3d::Constant(1.5 * radius));
  int windows = 0;
  for (std::size_t i = 0; i < std::min<std::size_t>(loops.size(), 40); ++i) {
    const MeshWindow window(real.points, kept, i);
    if (window.crossings_along(ball.center(), line) == 0) continue;
    ++windows;
    EXPECT_EQ(window.transit(Placed(ball), line), Transit::passes);
    EXPECT_EQ(window.transit(Placed(ball), -line), Transit::blocked);
    EXPECT_EQ(window.transit(Placed(large), line), Transit::blocked);
    // A curved rim may be narrow as seen flat, but there is something to aim at.
    const PlacedOpening flat = window.flat();
    EXPECT_GT(flat.opening.depth(flat.opening.deepest()), 0.1 * radius);
  }
  std::cout << "[ windows  ] " << name << ": " << boundary_loops(real.points, real.triangles).size()
            << " loops before, " << loops.size() << " after, of which " << windows << " in the way\n";
  return windows;
}

TEST_P(RealWindows, AreFlownThrough) {
  const auto real = real_mesh(GetParam());
  if (!real) GTEST_SKIP() << not_here(GetParam());
  int windows = 0;
  for (const Vector3d& line : {Vector3d(0.3, 0.1, 1), Vector3d(1, 0.2, 0.1), Vector3d(0.1, 1, 0.2)}) {
    const int in_the_way = windows_along(*real, line.normalized(), GetParam());
    EXPECT_EQ(in_the_way % 2, 0) << "in, and out again";
    windows += in_the_way;
  }
  EXPECT_GE(windows, 2);
}

INSTANTIATE_TEST_SUITE_P(Meshes, RealWindows,
                         ::testing::Values("stanford-bunny.obj", "data/meshes/refined_elephant.off",
                                           "data/meshes/armadillo.off"));

}  // namespace
}  // namespace vericone::verify::window_real_test
