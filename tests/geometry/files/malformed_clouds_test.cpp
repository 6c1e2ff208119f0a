// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vericone/files/files.h>
#include <vericone/geometry/error.h>

#include <limits>

#include "geometry/files/refused_files.h"
#include "geometry/files/written_clouds.h"
#include "support/random.h"

namespace vericone::files::malformed_clouds_test {
namespace {

using testing::BadFile, testing::LasFile, testing::little, testing::Random, testing::TemporaryDirectory;

class MalformedClouds : public ::testing::TestWithParam<BadFile> {};

TEST_P(MalformedClouds, AreRefusedInOneLine) {
  testing::expect_refused(GetParam(), [](const auto& path) { read_points(path); });
}

const testing::Points kTriangle = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

std::string ascii_stl(const std::string& vertex) {
  return "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n" + vertex +
         "\nendloop\nendfacet\nendsolid a\n";
}

std::string pcd(const std::string& data, const std::string& body, std::size_t width = 1) {
  return testing::pcd_header("x y z", "4 4 4", "F F F", "1 1 1", width, 1, data) + body;
}
std::string pcd_of(const std::string& names, const std::string& sizes, const std::string& types,
                   const std::string& counts) {
  return testing::pcd_header(names, sizes, types, counts, 1, 1, "ascii") + "1 2 3\n";
}
std::string floats(int n) {
  std::string s;
  for (int i = 0; i < n; ++i) s += little(float(i));
  return s;
}

std::string las(const std::function<void(LasFile&)>& change) {
  LasFile file;
  file.points = {{1, 2, 3}, {4, 5, 6}};
  change(file);
  return file.bytes();
}
std::string las_with(std::size_t at, const std::string& bytes, int minor = 2) {
  std::string s = las([&](LasFile& f) { f.minor = minor; });
  return s.replace(at, bytes.size(), bytes);
}

std::string graph() { return testing::to_scan_graph({{kTriangle, {0, 0, 0}, {1, 0, 0, 0}}}); }
const double kNan = std::numeric_limits<double>::quiet_NaN();

INSTANTIATE_TEST_SUITE_P(
    Table, MalformedClouds,
    ::testing::Values(
        BadFile{"stl_empty", "a.stl", "", "an empty file", "with points"},
        BadFile{"stl_short", "a.stl", "hello", "5 bytes", "84 bytes"},
        BadFile{"stl_no_facets", "a.stl", testing::to_stl_binary({}), "no points", "at least one"},
        BadFile{"stl_truncated", "a.stl", testing::to_stl_binary(kTriangle).substr(0, 130), "130 bytes",
                "134 bytes, as the 1 facets"},
        BadFile{"stl_no_facets_but_bytes", "a.stl", testing::to_stl_binary({}) + "x", "85 bytes",
                "84 bytes, as the 0 facets"},
        BadFile{"stl_all_nan", "a.stl", testing::to_stl_binary({{kNan, 0, 0}, {0, kNan, 0}, {0, 0, kNan}}),
                "none of them finite", "at least one finite"},
        BadFile{"stl_ascii_empty", "a.stl", "solid a\nendsolid a\n", "no points", "at least one"},
        BadFile{"stl_ascii_truncated", "a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n",
                "end of file", "vertex"},
        BadFile{"stl_ascii_no_end", "a.stl",
                ascii_stl("vertex 0 1 0").substr(0, ascii_stl("vertex 0 1 0").find("endsolid")),
                "end of file", "endsolid"},
        BadFile{"stl_ascii_quad", "a.stl", ascii_stl("vertex 0 1 0\nvertex 1 1 0"), "line 7", "endloop"},
        BadFile{"stl_ascii_two_corners", "a.stl", ascii_stl(""), "line 7: \"endloop\"", "vertex"},
        BadFile{"stl_ascii_word", "a.stl", ascii_stl("vertex 0 one 0"), "line 6: \"one\"", "number"},
        BadFile{"stl_ascii_two_numbers", "a.stl", ascii_stl("vertex 0 1"), "line 6: \"\"", "number"},
        BadFile{"stl_ascii_four_numbers", "a.stl", ascii_stl("vertex 0 1 0 1"), "line 6", "three numbers"},
        BadFile{"stl_ascii_after_end", "a.stl", ascii_stl("vertex 0 1 0") + "more\n", "\"more\"", "solid"},

        BadFile{"pcd_no_data", "a.pcd", "# .PCD v0.7\nFIELDS x y z\n", "without end", "DATA"},
        BadFile{"pcd_other_data", "a.pcd", pcd("zip", ""), "DATA zip", "binary_compressed"},
        BadFile{"pcd_unknown_line", "a.pcd", "# .PCD v0.7\nFELDS x y z\n", "FELDS", "header"},
        BadFile{"pcd_no_z", "a.pcd", pcd_of("x y w", "4 4 4", "F F F", "1 1 1"), "x, y and z", "fields"},
        BadFile{"pcd_both_cases", "a.pcd", pcd_of("x Y Z", "4 4 4", "F F F", "1 1 1"), "x, y and z",
                "fields"},
        BadFile{"pcd_negative_count", "a.pcd", pcd_of("x y z", "4 4 4", "F F F", "1 -1 1"), "COUNT 1 -1 1",
                "0 to"},
        BadFile{"pcd_two_x", "a.pcd", pcd_of("x y z x", "4 4 4 4", "F F F F", "1 1 1 1"), "x, y and z",
                "fields"},
        BadFile{"pcd_three_x", "a.pcd", pcd_of("x y z", "4 4 4", "F F F", "3 1 1"), "x, y and z", "count 1"},
        BadFile{"pcd_size_3", "a.pcd", pcd_of("x y z", "4 3 4", "F F F", "1 1 1"), "SIZE 4 3 4", "1, 2, 4"},
        BadFile{"pcd_short_size", "a.pcd", pcd_of("x y z", "4 4", "F F F", "1 1 1"), "SIZE 4 4", "1, 2, 4"},
        BadFile{"pcd_long_type", "a.pcd", pcd_of("x y z", "4 4 4", "F F F F", "1 1 1"), "TYPE F F F F",
                "one entry"},
        BadFile{"pcd_type_c", "a.pcd", pcd_of("x y z", "4 4 4", "F C F", "1 1 1"), "TYPE F C F", "I, U or F"},
        BadFile{"pcd_half_float", "a.pcd", pcd_of("x y z", "2 4 4", "F F F", "1 1 1"), "2 bytes",
                "4 or 8 bytes"},
        BadFile{"pcd_count_0", "a.pcd", pcd_of("x y z", "4 4 4", "F F F", "1 0 1"), "x, y and z", "count 1"},
        BadFile{"pcd_negative_width", "a.pcd", "FIELDS x y z\nWIDTH -3\nDATA ascii\n", "WIDTH -3", "0 to"},
        BadFile{"pcd_not_the_product", "a.pcd", "FIELDS x y z\nWIDTH 3\nHEIGHT 2\nPOINTS 5\nDATA ascii\n",
                "POINTS 5", "width times the height"},
        BadFile{"pcd_no_points", "a.pcd", pcd("ascii", "", 0), "no points", "at least one"},
        BadFile{"pcd_huge", "a.pcd", "FIELDS x y z\nWIDTH 4294967295\nHEIGHT 4294967295\nDATA binary\n",
                "18446744065119617025 points", "0 bytes"},
        BadFile{"pcd_huge_ascii", "a.pcd", pcd("ascii", "1 2 3\n", 4294967295), "4294967295 points", "bytes"},
        BadFile{"pcd_ascii_truncated", "a.pcd", pcd("ascii", "1.25 2.25 3.25\n", 2), "after 1 points",
                "2 points"},
        BadFile{"pcd_ascii_longer", "a.pcd", pcd("ascii", "1 2 3\n4 5 6\n"), "line 13: \"4 5 6\"", "end"},
        BadFile{"pcd_ascii_short_line", "a.pcd", pcd("ascii", "1.25 2.25\n"), "line 12: 2 values",
                "3 values"},
        BadFile{"pcd_ascii_word", "a.pcd", pcd("ascii", "1.25 two 3\n"), "line 12: \"two\"", "number"},
        BadFile{"pcd_all_nan", "a.pcd", pcd("ascii", "nan nan nan\nnan 1 2\n", 2), "none of them finite",
                "at least one finite"},
        BadFile{"pcd_binary_truncated", "a.pcd", pcd("binary", floats(5), 2), "2 points of 12 bytes",
                "20 bytes"},
        BadFile{"pcd_compressed_no_sizes", "a.pcd", pcd("binary_compressed", "1234567"), "end of file",
                "sizes"},
        BadFile{"pcd_compressed_truncated", "a.pcd",
                pcd("binary_compressed", testing::pcd_compressed(floats(3)).substr(0, 15)), "compressed",
                "7 bytes left"},
        BadFile{"pcd_compressed_other_size", "a.pcd",
                pcd("binary_compressed", testing::pcd_compressed(floats(4))), "16 bytes", "1 points of 12"},
        BadFile{"pcd_compressed_bomb", "a.pcd",
                pcd("binary_compressed", little(3U) + little(4294967292U) + "abc", 357913941),
                "3 bytes of compressed", "4294967292 bytes"},
        BadFile{"pcd_compressed_garbage", "a.pcd",
                pcd("binary_compressed", little(4U) + little(12U) + "\xff\xff\xff\xff"), "does not unfold",
                "12 bytes"},

        BadFile{"las_no_signature", "a.las", std::string(500, 'x'), "\"xxxx\"", "LASF"},
        BadFile{"las_short", "a.las", "LASF and so on", "after 14 bytes", "227 bytes"},
        BadFile{"las_short_header_of_1_4", "a.las", las([](LasFile& f) { f.minor = 4; }).substr(0, 300),
                "after 300 bytes", "375 bytes"},
        BadFile{"las_version_2", "a.las", las_with(24, "\x02"), "LAS version 2.2", "1.0 to 1.4"},
        BadFile{"las_version_1_5", "a.las", las_with(25, "\x05"), "LAS version 1.5", "1.0 to 1.4"},
        BadFile{"las_points_before_header_ends", "a.las", las_with(96, little(100U)), "from byte 100",
                "after it"},
        BadFile{"las_points_after_end", "a.las", las_with(96, little(100000U)), "from byte 100000",
                "after it"},
        BadFile{"las_compressed", "a.laz", las_with(104, "\x80"), "without LASzip's record", "LAZ"},
        BadFile{"las_format_11", "a.las", las_with(104, "\x0b"), "point format 11", "0 to 10"},
        BadFile{"las_short_records", "a.las", las_with(105, little(std::uint16_t{19})), "19 bytes",
                "20 bytes"},
        BadFile{"las_truncated", "a.las", las([](LasFile&) {}).substr(0, 227 + 54 + 39), "2 points of 20",
                "39 bytes"},
        BadFile{"las_huge", "a.las", las_with(247, little(~std::uint64_t{0}), 4), "two numbers of points",
                "one number"},
        BadFile{"las_no_points", "a.las", las([](LasFile& f) { f.points.clear(); }), "no points",
                "at least one"},
        BadFile{"las_zero_scale", "a.las", las([](LasFile& f) { f.scale.y() = 0; }), "scale 0", "not zero"},
        BadFile{"las_nan_offset", "a.las", las([](LasFile& f) { f.offset.z() = kNan; }), "offset nan",
                "finite"},

        BadFile{"xyz_empty", "a.xyz", "\n# nothing\n", "no points", "at least one"},
        BadFile{"xyz_text", "a.txt", "Dear reader,\n", "line 1: \"Dear reader,\"", "names of columns"},
        BadFile{"xyz_columns", "a.csv", "x,y,u\n1,2,3\n", "\"x,y,u\"", "x, y and z"},
        BadFile{"xyz_x_twice", "a.csv", "x,y,z,X\n1,2,3,4\n", "\"x,y,z,X\"", "x, y and z"},
        BadFile{"xyz_two_numbers", "a.xyz", "1 2 3\n4 5\n", "line 2: \"4 5\"", "three coordinates"},
        BadFile{"xyz_word", "a.xyz", "1 2 3\n4 five 6\n", "line 2: \"five\"", "number"},
        BadFile{"xyz_missing_column", "a.csv", "a,x,y,z\n0,1,2,3\n0,1,2\n", "line 3", "three coordinates"},
        BadFile{"xyz_empty_field", "a.csv", "1,,3,4\n", "line 1: \"\"", "number"},
        BadFile{"xyz_decimal_commas", "a.csv", "1,5;2,5;3,5\n1,5;2,5;3,5\n", "line 1", "number"},
        BadFile{"xyz_fewer_than_said", "a.pts", "3\n1 2 3\n4 5 6\n", "2 points", "the 3 points"},
        BadFile{"xyz_all_nan", "a.xyz", "nan nan nan\n", "none of them finite", "at least one finite"},

        BadFile{"kitti_truncated", "a.bin", floats(7), "28 bytes", "multiple of 16"},
        BadFile{"kitti_all_nan", "a.bin", little(float(kNan)) + floats(3), "none of them finite", "finite"},
        BadFile{"nuscenes_truncated", "a.pcd.bin", floats(4), "16 bytes", "multiple of 20"},

        BadFile{"graph_no_scans", "a.graph", testing::to_scan_graph({}), "no points", "at least one"},
        BadFile{"graph_huge", "a.graph", little(~0U) + graph(), "4294967295 scans", "bytes left"},
        BadFile{"graph_huge_scan", "a.graph", little(1U) + little(~0U) + std::string(200, '\0'),
                "4294967295 points", "bytes left"},
        BadFile{"graph_two_dimensions", "a.graph", graph().replace(8, 4, little(2)), "byte 8", "dimension 3"},
        BadFile{"graph_longer", "a.graph", graph() + "x", "1 bytes after", "end of the file"},
        BadFile{"graph_long_quaternion", "a.graph",
                testing::to_scan_graph({{kTriangle, {0, 0, 0}, {1, 1, 0, 0}}}), "length 1.41", "unit"},
        BadFile{"graph_nan_pose", "a.graph",
                testing::to_scan_graph({{kTriangle, {0, kNan, 0}, {1, 0, 0, 0}}}), "a pose", "finite"},
        BadFile{"graph_text_short_pose", "a.graph", "NODE 0 0 0\n1 2 3\n", "line 1: \"\"", "number"},
        BadFile{"graph_text_long_point", "a.graph", "NODE 0 0 0 0 0 0\n1 2 3 4\n", "line 2", "x y z"},
        BadFile{"graph_text_nan_pose", "a.graph", "NODE 0 0 0 0 0 nan\n1 2 3\n", "line 1", "finite"}),
    [](const auto& instance) { return instance.param.name; });

/// Whatever is cut off or overwritten: a result or an InputError, never anything else.
TEST(DamagedClouds, NeverCrashTheReader) {
  Random random(423);
  SCOPED_TRACE(random.trace());
  const TemporaryDirectory directory;
  struct Sound {
    std::string name, bytes;
    /// Whether every shorter file is refused: the format says its length.
    bool has_length;
  };
  const std::string fields = floats(30);
  const std::string compressed =
      testing::pcd_header("x y z label", "4 4 4 4", "F F F U", "1 1 1 2", 6, 1, "binary_compressed") +
      testing::pcd_compressed(fields);
  const Sound sound[] = {
      {"a.stl", testing::to_stl_binary(kTriangle), true},
      {"b.stl", ascii_stl("vertex 0 1 0"), false},          // but for what follows "endsolid"
      {"c.pcd", pcd("ascii", "1 2 3\n4 5 6\n", 2), false},  // but for the last digits
      {"d.pcd", pcd("binary", floats(6), 2), true},
      {"e.pcd", compressed, true},
      {"f.las", las([](LasFile&) {}), true},
      {"g.las", las([](LasFile& f) { f.minor = 4, f.format = 7; }), true},
      {"h.xyz", "x y z\n1 2 3\n4 5 6 7\n", false},
      {"i.bin", floats(8), false},
      {"j.graph", testing::to_scan_graph({{kTriangle, {1, 2, 3}, {0.6, 0.8, 0, 0}}}, 1), true},
      {"k.graph", "NODE 0 0 0 0 0 1\n1 2 3\n4 5 6\n", false}};
  int refused = 0;
  for (const auto& [name, bytes, has_length] : sound) {
    SCOPED_TRACE(name);
    ASSERT_FALSE(read_points(directory.write(name, bytes)).points.empty());
    const auto is_read = [&, &name = name](const std::string& damaged) {
      const auto path = directory.write(name, damaged);
      try {
        const PointFile file = read_points(path);
        EXPECT_FALSE(file.points.empty());
        for (const auto& p : file.points) EXPECT_TRUE(p.allFinite());
        for (const auto& f : file.faces)
          for (const auto v : f) EXPECT_LT(v, file.points.size());
        return true;
      } catch (const InputError&) {
        ++refused;
        return false;
      }
    };
    for (std::size_t length = 0; length < bytes.size(); ++length) {
      const bool read = is_read(bytes.substr(0, length));
      EXPECT_FALSE(has_length && read) << "cut to " << length << " of " << bytes.size() << " bytes";
    }
    for (int k = 0; k < 200; ++k) {
      std::string damaged = bytes;
      for (int n = random.integer(1, 4); n > 0; --n)
        damaged[std::size_t(random.integer(0, int(bytes.size()) - 1))] = char(random.integer(0, 255));
      is_read(damaged);
    }
  }
  EXPECT_GT(refused, 1500);
}

}  // namespace
}  // namespace vericone::files::malformed_clouds_test
