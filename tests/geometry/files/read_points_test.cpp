// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vericone/files/files.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/files/extensions.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <limits>

#include "geometry/files/written_files.h"
#include "support/random.h"

namespace vericone::files::read_points_test {
namespace {

using Eigen::Vector3d;
using testing::bytes_of, testing::Random, testing::TemporaryDirectory;
using ::testing::ElementsAre;

struct Mesh {
  std::vector<Vector3d> points;
  std::vector<Face> faces;
};

/// All the digits that a double has, and its extremes.
Mesh hard_mesh() {
  Random random(401);
  Mesh mesh;
  for (int i = 0; i < 500; ++i)
    mesh.points.push_back(random.vector<3>() * std::pow(10, random.integer(-300, 300)));
  constexpr double kMost = std::numeric_limits<double>::max(),
                   kLeast = std::numeric_limits<double>::denorm_min();
  mesh.points.emplace_back(kMost, -kMost, std::numeric_limits<double>::min());
  mesh.points.emplace_back(kLeast, -kLeast, -0.0);
  mesh.points.emplace_back(0.1, 1.0 / 3, std::nextafter(1.0, 2.0));
  for (int i = 0; i < 300; ++i) {
    mesh.faces.emplace_back();
    for (int k = random.integer(3, 6); k > 0; --k)
      mesh.faces.back().push_back(std::uint32_t(random.integer(0, 501)));
  }
  return mesh;
}

std::string digits(double x) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", x);
  return text;
}
std::string digits(const Vector3d& p) { return digits(p.x()) + " " + digits(p.y()) + " " + digits(p.z()); }

std::string to_off(const Mesh& mesh) {
  std::string text =
      "OFF\n" + std::to_string(mesh.points.size()) + " " + std::to_string(mesh.faces.size()) + " 0\n";
  for (const auto& p : mesh.points) text += digits(p) + "\n";
  for (const auto& f : mesh.faces) {
    text += std::to_string(f.size());
    for (const auto v : f) text.append(1, ' ').append(std::to_string(v));
    text += "\n";
  }
  return text;
}

std::string to_obj(const Mesh& mesh) {
  std::string text = "# a mesh\no thing\n";
  for (const auto& p : mesh.points) text += "v " + digits(p) + "\n";
  for (const auto& f : mesh.faces) {
    text += "f";
    for (const auto v : f) text.append(1, ' ').append(std::to_string(v + 1));
    text += "\n";
  }
  return text;
}

std::string ply_header(const std::string& format, const Mesh& mesh, const std::string& type) {
  return "ply\nformat " + format + " 1.0\ncomment made by a test\nelement vertex " +
         std::to_string(mesh.points.size()) + "\nproperty " + type + " x\nproperty " + type +
         " y\nproperty " + type + " z\nelement face " + std::to_string(mesh.faces.size()) +
         "\nproperty list uchar int vertex_indices\nend_header\n";
}

std::string to_ply_ascii(const Mesh& mesh) {
  std::string text = ply_header("ascii", mesh, "double");
  const std::string off = to_off(mesh);
  return text + off.substr(off.find('\n', 4) + 1);
}

template <typename Scalar>
std::string to_ply_binary(const Mesh& mesh, std::endian order) {
  std::string text = ply_header(order == std::endian::little ? "binary_little_endian" : "binary_big_endian",
                                mesh, sizeof(Scalar) == 4 ? "float" : "double");
  for (const auto& p : mesh.points)
    for (const double x : p) text += bytes_of(Scalar(x), order);
  for (const auto& f : mesh.faces) {
    text += bytes_of(std::uint8_t(f.size()), order);
    for (const auto v : f) text += bytes_of(std::int32_t(v), order);
  }
  return text;
}

/// Bit for bit, so that -0 is not 0.
void expect_same(const PointFile& file, const Mesh& mesh) {
  ASSERT_EQ(file.points.size(), mesh.points.size());
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    for (int k = 0; k < 3; ++k)
      EXPECT_EQ(std::bit_cast<std::uint64_t>(file.points[i](k)),
                std::bit_cast<std::uint64_t>(mesh.points[i](k)))
          << "point " << i << " " << digits(mesh.points[i]);
  EXPECT_EQ(file.faces, mesh.faces);
  EXPECT_EQ(file.dropped_points, 0U);
  EXPECT_EQ(file.dropped_faces, 0U);
}

class ReadPoints : public ::testing::Test {
 protected:
  PointFile read(const std::string& name, const std::string& bytes) const {
    return read_points(directory_.write(name, bytes));
  }

  TemporaryDirectory directory_;
};

TEST_F(ReadPoints, EveryFormatKeepsEveryBit) {
  const Mesh mesh = hard_mesh();
  expect_same(read("a.off", to_off(mesh)), mesh);
  expect_same(read("a.obj", to_obj(mesh)), mesh);
  expect_same(read("a.ply", to_ply_ascii(mesh)), mesh);
  expect_same(read("b.ply", to_ply_binary<double>(mesh, std::endian::little)), mesh);
  expect_same(read("c.ply", to_ply_binary<double>(mesh, std::endian::big)), mesh);
}

TEST_F(ReadPoints, BinaryFloatsAreKeptExactly) {
  Mesh mesh;
  Random random(402);
  for (int i = 0; i < 100; ++i) mesh.points.push_back(random.vector<3>().cast<float>().cast<double>());
  mesh.faces = {{0, 1, 2}};
  expect_same(read("a.ply", to_ply_binary<float>(mesh, std::endian::little)), mesh);
  expect_same(read("b.ply", to_ply_binary<float>(mesh, std::endian::big)), mesh);
}

TEST_F(ReadPoints, NamesTheFormat) {
  const Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  EXPECT_EQ(read("a.OFF", to_off(mesh)).format, "OFF");
  EXPECT_EQ(read("a.Obj", to_obj(mesh)).format, "OBJ");
  EXPECT_EQ(read("a.ply", to_ply_ascii(mesh)).format, "PLY ascii");
  EXPECT_EQ(read("a.ply", to_ply_binary<double>(mesh, std::endian::big)).format, "PLY binary_big_endian");
  // The signature tells, whatever the name.
  EXPECT_EQ(read("noname", to_off(mesh)).format, "OFF");
  EXPECT_EQ(read("mesh.off", to_ply_binary<double>(mesh, std::endian::little)).format,
            "PLY binary_little_endian");
  EXPECT_THAT(known_extensions(), ElementsAre(".dae", ".glb", ".gltf", ".graph", ".las", ".laz", ".obj",
                                              ".off", ".pcd", ".ply", ".ptx", ".stl", ".xyz"));
}

TEST_F(ReadPoints, OffVariants) {
  const auto file =
      read("a.off",
           "# made by hand\r\nCOFF 4 2 0 # counts here\r\n\r\n0 0 0 255 0 0 255\r\n+1 0 0 0 255 0 255\r\n"
           "1. 1e0 .0 0 0 255 255\r\n  0\t1 0 0 0 0 255\r\n4 0 1 2 3 0.5 0.5 0.5\r\n3 0 1 2");
  EXPECT_THAT(file.points,
              ElementsAre(Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(1, 1, 0), Vector3d(0, 1, 0)));
  EXPECT_THAT(file.faces, ElementsAre(Face{0, 1, 2, 3}, Face{0, 1, 2}));
  EXPECT_EQ(triangles_of(file.points, file.faces).size(), 3U);
  // Without edges, without faces, with the points and segments that the format allows.
  EXPECT_EQ(read("b.off", "OFF\n1 0\n1 2 3\n").points.size(), 1U);
  const auto segments = read("c.off", "OFF 3 3 0\n0 0 0\n1 0 0\n0 1 0\n1 0\n2 0 1\n3 0 1 2\n");
  EXPECT_EQ(segments.faces.size(), 1U);
  EXPECT_EQ(segments.dropped_faces, 2U);
}

TEST_F(ReadPoints, ObjVariants) {
  const auto file = read("a.obj",
                         "mtllib none.mtl\nv 0 0 0\nv 1 0 0 1.0\nv 1 1 0 0.5 0.5 0.5\nvt 0 0\nvn 0 0 1\n"
                         "usemtl red\ns off\nf 1/1/1 2/1/1 \\\n 3/1/1\nv 0 1 0\nf -4//1 -2//1 -1//1\nf 1/1 "
                         "2/1 3/1 4/1\nl 1 2\n");
  EXPECT_THAT(file.points,
              ElementsAre(Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(1, 1, 0), Vector3d(0, 1, 0)));
  EXPECT_THAT(file.faces, ElementsAre(Face{0, 1, 2}, Face{0, 2, 3}, Face{0, 1, 2, 3}));
  // A face may come before its vertices.
  EXPECT_EQ(read("b.obj", "f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n").faces.size(), 1U);
}

TEST_F(ReadPoints, PlyVariants) {
  // Other properties around the coordinates, lists among them, other elements before and after, faces first.
  const std::string header =
      "element camera 1\nproperty float view\nproperty list uchar double matrix\n"
      "element face 2\nproperty uchar flags\nproperty list uint8 uint32 vertex_index\nproperty float "
      "quality\n"
      "element vertex 4\nproperty uchar red\nproperty float64 z\nproperty list int short "
      "neighbours\nproperty double x\n"
      "property double y\nproperty float intensity\n"
      "element range_grid 3\nproperty list uchar int vertex_indices\nelement empty 7\nend_header\n";
  const auto check = [](const PointFile& file) {
    EXPECT_THAT(file.points,
                ElementsAre(Vector3d(0, 0, 5), Vector3d(1, 0, 5), Vector3d(1, 1, 5), Vector3d(0, 1, 5)));
    EXPECT_THAT(file.faces, ElementsAre(Face{0, 1, 2}, Face{0, 1, 2, 3}));
  };
  const std::string ascii =
      "0.5 2 1 2\n7 3 0 1 2 0.5\n7 4 0 1 2 3 0.5\n1 5 0 0 0 9\n2 5 2 -1 -2 1 0 9\n3 5 0 1 1 9\n4 5 1 7 0 1 "
      "9\n0\n1 3\n1 0\n";
  check(read("a.ply", "ply\nformat ascii 1.0\nobj_info num_cols 512\n" + header + ascii));
  std::string crlf;
  for (const char c : "ply\nformat ascii 1.0\n" + header + ascii)
    crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
  check(read("b.ply", crlf));
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    std::string body;
    const auto put = [&](auto x) { body += bytes_of(x, order); };
    put(0.5F), put(std::uint8_t{2}), put(1.0), put(2.0);
    put(std::uint8_t{7}), put(std::uint8_t{3});
    for (std::uint32_t i = 0; i < 3; ++i) put(i);
    put(0.5F);
    put(std::uint8_t{7}), put(std::uint8_t{4});
    for (std::uint32_t i = 0; i < 4; ++i) put(i);
    put(0.5F);
    for (int i = 0; i < 4; ++i) {
      put(std::uint8_t(i)), put(5.0), put(std::int32_t(i));
      for (int k = 0; k < i; ++k) put(std::int16_t(-k));
      put(i == 1 || i == 2 ? 1.0 : 0.0), put(i >= 2 ? 1.0 : 0.0), put(9.0F);
    }
    put(std::uint8_t{0}), put(std::uint8_t{1}), put(std::int32_t{3}), put(std::uint8_t{1}),
        put(std::int32_t{0});
    check(read("c.ply", std::string("ply\nformat binary_") +
                            (order == std::endian::little ? "little" : "big") + "_endian 1.0\n" + header +
                            body));
  }
}

TEST_F(ReadPoints, PlyTriangleStrips) {
  const auto file =
      read("a.ply",
           "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
           "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
           "0 0 0 1 0 0 0 1 0 1 1 0 0 2 0\n9 0 1 2 3 -1 2 3 4 -1\n");
  EXPECT_THAT(file.faces, ElementsAre(Face{0, 1, 2}, Face{2, 1, 3}, Face{2, 3, 4}));
}

TEST_F(ReadPoints, PointsThatAreNotFiniteAreDroppedAndCounted) {
  const auto file =
      read("a.off", "OFF\n6 3 0\n0 0 0\nnan 0 0\n1 0 0\n0 inf 0\n0 1 0\n9 9 9\n3 0 2 4\n3 0 1 2\n3 2 4 0\n");
  EXPECT_THAT(file.points,
              ElementsAre(Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(9, 9, 9)));
  EXPECT_THAT(file.faces, ElementsAre(Face{0, 1, 2}, Face{1, 2, 0}));
  EXPECT_EQ(file.dropped_points, 2U);
  EXPECT_EQ(file.dropped_faces, 1U);
  EXPECT_EQ(file.unreferenced_points, 1U);
  const auto cloud = read("b.obj", "v NaN NaN NaN\nv 1 2 3\nv -Infinity 0 0\nv -nan 0 0\n");
  EXPECT_THAT(cloud.points, ElementsAre(Vector3d(1, 2, 3)));
  EXPECT_EQ(cloud.dropped_points, 3U);
  EXPECT_EQ(cloud.unreferenced_points, 1U);
}

TEST_F(ReadPoints, NumbersTooSmallForADoubleAreZero) {
  const auto file = read("a.obj", "v 1e-400 -1e-400 4e-324\n");
  EXPECT_EQ(file.points.front(), Vector3d(0, 0, std::numeric_limits<double>::denorm_min()));
}

/// What other readers take: line ends of every kind, blanks after a word, statements of vendors, bytes after
/// the data. Each gives the points and faces of the plain file.
class OtherWriters : public ::testing::Test {
 protected:
  PointFile read(const std::string& name, const std::string& bytes) {
    return read_points(directory_.write(name, bytes));
  }
  static std::string with_line_ends(std::string text, const std::string& end) {
    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += end.size())
      text.replace(at, 1, end);
    return text;
  }
  TemporaryDirectory directory_;
};

TEST_F(OtherWriters, EndLinesInThreeWays) {
  const Mesh mesh = hard_mesh();
  std::string cloud;
  for (const auto& p : mesh.points) cloud += digits(p) + "\n";
  const std::string pcd = "# .PCD v0.7\nFIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " +
                          std::to_string(mesh.points.size()) + "\nHEIGHT 1\nDATA ascii\n" + cloud;
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    SCOPED_TRACE(end.size() + int(end[0]));
    expect_same(read("a.obj", with_line_ends(to_obj(mesh), end)), mesh);
    expect_same(read("a.off", with_line_ends(to_off(mesh), end)), mesh);
    expect_same(read("a.ply", with_line_ends(to_ply_ascii(mesh), end)), mesh);
    expect_same(read("a.xyz", with_line_ends(cloud, end)), {mesh.points, {}});
    expect_same(read("a.pcd", with_line_ends(pcd, end)), {mesh.points, {}});
    // A binary body may begin with the byte of a line end, and holds others.
    const std::string binary = to_ply_binary<double>(mesh, std::endian::little);
    const std::size_t body = binary.find("end_header\n") + 11;
    expect_same(read("b.ply", with_line_ends(binary.substr(0, body), end) + binary.substr(body)), mesh);
  }
  const std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty uchar u\nproperty float x\n"
      "property float y\nproperty float z\nend_header\n";
  for (const std::string end : {"\n", "\r\n", "\r"})
    EXPECT_THAT(read("c.ply", with_line_ends(header, end) + "\n" + std::string(12, '\0')).points,
                ElementsAre(Vector3d(0, 0, 0)));
}

TEST_F(OtherWriters, MessagesCountLinesOfEveryKind) {
  for (const std::string end : {"\n", "\r\n", "\r"}) try {
      read("a.obj", with_line_ends("v 0 0 0\n# so\n\nv 0 zero 0\n", end));
      ADD_FAILURE();
    } catch (const InputError& error) {
      EXPECT_THAT(error.value(), ::testing::HasSubstr("line 4: \"zero\""));
    }
}

TEST_F(OtherWriters, LeaveBlanksAfterWords) {
  const Mesh mesh = hard_mesh();
  std::string ply = to_ply_ascii(mesh);
  const std::size_t body = ply.find("end_header\n") + 11;
  ply = with_line_ends(ply.substr(0, body), " \t\n") + ply.substr(body);
  expect_same(read("told by its first bytes", ply), mesh);
}

TEST_F(OtherWriters, AddStatements) {
  const Mesh mesh = hard_mesh();
  std::string obj = to_obj(mesh);
  obj.insert(obj.find("\nf") + 1, "vw 0 0 0.5 1 0.5\nxyz_vendor:thing 1 2\nusemtl a\nkd 0.1\n");
  expect_same(read("a.obj", obj), mesh);
}

TEST_F(OtherWriters, LeaveBytesAfterTheData) {
  const Mesh mesh = hard_mesh();
  for (const std::string more : {"\n", "x", "\r\n\r\nmade by nobody"}) {
    const PointFile file = read("a.ply", to_ply_binary<double>(mesh, std::endian::big) + more);
    expect_same(file, mesh);
    EXPECT_EQ(file.trailing_bytes, more.size());
  }
  EXPECT_EQ(read("b.ply", to_ply_binary<double>(mesh, std::endian::big)).trailing_bytes, 0U);
  EXPECT_EQ(read("c.ply", to_ply_ascii(mesh) + " \n\n").trailing_bytes, 0U);
}

}  // namespace
}  // namespace vericone::files::read_points_test
