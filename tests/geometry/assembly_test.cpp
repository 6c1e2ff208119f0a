// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/geometry/assembly.h>
#include <vericone/geometry/error.h>
#include <limits>
#include "support/random_assemblies.h"

namespace vericone::assembly_test {
namespace {

using Eigen::Vector3d;

/// Every slot in one leaf, every box around its pieces, children inside their parents.
void expect_sound(const Hierarchy& tree, const std::vector<Box>& boxes) {
  ASSERT_EQ(tree.order().size(), boxes.size());
  std::vector<int> seen(boxes.size(), 0);
  struct Item {
    std::uint32_t node;
    int level;
  };
  std::vector<Item> stack{{0, 0}};
  int deepest = 0;
  while (!stack.empty()) {
    const auto [index, level] = stack.back();
    stack.pop_back();
    deepest = std::max(deepest, level);
    const Hierarchy::Node& node = tree.nodes()[index];
    const Box outer = node.box();
    if (node.is_leaf()) {
      for (std::uint32_t slot = node.first; slot < node.first + node.count; ++slot) {
        const std::uint32_t piece = tree.order()[slot];
        ++seen[piece];
        EXPECT_TRUE(outer.contains(boxes[piece].low) && outer.contains(boxes[piece].high));
      }
      continue;
    }
    for (std::uint32_t child = node.first; child < node.first + 2; ++child) {
      const Box inner = tree.nodes()[child].box();
      EXPECT_TRUE(outer.contains(inner.low) && outer.contains(inner.high));
      stack.push_back({child, level + 1});
    }
  }
  for (const int count : seen) EXPECT_EQ(count, 1);
  EXPECT_EQ(tree.depth(), deepest);
  EXPECT_LE(deepest, 120);
}

TEST(Hierarchy, OverBoxesOfAllSizes) {
  testing::RandomAssemblies random(1);
  for (const std::size_t count : {1, 2, 5, 100, 5000}) {
    std::vector<Box> boxes;
    for (std::size_t i = 0; i < count; ++i) {
      const Vector3d c = random.vector(100),
                     half = random.vector(std::pow(10, random.uniform(-6, 1))).cwiseAbs();
      boxes.push_back({c - half, c + half});
    }
    expect_sound(Hierarchy(boxes), boxes);
  }
}

TEST(Hierarchy, BoxesThatNothingParts) {
  // All in one place; nested; growing by powers of two, so that every split by surface peels off one.
  std::vector<Box> same(1000, {{1, 2, 3}, {4, 5, 6}}), powers;
  expect_sound(Hierarchy(same), same);
  for (int i = 0; i < 120; ++i)
    powers.push_back({Vector3d::Constant(std::ldexp(1, i)), Vector3d::Constant(std::ldexp(1.5, i))});
  expect_sound(Hierarchy(powers), powers);
  // Beyond the range of floats.
  std::vector<Box> far;
  for (int i = 0; i < 50; ++i) far.push_back({Vector3d::Constant(1e300 * i), Vector3d::Constant(1e300 * i)});
  const Hierarchy tree(far);
  EXPECT_EQ(tree.order().size(), far.size());
}

TEST(Hierarchy, MadeElsewhereIsChecked) {
  const Hierarchy tree(std::vector<Box>(10, Box{}));
  const std::vector<Hierarchy::Node> nodes(tree.nodes().begin(), tree.nodes().end());
  const std::vector<std::uint32_t> order(tree.order().begin(), tree.order().end());
  EXPECT_EQ(Hierarchy(nodes, order).depth(), tree.depth());
  auto broken = nodes;
  broken[0].first = 0;  // its own child
  EXPECT_THROW(Hierarchy(broken, order), InputError);
  broken = nodes;
  broken.back().count += 1;
  EXPECT_THROW(Hierarchy(broken, order), InputError);
  auto twice = order;
  twice[0] = twice[1];
  EXPECT_THROW(Hierarchy(nodes, twice), InputError);
}

TEST(Assembly, PiecesComeBackAsGiven) {
  testing::RandomAssemblies random(2);
  std::vector<Vector3d> points;
  for (int i = 0; i < 200; ++i) points.push_back(random.vector(3));
  const Assembly cloud = Assembly::cloud(points, 0.1);
  EXPECT_EQ(cloud.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(cloud.piece(i).points()[0], points[i]);
  Box around{points[0], points[0]};
  for (const Vector3d& x : points) around.include({x.array() - 0.1, x.array() + 0.1});
  EXPECT_LT((cloud.bounds().low - around.low).norm(), 1e-14);
  EXPECT_LT((cloud.bounds().high - around.high).norm(), 1e-14);

  const Assembly mesh = Assembly::mesh(points, {{0, 1, 2}, {7, 5, 3}, {10, 10, 11}});
  EXPECT_EQ(mesh.piece(1).points(), (std::vector<Vector3d>{points[7], points[5], points[3]}));
  EXPECT_EQ(mesh.kind(), PieceKind::triangle);
}

/// The field that the error names.
template <class Call>
std::string refused(Call call) {
  try {
    call();
  } catch (const InputError& e) {
    return e.field();
  }
  return "";
}

TEST(Assembly, RefusesWhatIsNoBody) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refused([] { Assembly::mesh({}, {}); }), "triangles");
  EXPECT_EQ(refused([] { Assembly::mesh({{0, 0, 0}}, {{0, 0, 1}}); }), "triangles[0][2]");
  EXPECT_EQ(refused([&] { Assembly::mesh({{0, nan, 0}}, {{0, 0, 0}}); }), "points[0][1]");
  EXPECT_EQ(refused([] { Assembly::cloud({}, 1); }), "points");
  EXPECT_EQ(refused([] { Assembly::cloud({{0, 0, 0}}, -1); }), "radius");
  EXPECT_EQ(refused([&] { Assembly::cloud({{0, 0, 0}}, nan); }), "radius");
  EXPECT_EQ(refused([] { Assembly::boxes({}); }), "boxes");
  EXPECT_EQ(refused([] { Assembly::boxes({{{0, 1, 0}, {1, 0, 1}}}); }), "boxes[0].low[1]");
  EXPECT_EQ(refused([] { Assembly::polyhedra({}); }), "hulls");
}

}  // namespace
}  // namespace vericone::assembly_test
