// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/internal/octomap/kinds.h>
#include <vericone/octomap/read_octree.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <octomap/ColorOcTree.h>
#include <octomap/OcTree.h>
#include <octomap/OcTreeStamped.h>
#include <vericone/geometry/error.h>

#include <cmath>
#include <limits>
#include <map>

#include "geometry/files/written_files.h"
#include "geometry/files/written_octrees.h"

namespace vericone::octomap::octree_test {
namespace {

using Eigen::Vector3d;
using testing::Random;

// A power of two, so that all coordinates and volumes of the tests are exact.
constexpr double kResolution = 0.25;

double volume(const Box& box) { return (box.high - box.low).prod(); }
double volume(const std::vector<Box>& boxes) {
  double sum = 0;
  for (const Box& box : boxes) sum += volume(box);
  return sum;
}

bool is_in(const std::vector<Box>& boxes, const Vector3d& x) {
  return std::ranges::any_of(boxes, [&](const Box& box) { return box.contains(x); });
}

class Octrees : public ::testing::Test {
 protected:
  Octree read(const std::string& name, const std::string& bytes) const {
    return read_octree(directory_.write(name, bytes));
  }

  testing::TemporaryDirectory directory_;
};

/// Every leaf of the tree, with its value where `has_values`, else with its sign; and no other known cell.
template <typename Tree>
void expect_leaves(const Octree& octree, Tree& tree, bool has_values) {
  EXPECT_EQ(octree.nodes, tree.size());
  EXPECT_EQ(octree.resolution, tree.getResolution());
  std::map<std::array<int, 4>, float> leaves;
  for (auto it = tree.begin_leafs(); it != tree.end_leafs(); ++it) {
    // The key of a leaf is that of one of its cells in the middle.
    const auto key = tree.adjustKeyAtDepth(it.getKey(), it.getDepth());
    const int half = it.getDepth() == 16 ? 0 : 1 << (15 - it.getDepth());
    leaves[{key[0] - half, key[1] - half, key[2] - half, int(it.getDepth())}] = it->getLogOdds();
  }
  std::size_t known = 0;
  std::uint64_t cells = 0;
  for (const OctreeCell& cell : octree.cells) {
    cells += std::uint64_t{1} << (3 * (16 - cell.depth));
    if (!cell.is_known) continue;
    ++known;
    const auto it = leaves.find({cell.key[0], cell.key[1], cell.key[2], cell.depth});
    ASSERT_NE(it, leaves.end());
    if (has_values)
      EXPECT_EQ(cell.log_odds, it->second);
    else
      EXPECT_EQ(cell.log_odds, it->second > 0 ? INFINITY : -INFINITY);
  }
  EXPECT_EQ(known, leaves.size());
  EXPECT_EQ(cells, std::uint64_t{1} << 48) << "the cells do not fill the cube";
}

TEST_F(Octrees, HaveTheLeavesThatOctomapHas) {
  Random random(430);
  SCOPED_TRACE(random.trace());
  ::octomap::OcTree tree(kResolution);
  fill(tree, random);
  const Octree full = read("a.ot", testing::to_ot(tree));
  EXPECT_EQ(full.format, "OcTree");
  expect_leaves(full, tree, true);

  ::octomap::ColorOcTree colours(0.1);
  fill(colours, random);
  const Octree coloured = read("b.ot", testing::to_ot(colours));
  EXPECT_EQ(coloured.format, "ColorOcTree");
  expect_leaves(coloured, colours, true);

  ::octomap::OcTreeStamped stamps(0.1);
  fill(stamps, random);
  const Octree stamped = read("c.ot", testing::to_ot(stamps));
  EXPECT_EQ(stamped.format, "OcTreeStamped");
  expect_leaves(stamped, stamps, true);

  // Writing these changes the trees to what is written.
  const Octree binary = read("d.bt", testing::to_bt(tree));
  EXPECT_EQ(binary.format, "OcTree binary");
  expect_leaves(binary, tree, false);
  expect_leaves(read("e.bt", testing::to_bt(colours)), colours, false);
}

TEST_F(Octrees, HaveBoundsOnTheGrid) {
  Random random(431);
  SCOPED_TRACE(random.trace());
  for (const double resolution : {0.05, 0.1, kResolution}) {
    ::octomap::OcTree tree(resolution);
    fill(tree, random);
    const Octree octree = read("a.ot", testing::to_ot(tree));
    Vector3d low, high;
    tree.getMetricMin(low.x(), low.y(), low.z());
    tree.getMetricMax(high.x(), high.y(), high.z());
    EXPECT_LT((octree.bounds.low - low).norm(), 1e-12);
    EXPECT_LT((octree.bounds.high - high).norm(), 1e-12);
    for (const double x : {octree.bounds.low.x(), octree.bounds.high.z()})
      EXPECT_EQ(x, std::round(x / resolution) * resolution);
  }
}

std::vector<std::optional<Box>> regions() {
  const double cube = 32768 * kResolution;
  return {std::nullopt,
          Box{Vector3d::Constant(-8), Vector3d::Constant(8)},                // around the map
          Box{{-1, -2.125, -0.5}, {2.0625, 1, 1.25}},                        // within it, off the grid
          Box{{100, 100, 100}, {101, 102, 103}},                             // away from it
          Box{{-cube - 2, -3, -3}, {3, cube + 1, 3}},                        // out of the cube of the tree
          Box{Vector3d::Constant(-cube - 1), Vector3d::Constant(cube + 2)},  // around that
          Box{Vector3d::Constant(cube + 1), Vector3d::Constant(cube + 2)}};  // away from that
}

TEST_F(Octrees, BoxesOfTheThreeKindsFillTheRegion) {
  Random random(432);
  SCOPED_TRACE(random.trace());
  ::octomap::OcTree tree(kResolution);
  fill(tree, random);
  const Octree octree = read("a.ot", testing::to_ot(tree));
  for (const auto& region : regions()) {
    OctreeMeaning meaning;
    meaning.region = region;
    const OctreeBoxes boxes = boxes_by_kind(octree, meaning);
    EXPECT_EQ(boxes.occupied.size(), boxes_by_kind(octree, {}).occupied.size());
    // Known cells count everywhere: within the region, unknown ones take what they leave.
    double known_within = 0;
    for (const auto* kind : {&boxes.occupied, &boxes.free})
      for (const Box& box : *kind) {
        const Box r = region.value_or(octree.bounds);
        known_within += (box.high.cwiseMin(r.high) - box.low.cwiseMax(r.low)).cwiseMax(0).prod();
      }
    EXPECT_EQ(known_within + volume(boxes.unknown), volume(region.value_or(octree.bounds)));
  }
}

TEST_F(Octrees, PointsAreWhatOctomapSaysOfThem) {
  Random random(433);
  SCOPED_TRACE(random.trace());
  ::octomap::OcTree tree(kResolution);
  fill(tree, random);
  const Octree octree = read("a.ot", testing::to_ot(tree));
  for (const double threshold : {0.3, 0.5, 0.8}) {
    tree.setOccupancyThres(threshold);
    for (const auto& region : regions()) {
      for (const bool free : {false, true})
        for (const bool unknown : {false, true}) {
          const OctreeMeaning meaning{threshold, free, unknown, region};
          const OctreeBoxes kinds = boxes_by_kind(octree, meaning);
          const std::vector<Box> obstacles = obstacle_boxes(octree, meaning);
          EXPECT_EQ(volume(obstacles), volume(kinds.occupied) + (free ? volume(kinds.free) : 0) +
                                           (unknown ? volume(kinds.unknown) : 0));
          const Box within = region.value_or(octree.bounds);
          for (int i = 0; i < 200; ++i) {
            // Half of them in the map, half in the region.
            const Box& around = i % 2 ? within : octree.bounds;
            Vector3d x;
            for (int k = 0; k < 3; ++k) x(k) = random.uniform(around.low(k), around.high(k));
            ::octomap::OcTreeKey key;  // none out of the cube
            const auto* node = tree.coordToKeyChecked(x.x(), x.y(), x.z(), key) ? tree.search(key) : nullptr;
            const bool occupied = node && tree.isNodeOccupied(node);
            ASSERT_EQ(is_in(kinds.occupied, x), occupied) << x.transpose();
            ASSERT_EQ(is_in(kinds.free, x), node && !occupied) << x.transpose();
            ASSERT_EQ(is_in(kinds.unknown, x), !node && within.contains(x)) << x.transpose();
            ASSERT_EQ(is_in(obstacles, x),
                      occupied || (free && node) || (unknown && !node && within.contains(x)))
                << x.transpose();
          }
        }
    }
  }
}

TEST_F(Octrees, CellsThatCountTogetherAreOneBox) {
  ::octomap::OcTree tree(kResolution);
  const auto set = [&](int x, int y, int z, float log_odds) {
    const auto at = [](int i) { return ::octomap::key_type(32768 + i); };
    tree.setNodeValue(::octomap::OcTreeKey(at(x), at(y), at(z)), log_odds, true);
  };
  for (int i = 0; i < 64; ++i) set(i % 4, i / 4 % 4, i / 16, 1.F + 0.01F * float(i));
  tree.updateInnerOccupancy();
  tree.prune();
  ASSERT_EQ(tree.getNumLeafNodes(), 64U);
  const auto boxes = obstacle_boxes(read("a.ot", testing::to_ot(tree)), {});
  ASSERT_EQ(boxes.size(), 1U);
  EXPECT_EQ(boxes[0].low, Vector3d(0, 0, 0));
  EXPECT_EQ(boxes[0].high, Vector3d(1, 1, 1));

  // One free cell: of 64, its block of eight falls apart. With free cells as obstacles, it does not matter.
  set(1, 1, 1, -1.F);
  tree.updateInnerOccupancy();
  const Octree octree = read("b.ot", testing::to_ot(tree));
  EXPECT_EQ(obstacle_boxes(octree, {}).size(), 14U);
  OctreeMeaning free;
  free.free_occupied = true;
  EXPECT_EQ(obstacle_boxes(octree, free).size(), 1U);
  // A cell that is not known is like an occupied one, by default.
  tree.deleteNode(::octomap::OcTreeKey(32769, 32769, 32769));
  const Octree gap = read("c.ot", testing::to_ot(tree));
  EXPECT_EQ(obstacle_boxes(gap, {}).size(), 1U);
  OctreeMeaning unknown;
  unknown.unknown_occupied = false;
  EXPECT_EQ(obstacle_boxes(gap, unknown).size(), 14U);
}

TEST_F(Octrees, ThresholdIsOfTheProbability) {
  ::octomap::OcTree tree(kResolution);
  // Occupied with probability 0.25, 0.5, 0.75.
  for (int i = 0; i < 3; ++i)
    tree.setNodeValue(::octomap::OcTreeKey(32768, ::octomap::key_type(32768 + 5 * i), 32768),
                      float(i - 1) * std::log(3.F), true);
  tree.updateInnerOccupancy();
  const Octree octree = read("a.ot", testing::to_ot(tree));
  const auto occupied = [](const Octree& map, double threshold) {
    OctreeMeaning meaning;
    meaning.occupied_above = threshold;
    return boxes_by_kind(map, meaning).occupied.size();
  };
  EXPECT_EQ(occupied(octree, 0.2), 3U);
  EXPECT_EQ(occupied(octree, 0.3), 2U);
  EXPECT_EQ(occupied(octree, 0.5), 2U);
  EXPECT_EQ(occupied(octree, 0.6), 1U);
  EXPECT_EQ(occupied(octree, 0.99), 0U);
  // A .bt file keeps what was decided at 0.5.
  const Octree binary = read("a.bt", testing::to_bt(tree));
  for (const double threshold : {0.01, 0.5, 0.99}) EXPECT_EQ(occupied(binary, threshold), 2U);
}

TEST_F(Octrees, MeaningsThatAreNoneAreRefused) {
  ::octomap::OcTree tree(kResolution);
  tree.setNodeValue(::octomap::OcTreeKey(32768, 32768, 32768), 1.F);
  const Octree octree = read("a.ot", testing::to_ot(tree));
  const auto field = [&](const OctreeMeaning& meaning) -> std::string {
    for (const int which : {0, 1}) try {
        which ? (void)boxes_by_kind(octree, meaning) : (void)obstacle_boxes(octree, meaning);
        return "no error";
      } catch (const InputError& error) {
        if (which) return error.field();
      }
    return "";
  };
  for (const double threshold : {0.0, 1.0, -1.0, std::nan("")}) {
    OctreeMeaning meaning;
    meaning.occupied_above = threshold;
    EXPECT_EQ(field(meaning), "occupied_above");
  }
  for (const double high : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::nan("")}) {
    OctreeMeaning meaning;
    meaning.region = Box{{0, 0, 0}, {1, high, 1}};
    EXPECT_EQ(field(meaning), "region");
  }
  EXPECT_EQ(field({}), "no error");
}

}  // namespace
}  // namespace vericone::octomap::octree_test
