// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <octomap/ColorOcTree.h>
#include <octomap/OcTree.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/octomap/kinds.h>
#include <vericone/octomap/read_octree.h>

#include <limits>

#include "geometry/files/refused_files.h"
#include "geometry/files/written_files.h"
#include "geometry/files/written_octrees.h"

namespace vericone::octomap::malformed_octrees_test {
namespace {

using testing::BadFile, testing::Random, testing::TemporaryDirectory;

class MalformedOctrees : public ::testing::TestWithParam<BadFile> {};

TEST_P(MalformedOctrees, AreRefusedInOneLine) {
  ::testing::internal::CaptureStderr();
  testing::expect_refused(GetParam(), [](const auto& path) { read_octree(path); });
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

std::string bt(const std::string& body, int nodes = 2, const std::string& id = "OcTree") {
  return "# Octomap OcTree binary file\n# a comment\nid " + id + "\nsize " + std::to_string(nodes) +
         "\nres 0.1\ndata\n" + body;
}
std::string ot(const std::string& body, int nodes, const std::string& id = "OcTree") {
  return "# Octomap OcTree file\nid " + id + "\nsize " + std::to_string(nodes) + "\nres 0.1\ndata\n" + body;
}
std::string node(float value, int children) {
  return testing::bytes_of(value, std::endian::little) + char(children);
}

/// An inner node of one inner child, down to the given depth, whose child is a leaf.
std::string chain(int depth) {
  std::string body;
  for (int i = 0; i < depth; ++i) body += {'\x03', '\0'};
  return body + std::string{'\x02', '\0'};
}

INSTANTIATE_TEST_SUITE_P(
    Table, MalformedOctrees,
    ::testing::Values(
        BadFile{"empty", "a.bt", "", "an empty file", "with points"},
        BadFile{"text", "a.bt", "Dear reader,\nhello\n", "\"Dear reader,\"", "Octomap OcTree"},
        BadFile{"legacy", "a.bt", std::string("\x03\0\0\0\x9a\x99\x99\x99\x99\x99\xb9\x3f\x01\0\0\0\x02\0", 18),
                  "\"????", "convert_octree"},
        BadFile{"no_data", "a.bt", "# Octomap OcTree binary file\nid OcTree\nsize 2\nres 0.1\n", "without end",
                  "data"},
        BadFile{"no_id", "a.bt", "# Octomap OcTree binary file\nsize 2\nres 0.1\ndata\n", "without id",
                  "all three"},
        BadFile{"no_size", "a.bt", "# Octomap OcTree binary file\nid OcTree\nres 0.1\ndata\n", "without id",
                  "all three"},
        BadFile{"no_res", "a.bt", "# Octomap OcTree binary file\nid OcTree\nsize 2\ndata\n", "without id",
                  "all three"},
        BadFile{"empty_map", "a.bt", bt("", 0), "a tree of 0 nodes", "at least one"},
        BadFile{"negative_size", "a.bt", bt("", -1), "a tree of -1 nodes", "at least one"},
        BadFile{"word_size", "a.bt", "# Octomap OcTree file\nid OcTree\nsize many\nres 0.1\ndata\n", "\"many\"",
                  "integer"},
        BadFile{"zero_resolution", "a.bt", "# Octomap OcTree file\nid OcTree\nsize 1\nres 0\ndata\n",
                  "resolution 0", "positive"},
        BadFile{"nan_resolution", "a.bt", "# Octomap OcTree file\nid OcTree\nsize 1\nres nan\ndata\n",
                  "resolution nan", "positive"},
        BadFile{"counting_tree", "a.bt", ot(node(0, 0), 1, "CountingOcTree"), "\"CountingOcTree\"", "OcTree, ColorOcTree"},
        BadFile{"unknown_tree", "a.bt", ot(node(0, 0), 1, "SemanticOcTree"), "\"SemanticOcTree\"", "OcTree"},
        BadFile{"no_tree", "a.bt", bt(""), "end of file", "all the nodes"},
        BadFile{"half_a_node", "a.bt", bt("\x02"), "end of file", "all the nodes"},
        BadFile{"childless", "a.bt", bt(std::string(2, '\0'), 1), "without children", "as OctoMap writes"},
        BadFile{"too_deep", "a.bt", bt(chain(16), 18), "deeper than 16", "as OctoMap writes"},
        BadFile{"endlessly_deep", "a.bt", bt(chain(100000), 100002), "deeper than 16", "as OctoMap writes"},
        BadFile{"longer", "a.bt", bt(chain(0) + "x"), "1 bytes after", "end of the file"},
        BadFile{"fewer_nodes", "a.bt", bt(chain(3), 6), "a tree of 5 nodes", "the 6 nodes"},
        BadFile{"full_nan", "a.bt", ot(node(std::numeric_limits<float>::quiet_NaN(), 0), 1), "not finite",
                  "as OctoMap writes"},
        BadFile{"full_truncated", "a.bt", ot(node(0.5F, 3) + node(0.5F, 0), 3), "end of file", "all the nodes"},
        BadFile{"full_longer", "a.bt", ot(node(0.5F, 0) + "x", 1), "1 bytes after", "end of the file"},
        BadFile{"full_colours_missing", "a.bt", ot(node(0.5F, 0), 1, "ColorOcTree"), "end of file",
                  "all the nodes"},
        BadFile{"full_too_deep", "a.bt", [] {
                    std::string body;
                    for (int i = 0; i < 40; ++i) body += node(0.5F, 1);
                    return ot(body + node(0.5F, 0), 41);
                  }(),
                  "deeper than 16", "as OctoMap writes"}),
    [](const auto& instance) { return instance.param.name; });

TEST(SoundOctrees, AsDeepAsATreeCanBe) {
  const TemporaryDirectory directory;
  const Octree deep = read_octree(directory.write("a.bt", bt(chain(15), 17)));
  EXPECT_EQ(deep.bounds.low, Eigen::Vector3d::Constant(-32768 * 0.1));
  EXPECT_EQ(deep.bounds.high, Eigen::Vector3d::Constant(-32767 * 0.1));
  const Octree root = read_octree(directory.write("a.ot", ot(node(0.5F, 0), 1)));
  EXPECT_EQ(root.cells.size(), 1U);
  EXPECT_EQ(obstacle_boxes(root, {}).size(), 1U);
  // Headers of early versions, of people, and of Windows.
  EXPECT_EQ(
      read_octree(directory.write("b.ot",
                                  "# Octomap OcTree file\r\nid 1\r\nsize 1\r\n# mine\r\nmore here\r\nres "
                                  "0.5\r\ndata\r\n" +
                                      node(0.5F, 0)))
          .resolution,
      0.5);
}

/// Whatever is cut off is refused; whatever is overwritten gives a map or an InputError; nobody says a word.
TEST(DamagedOctrees, NeverCrashTheReader) {
  Random random(435);
  SCOPED_TRACE(random.trace());
  const TemporaryDirectory directory;
  ::octomap::OcTree tree(0.1);
  ::octomap::ColorOcTree colours(0.1);
  for (int i = 0; i < 12; ++i) {
    const ::octomap::OcTreeKey key(::octomap::key_type(32768 + i % 3), ::octomap::key_type(32768 + i),
                                   ::octomap::key_type(32766 + i % 5));
    tree.setNodeValue(key, float(i - 5));
    colours.setNodeValue(key, float(i - 5));
  }
  const std::string sound[] = {testing::to_ot(tree), testing::to_ot(colours), testing::to_bt(tree)};
  ::testing::internal::CaptureStderr();
  int refused = 0;
  for (const std::string& bytes : sound) {
    const auto is_read = [&](const std::string& damaged) {
      const auto path = directory.write("a.ot", damaged);
      try {
        const Octree octree = read_octree(path);
        EXPECT_FALSE(obstacle_boxes(octree, {}).empty() && boxes_by_kind(octree, {}).free.empty());
        return true;
      } catch (const InputError&) {
        ++refused;
        return false;
      }
    };
    ASSERT_TRUE(is_read(bytes));
    for (std::size_t length = 0; length < bytes.size(); ++length)
      EXPECT_FALSE(is_read(bytes.substr(0, length))) << length << " of " << bytes.size() << " bytes";
    for (int k = 0; k < 500; ++k) {
      std::string damaged = bytes;
      for (int n = random.integer(1, 4); n > 0; --n)
        damaged[std::size_t(random.integer(0, int(bytes.size()) - 1))] = char(random.integer(0, 255));
      is_read(damaged);
    }
  }
  EXPECT_GT(refused, 500);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace vericone::octomap::malformed_octrees_test
