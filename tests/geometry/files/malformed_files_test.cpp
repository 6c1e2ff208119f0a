// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vericone/files/files.h>
#include <vericone/geometry/error.h>

#include "geometry/files/refused_files.h"
#include "geometry/files/written_files.h"
#include "support/random.h"

namespace vericone::files::malformed_files_test {
namespace {

using testing::BadFile, testing::bytes_of, testing::Random, testing::TemporaryDirectory;

class MalformedFiles : public ::testing::TestWithParam<BadFile> {};

TEST_P(MalformedFiles, AreRefusedInOneLine) {
  testing::expect_refused(GetParam(), [](const auto& path) { read_points(path); });
}

const std::string kCube = "0 0 0\n1 0 0\n0 1 0\n";
const std::string kXyz = "property float x\nproperty float y\nproperty float z\n";

std::string ascii_ply(const std::string& elements, const std::string& body) {
  return "ply\nformat ascii 1.0\n" + elements + "end_header\n" + body;
}
std::string binary_ply(const std::string& elements, const std::string& body, bool big = false) {
  return std::string("ply\nformat binary_") + (big ? "big" : "little") + "_endian 1.0\n" + elements +
         "end_header\n" + body;
}
std::string floats(int n) {
  std::string s;
  for (int i = 0; i < n; ++i) s += bytes_of(float(i), std::endian::little);
  return s;
}
const std::string kOneFace = "element face 1\nproperty list uchar int vertex_indices\n";

INSTANTIATE_TEST_SUITE_P(
    Table, MalformedFiles,
    ::testing::Values(
        BadFile{"empty", "a.off", "", "an empty file", "with points"},
        BadFile{"unknown_extension", "a.xzy", "1 2 3\n", "\".xzy\"", ".obj, .off, .pcd, .ply"},
        BadFile{"no_extension", "a", "1 2 3\n", "no extension", "known formats"},
        BadFile{"text_as_obj", "a.obj", "Dear reader,\n", "line 1: \"Dear\"", "statement"},
        BadFile{"control_characters", "a.obj", "\x01\x02\x03\x1b[2J\n", "\"????[2J\"", "statement"},
        BadFile{"text_as_off", "a.off", "Dear reader,\n", "line 1: \"Dear\"", "OFF"},
        BadFile{"text_as_ply", "a.ply", "Dear reader,\n", "\"Dear reader,\"", "ply"},

        BadFile{"off_without_counts", "a.off", "OFF\n", "end of file", "counts"},
        BadFile{"off_word_for_count", "a.off", "OFF\nmany 1 0\n", "line 2: \"many\"", "integer"},
        BadFile{"off_negative_count", "a.off", "OFF\n-3 1 0\n", "-3 vertices", "zero or more"},
        BadFile{"off_one_count", "a.off", "OFF\n3\n", "\"\"", "integer"},
        BadFile{"off_no_vertices", "a.off", "OFF\n0 0 0\n", "no points", "at least one"},
        BadFile{"off_truncated_vertices", "a.off", "OFF\n4 0 0\n0.25 0.25 0.25\n0.5 0.5 0.5\n1 1 1\n",
                "after 3 vertices", "4 vertices"},
        BadFile{"off_truncated_faces", "a.off", "OFF\n3 2 0\n" + kCube + "3 0 1 2\n", "after 1 faces",
                "2 faces"},
        BadFile{"off_two_coordinates", "a.off", "OFF\n3 0 0\n0.5 0 0\n0.5 0\n0.5 0 0\n", "line 4",
                "3 numbers"},
        BadFile{"off_uneven_columns", "a.off", "OFF\n3 0 0\n0 0 0\n0 0 0 1\n0 0 0\n", "a vertex of 4",
                "3 numbers"},
        BadFile{"off_word_coordinate", "a.off", "OFF\n3 0 0\n0 0 0\n0 zero 0\n0 0 0\n", "line 4: \"zero\"",
                "number"},
        BadFile{"off_overflow", "a.off", "OFF\n1 0 0\n0 1e999 0\n", "\"1e999\"", "range of double"},
        BadFile{"off_half_number", "a.off", "OFF\n1 0 0\n0 1.5x 0\n", "\"1.5x\"", "number"},
        BadFile{"off_index_too_large", "a.off", "OFF\n3 1 0\n" + kCube + "3 0 1 3\n", "vertex index 3",
                "at most 2"},
        BadFile{"off_negative_index", "a.off", "OFF\n3 1 0\n" + kCube + "3 0 1 -1\n", "vertex index -1",
                "index"},
        BadFile{"off_short_face", "a.off", "OFF\n3 1 0\n" + kCube + "4 0 1 2\n", "3 vertex indices",
                "4 vertex indices"},
        BadFile{"off_counts_too_low", "a.off", "OFF\n3 1 0\n" + kCube + "3 0 1 2\n3 0 2 1\n", "line 7",
                "the end of the file"},
        BadFile{"off_huge_count", "a.off", "OFF\n1000000000000000000 0 0\n" + kCube, "1000000000000000000",
                "bytes"},
        BadFile{"off_count_beyond_64_bits", "a.off", "OFF\n99999999999999999999 0 0\n" + kCube, "9999",
                "integer"},
        BadFile{"off_huge_face", "a.off", "OFF\n3 1 0\n" + kCube + "1000000000000000000 0 1 2\n", "3 vertex",
                "1000000000000000000"},
        BadFile{"off_four_dimensions", "a.off", "4OFF\n1 0 0\n0 0 0 0\n", "4OFF", "three dimensions"},
        BadFile{"off_n_dimensions", "a.off", "nOFF\n1 0 0\n0 0 0\n", "nOFF", "three dimensions"},
        BadFile{"off_binary", "a.off", "OFF BINARY\n", "binary", "ascii"},
        BadFile{"off_all_nan", "a.off", "OFF\n2 0 0\nnan 0 0\n0 0 inf\n", "none of them finite",
                "at least one finite"},

        BadFile{"obj_no_vertices", "a.obj", "# nothing\n", "no points", "at least one"},
        BadFile{"obj_capital_vertex", "a.obj", "v 1 2 3\nV 1 2 3\n", "line 2: \"V\"", "statement"},
        BadFile{"obj_number_for_statement", "a.obj", "v 1 2 3\n4 5 6\n", "line 2: \"4\"", "statement"},
        BadFile{"obj_two_vertices_in_a_line", "a.obj", "v 0 0 0 v 1 0 0\n", "\"v\"", "number"},
        BadFile{"obj_only_faces", "a.obj", "f 1 2 3\n", "no points", "at least one"},
        BadFile{"obj_two_coordinates", "a.obj", "v 1 2\n", "a vertex of 2 numbers", "x y z"},
        BadFile{"obj_word_coordinate", "a.obj", "v 1 junk 3\n", "\"junk\"", "number"},
        BadFile{"obj_index_zero", "a.obj", "v 0 0 0\nf 0 1 1\n", "vertex index 0", "1 or more"},
        BadFile{"obj_index_too_large", "a.obj", "v 0 0 0\nf 1 1 2\n", "vertex index 1 (from 0)", "1 vertex"},
        BadFile{"obj_index_too_far_back", "a.obj", "v 0 0 0\nf -1 -1 -2\n", "vertex index -2", "1 vertices"},
        BadFile{"obj_two_corners", "a.obj", "v 0 0 0\nf 1 1\n", "2 corners", "three or more"},
        BadFile{"obj_bad_corner", "a.obj", "v 0 0 0\nf 1 1/a 1\n", "\"1/a\"", "corner"},
        BadFile{"obj_real_index", "a.obj", "v 0 0 0\nf 1 1.5 1\n", "\"1.5\"", "integer"},
        BadFile{"obj_huge_index", "a.obj", "v 0 0 0\nf 1 1 99999999999\n", "99999999998", "index"},

        BadFile{"ply_no_end", "a.ply", "ply\nformat ascii 1.0\n", "without end", "end_header"},
        BadFile{"ply_no_format", "a.ply", "ply\nelement vertex 1\n" + kXyz + "end_header\n0 0 0\n",
                "end_header", "format"},
        BadFile{"ply_other_format", "a.ply", "ply\nformat ebcdic 1.0\nend_header\n", "ebcdic", "ascii"},
        BadFile{"ply_other_version", "a.ply", "ply\nformat ascii 2.0\nend_header\n", "2.0", "1.0"},
        BadFile{"ply_garbage_line", "a.ply", "ply\nformat ascii 1.0\nelephant vertex 1\nend_header\n",
                "elephant", "element"},
        BadFile{"ply_no_vertex_element", "a.ply", ascii_ply(kOneFace, "3 0 1 2\n"), "without vertices",
                "element vertex"},
        BadFile{"ply_two_vertex_elements", "a.ply",
                ascii_ply("element vertex 1\n" + kXyz + "element vertex 1\n" + kXyz, "0 0 0 0 0 0\n"),
                "line 7", "another name"},
        BadFile{"ply_zero_vertices", "a.ply", ascii_ply("element vertex 0\n" + kXyz, ""), "no points",
                "at least one"},
        BadFile{"ply_negative_count", "a.ply", ascii_ply("element vertex -1\n" + kXyz, ""), "-1",
                "zero or more"},
        BadFile{"ply_no_z", "a.ply",
                ascii_ply("element vertex 1\nproperty float x\nproperty float y\n", "0 0\n"), "x, y and z",
                "properties"},
        BadFile{"ply_unknown_type", "a.ply", ascii_ply("element vertex 1\nproperty quad x\n", "0\n"), "quad",
                "type"},
        BadFile{"ply_early_property", "a.ply", ascii_ply(kXyz, "0 0 0\n"), "property float x", "element"},
        BadFile{"ply_real_list_count", "a.ply",
                ascii_ply("element vertex 1\nproperty list float int x\n", "0\n"), "list float", "integer"},
        BadFile{"ply_huge_ascii_count", "a.ply",
                ascii_ply("element vertex 1000000000000000000\n" + kXyz, "0 0 0\n"), "1000000000000000000",
                "bytes left"},
        BadFile{"ply_huge_binary_count", "a.ply",
                binary_ply("element vertex 1000000000000000000\n" + kXyz, floats(3)), "1000000000000000000",
                "12 bytes"},
        BadFile{"ply_count_of_2_to_63", "a.ply",
                binary_ply("element vertex 9223372036854775808\n" + kXyz, floats(3)), "9223372036854775808",
                "count"},
        BadFile{"ply_truncated_ascii", "a.ply",
                ascii_ply("element vertex 3\n" + kXyz, "0.25 0.25 0.25\n1.25 1.5 1.75\n2.5 2.5\n"),
                "end of file", "all the data"},
        BadFile{"ply_truncated_binary", "a.ply", binary_ply("element vertex 2\n" + kXyz, floats(5)),
                "2 of element", "20 bytes"},
        BadFile{"ply_truncated_list", "a.ply",
                binary_ply("element vertex 1\n" + kXyz + kOneFace, floats(3) + "\x03" + floats(2)),
                "length 3", "8 bytes"},
        BadFile{"ply_truncated_before_list", "a.ply",
                binary_ply("element vertex 1\n" + kXyz + kOneFace, floats(3), true), "element \"face\"",
                "0 bytes"},
        BadFile{"ply_trailing_ascii", "a.ply", ascii_ply("element vertex 1\n" + kXyz, "0 0 0\n1 1 1\n"),
                "\"1\" in line 9", "end of the file"},
        BadFile{"ply_word_coordinate", "a.ply", ascii_ply("element vertex 1\n" + kXyz, "0 zero 0\n"),
                "\"zero\" in line 8", "number"},
        BadFile{"ply_index_too_large", "a.ply",
                ascii_ply("element vertex 3\n" + kXyz + kOneFace, kCube + "3 0 1 3\n"), "vertex index 3",
                "at most 2"},
        BadFile{"ply_negative_index", "a.ply",
                ascii_ply("element vertex 3\n" + kXyz + kOneFace, kCube + "3 0 1 -2\n"),
                "face 0: vertex index -2", "index"},
        BadFile{"ply_real_index", "a.ply",
                ascii_ply("element vertex 3\n" + kXyz + kOneFace, kCube + "3 0 1 1.5\n"), "\"1.5\"",
                "integer"},
        BadFile{"ply_negative_list", "a.ply",
                ascii_ply("element vertex 3\n" + kXyz + kOneFace, kCube + "-3 0 1 2\n"), "length -3",
                "length"},
        BadFile{"ply_huge_list", "a.ply",
                ascii_ply("element vertex 3\n" + kXyz + kOneFace, kCube + "1e18 0 1 2\n"), "1e+18", "length"},
        BadFile{"ply_infinite_list", "a.ply",
                ascii_ply("element vertex 3\n" + kXyz + kOneFace, kCube + "inf 0 1 2\n"), "inf", "length"},
        BadFile{"ply_float_indices", "a.ply",
                ascii_ply("element vertex 3\n" + kXyz +
                              "element face 1\nproperty list uchar float vertex_indices\n",
                          kCube + "3 0 1 2\n"),
                "floating-point", "integer"}),
    [](const auto& instance) { return instance.param.name; });

TEST(MissingFiles, AreRefused) {
  const TemporaryDirectory directory;
  const auto message = [](const std::filesystem::path& path) -> std::string {
    try {
      read_points(path);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  };
  const std::string absent = (directory.path() / "absent.off").string();
  EXPECT_EQ(message(absent), absent + ": got no such file, must be the path of a file");
  EXPECT_THAT(message(directory.path()), ::testing::HasSubstr("a directory"));
  EXPECT_THAT(message(directory.path() / "two\nlines.off"), ::testing::Not(::testing::HasSubstr("\n")));
}

/// Whatever is cut off or overwritten: a result or an InputError, never anything else.
TEST(DamagedFiles, NeverCrashTheReader) {
  Random random(410);
  SCOPED_TRACE(random.trace());
  const TemporaryDirectory directory;
  const std::string elements = "element vertex 3\n" + kXyz + kOneFace;
  std::string face(1, '\x03');
  for (const int v : {0, 1, 2}) face += bytes_of(v, std::endian::little);
  const std::pair<std::string, std::string> sound[] = {
      {"a.ply", ascii_ply(elements, kCube + "3 0 1 2\n")},
      {"b.ply", binary_ply(elements, floats(9) + face)},
      {"c.off", "OFF\n3 1 0\n" + kCube + "3 0 1 2\n"},
      {"d.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/1/1 2//2 -1\n"}};
  int refused = 0;
  for (const auto& [name, bytes] : sound) {
    ASSERT_EQ(read_points(directory.write(name, bytes)).faces.size(), 1U) << name;
    const auto attempt = [&, &name = name](const std::string& damaged) {
      const auto path = directory.write(name, damaged);
      try {
        EXPECT_FALSE(read_points(path).points.empty());
      } catch (const InputError&) {
        ++refused;
      }
    };
    for (std::size_t length = 0; length < bytes.size(); ++length) attempt(bytes.substr(0, length));
    for (int k = 0; k < 500; ++k) {
      std::string damaged = bytes;
      for (int n = random.integer(1, 4); n > 0; --n)
        damaged[std::size_t(random.integer(0, int(bytes.size()) - 1))] = char(random.integer(0, 255));
      attempt(damaged);
    }
  }
  EXPECT_GT(refused, 500);
}

}  // namespace
}  // namespace vericone::files::malformed_files_test
