// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/geometry/error.h>
#include <vericone/geometry/mesh/surface.h>

#include <algorithm>
#include <set>
#include <vector>

namespace vericone::boundary_loops_test {
namespace {

using Eigen::Vector3d;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

TEST(BoundaryLoops, AWallWithAWindow) {
  const std::vector<Vector3d> p{{4, -4, -2},     {4, 4, -2},     {4, 4, 3},   {4, -4, 3},
                                {4, -0.5, -0.5}, {4, 1.5, -0.5}, {4, 1.5, 1}, {4, -0.5, 1}};
  const Triangles t{{0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
  const auto loops = boundary_loops(p, t);
  ASSERT_EQ(loops.size(), 2u);
  EXPECT_EQ(loops[0], (std::vector<std::uint32_t>{0, 1, 2, 3})) << "the outer edge is longer";
  EXPECT_EQ(std::set<std::uint32_t>(loops[1].begin(), loops[1].end()), (std::set<std::uint32_t>{4, 5, 6, 7}));
  // The wall is to the left of both: the window's rim runs clockwise where the outer edge does not.
  const auto area = [&](const std::vector<std::uint32_t>& loop) {
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = 0; i < loop.size(); ++i) sum += p[loop[i]].cross(p[loop[(i + 1) % loop.size()]]);
    return 0.5 * sum.x();
  };
  EXPECT_DOUBLE_EQ(area(loops[0]), 40);
  EXPECT_DOUBLE_EQ(area(loops[1]), -3);
  // Without the triangles' agreement there are the same loops.
  Triangles turned = t;
  std::swap(turned[2][0], turned[2][1]);
  std::swap(turned[5][0], turned[5][1]);
  EXPECT_EQ(boundary_loops(p, turned).size(), 2u);
}

TEST(BoundaryLoops, ClosedMeshesHaveNone) {
  const std::vector<Vector3d> p{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const Triangles t{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  EXPECT_TRUE(boundary_loops(p, t).empty());
  EXPECT_TRUE(boundary_loops(p, {}).empty());
  const auto open = boundary_loops(p, {t.begin(), t.end() - 1});
  ASSERT_EQ(open.size(), 1u);
  EXPECT_EQ(open[0].size(), 3u);
}

TEST(BoundaryLoops, PartedWhereTheyTouch) {
  // Two triangles with one corner in common, and a fan with two windows that share a corner.
  const std::vector<Vector3d> p{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -2, 0}};
  const auto loops = boundary_loops(p, {{0, 1, 2}, {0, 3, 4}});
  ASSERT_EQ(loops.size(), 2u);
  for (const auto& loop : loops)
    EXPECT_EQ(std::set<std::uint32_t>(loop.begin(), loop.end()).size(), loop.size());
  EXPECT_NE(std::find(loops[0].begin(), loops[0].end(), 4u), loops[0].end()) << "the longer one";
}

TEST(BoundaryLoops, BadInput) {
  try {
    (void)boundary_loops({{0, 0, 0}, {1, 0, 0}}, {{0, 1, 2}});
    FAIL();
  } catch (const InputError& e) {
    EXPECT_EQ(e.field(), "triangles[0][2]");
  }
}

}  // namespace
}  // namespace vericone::boundary_loops_test
