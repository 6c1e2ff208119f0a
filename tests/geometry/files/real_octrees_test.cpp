// SPDX-License-Identifier: BSD-3-Clause
//
// Maps and scan graphs as people publish them; the tests skip where they are not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <octomap/OcTree.h>
#include <octomap/ScanGraph.h>
#include <vericone/files/files.h>
#include <vericone/internal/octomap/kinds.h>
#include <vericone/octomap/read_octree.h>

#include <chrono>
#include <cstdlib>
#include <optional>

#include "geometry/files/written_files.h"
#include "support/random.h"

namespace vericone::octomap::real_octrees_test {
namespace {

using Eigen::Vector3d;

/// The named file of the data folder (VERICONE_DATA_DIR, or beside the sources), or of OctoMap's examples.
std::optional<std::filesystem::path> data_file(const std::string& name) {
  const char* given = std::getenv("VERICONE_DATA_DIR");
  for (const char* folder : {given ? given : VERICONE_DEFAULT_DATA_DIR, VERICONE_OCTOMAP_EXAMPLES})
    if (const auto path = std::filesystem::path(folder) / name; std::filesystem::exists(path)) return path;
  return std::nullopt;
}

struct RealMap {
  std::string file;
  double resolution;
  std::size_t nodes, occupied, free;
  Vector3d extent;  // to a tenth of a metre
};

void PrintTo(const RealMap& m, std::ostream* out) { *out << m.file; }

class RealMaps : public ::testing::TestWithParam<RealMap> {};

double volume(const std::vector<Box>& boxes) {
  double sum = 0;
  for (const Box& box : boxes) sum += (box.high - box.low).prod();
  return sum;
}

TEST_P(RealMaps, HaveWhatIsKnownOfThem) {
  const RealMap& known = GetParam();
  const auto path = data_file(known.file);
  if (!path) GTEST_SKIP() << known.file << " is not here; set VERICONE_DATA_DIR to the folder with it";
  const auto start = std::chrono::steady_clock::now();
  const Octree octree = read_octree(*path);
  const auto read = std::chrono::steady_clock::now();
  const std::vector<Box> obstacles = obstacle_boxes(octree, {});
  const auto merged = std::chrono::steady_clock::now();
  const auto milliseconds = [](auto d) { return int(1e3 * std::chrono::duration<double>(d).count()); };
  RecordProperty("read_milliseconds", milliseconds(read - start));
  RecordProperty("obstacles_milliseconds", milliseconds(merged - read));
  RecordProperty("obstacles", int(obstacles.size()));

  EXPECT_EQ(octree.resolution, known.resolution);
  EXPECT_EQ(octree.nodes, known.nodes);
  const OctreeBoxes boxes = boxes_by_kind(octree, {});
  EXPECT_EQ(boxes.occupied.size(), known.occupied);
  EXPECT_EQ(boxes.free.size(), known.free);
  EXPECT_LT((octree.bounds.high - octree.bounds.low - known.extent).cwiseAbs().maxCoeff(), 0.0501);
  const double whole = volume({octree.bounds});
  EXPECT_NEAR((volume(boxes.occupied) + volume(boxes.free) + volume(boxes.unknown)) / whole, 1, 1e-11);
  EXPECT_NEAR((volume(boxes.occupied) + volume(boxes.unknown)) / volume(obstacles), 1, 1e-11);
  EXPECT_LT(obstacles.size(), boxes.occupied.size() + boxes.unknown.size());
}

INSTANTIATE_TEST_SUITE_P(
    Table, RealMaps,
    ::testing::Values(RealMap{"geb079.bt", 0.08, 532566, 143729, 284415, {39.0, 15.0, 3.1}},
                      RealMap{"fr_078_tidyup.bt", 0.05, 1369165, 234303, 929598, {12.8, 14.0, 4.7}}),
    [](const auto& instance) { return instance.param.file.substr(0, instance.param.file.find('.')); });

TEST(RealMap, HasThePointsThatOctomapFinds) {
  const auto path = data_file("geb079.bt");
  if (!path) GTEST_SKIP() << "geb079.bt is not here; set VERICONE_DATA_DIR to the folder with it";
  testing::Random random(440);
  SCOPED_TRACE(random.trace());
  const Octree octree = read_octree(*path);
  ::octomap::OcTree tree(0.1);
  ASSERT_TRUE(tree.readBinary(path->string()));
  const OctreeBoxes boxes = boxes_by_kind(octree, {});
  const auto is_in = [](const std::vector<Box>& some, const Vector3d& x) {
    return std::ranges::any_of(some, [&](const Box& box) { return box.contains(x); });
  };
  int occupied = 0;
  for (int i = 0; i < 1000; ++i) {
    Vector3d x;
    for (int k = 0; k < 3; ++k) x(k) = random.uniform(octree.bounds.low(k), octree.bounds.high(k));
    // Around the walls, where there is something to confuse.
    if (i % 2) {
      const Box& wall = boxes.occupied[std::size_t(random.integer(0, int(boxes.occupied.size()) - 1))];
      for (int k = 0; k < 3; ++k) x(k) = random.uniform(wall.low(k) - 0.08, wall.high(k) + 0.08);
    }
    const auto* node = tree.search(x.x(), x.y(), x.z());
    ASSERT_EQ(is_in(boxes.occupied, x), node && tree.isNodeOccupied(node)) << x.transpose();
    ASSERT_EQ(is_in(boxes.free, x), node && !tree.isNodeOccupied(node)) << x.transpose();
    ASSERT_EQ(is_in(boxes.unknown, x), !node && octree.bounds.contains(x)) << x.transpose();
    occupied += node && tree.isNodeOccupied(node);
  }
  EXPECT_GT(occupied, 100);
}

void expect_graph(const files::PointFile& file, ::octomap::ScanGraph& graph) {
  graph.transformScans();
  std::size_t i = 0;
  for (const auto* node : graph)
    for (const auto& p : *node->scan) {
      ASSERT_LT(i, file.points.size());
      const Vector3d q(p.x(), p.y(), p.z());
      ASSERT_LT((file.points[i] - q).norm(), 1e-6 * (1 + q.norm())) << i;
      ++i;
    }
  EXPECT_EQ(i, file.points.size());
}

TEST(RealScanGraph, HasThePointsThatOctomapHas) {
  const auto path = data_file("spherical_scan.graph");
  if (!path) GTEST_SKIP() << "spherical_scan.graph is not here; set VERICONE_DATA_DIR to the folder with it";
  ::octomap::ScanGraph graph;
  ASSERT_TRUE(graph.readBinary(path->string()));
  expect_graph(files::read_points(*path), graph);
}

TEST(WrittenScanGraphs, HaveThePointsThatOctomapHas) {
  testing::Random random(441);
  SCOPED_TRACE(random.trace());
  const testing::TemporaryDirectory directory;
  std::string text;
  ::octomap::ScanGraph graph;
  for (int n = 0; n < 5; ++n) {
    std::array<float, 6> v;
    for (float& x : v) x = float(random.uniform(-3, 3));
    v[4] = float(random.uniform(-1.5, 1.5));
    text += "NODE";
    for (const float x : v) text += " " + std::to_string(x);
    text += "\n";
    auto* scan = new ::octomap::Pointcloud;
    for (int i = 0; i < 20; ++i) {
      const Vector3d p = 5 * random.vector<3>();
      scan->push_back(float(p.x()), float(p.y()), float(p.z()));
      text += std::to_string(p.x()) + " " + std::to_string(p.y()) + " " + std::to_string(p.z()) + "\n";
    }
    graph.addNode(scan, {v[0], v[1], v[2], v[3], v[4], v[5]});
    if (n > 0) graph.connectPrevious();
  }
  const auto binary = directory.path() / "a.graph", plain = directory.write("b.graph", text);
  ASSERT_TRUE(graph.writeBinary(binary.string()));
  expect_graph(files::read_points(binary), graph);
  ::octomap::ScanGraph read;
  read.readPlainASCII(plain.string());
  ASSERT_EQ(read.size(), 5U);
  expect_graph(files::read_points(plain), read);
}

}  // namespace
}  // namespace vericone::octomap::real_octrees_test
