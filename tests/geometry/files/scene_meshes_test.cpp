// SPDX-License-Identifier: BSD-3-Clause
//
// glTF and COLLADA: scenes written here, against closed forms and against each other; and damaged files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vericone/files/files.h>
#include <Eigen/Geometry>
#include <nlohmann/json.hpp>
#include <sstream>

#include "geometry/files/refused_files.h"
#include "geometry/files/written_files.h"
#include "support/random.h"

namespace vericone::files::scene_meshes_test {
namespace {

using Eigen::Matrix4d, Eigen::Vector3d;
using nlohmann::json;
using testing::BadFile, testing::bytes_of, testing::Random, testing::TemporaryDirectory;

template <typename T>
std::string packed(std::initializer_list<double> values) {
  std::string bytes;
  for (const double x : values) bytes += bytes_of(static_cast<T>(x), std::endian::little);
  return bytes;
}

std::string in_base64(const std::string& bytes) {
  const char* const digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k)
      three = three << 8 | (i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      out += i + k > bytes.size() ? '=' : digits[three >> (18 - 6 * k) & 63];
  }
  return out;
}

/// A glTF file in the making.
struct Written {
  json root = {{"asset", {{"version", "2.0"}}}};
  std::string bytes;

  /// The number of a new accessor of these bytes.
  int accessor(const std::string& data, int component, const char* type, int count, json more = {}) {
    root["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", data.size()}});
    bytes += data;
    json one = {{"bufferView", root["bufferViews"].size() - 1},
                {"componentType", component},
                {"type", type},
                {"count", count}};
    if (more.is_object()) one.update(more);
    root["accessors"].push_back(one);
    return int(root["accessors"].size()) - 1;
  }
  int mesh(json primitive) {
    root["meshes"].push_back({{"primitives", {primitive}}});
    return int(root["meshes"].size()) - 1;
  }
  std::string glb() const {
    json whole = root;
    whole["buffers"] = {{{"byteLength", bytes.size()}}};
    std::string text = whole.dump(), data = bytes;
    text.resize((text.size() + 3) / 4 * 4, ' ');
    data.resize((data.size() + 3) / 4 * 4, '\0');
    const auto word = [](std::size_t x) { return bytes_of(std::uint32_t(x), std::endian::little); };
    return "glTF" + word(2) + word(12 + 8 + text.size() + 8 + data.size()) + word(text.size()) + "JSON" +
           text + word(data.size()) + std::string("BIN\0", 4) + data;
  }
  std::string gltf(const std::string& uri) const {
    json whole = root;
    whole["buffers"] = {{{"byteLength", bytes.size()}, {"uri", uri}}};
    return whole.dump();
  }
};

/// A tetrahedron, its sides outwards.
Written tetrahedron() {
  Written w;
  const int at = w.accessor(packed<float>({0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 0.1}), 5126, "VEC3", 4),
            corners =
                w.accessor(packed<std::uint16_t>({0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}), 5123, "SCALAR", 12);
  w.mesh({{"attributes", {{"POSITION", at}}}, {"indices", corners}});
  return w;
}

double volume_of(const PointFile& file) {
  double six = 0;
  for (const auto& t : triangles_of(file.points, file.faces))
    six += file.points[t[0]].dot(file.points[t[1]].cross(file.points[t[2]]));
  return six / 6;
}

PointFile read(const std::string& name, const std::string& bytes) {
  const TemporaryDirectory directory;
  return read_points(directory.write(name, bytes));
}

TEST(Gltf, OfTrianglesStandsUpright) {
  Written w = tetrahedron();
  const PointFile file = read("a.glb", w.glb());
  EXPECT_EQ(file.format, "glTF 2.0 binary");
  // Up is y in the file, and z here; floats are kept.
  EXPECT_EQ(file.points, (std::vector<Vector3d>{{0, 0, 0}, {0, 0, 2}, {1, 0, 0}, {0, -double(0.1F), 0}}));
  EXPECT_EQ(file.faces, (std::vector<Face>{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {2, 1, 3}}));
  EXPECT_NEAR(volume_of(file), 0.1 * 2 / 6, 1e-8);
}

/// Nodes may place all faces beyond the doubles, but for a corner at the origin.
TEST(Gltf, WhoseFacesAreNotFiniteIsNoCloud) {
  Written w;
  const int at = w.accessor(packed<float>({0, 0, 0, 2, 0, 0, 0, 2, 0}), 5126, "VEC3", 3);
  w.mesh({{"attributes", {{"POSITION", at}}}});
  w.root["nodes"].push_back({{"mesh", 0}, {"scale", {1e308, 1e308, 1e308}}});
  w.root["scenes"].push_back({{"nodes", {0}}});
  try {
    static_cast<void>(read("a.glb", w.glb()));
    ADD_FAILURE() << "a cloud";
  } catch (const InputError& e) {
    EXPECT_EQ(e.value(), "1 faces, all with points that are not finite");
  }
}

TEST(Gltf, IsTheSameWhereverItsBytesAre) {
  const TemporaryDirectory directory;
  const Written w = tetrahedron();
  const PointFile glb = read_points(directory.write("a.glb", w.glb()));
  std::filesystem::create_directory(directory.path() / "in");
  directory.write("in/with blank.bin", w.bytes);
  for (const std::string& uri :
       {"data:application/octet-stream;base64," + in_base64(w.bytes), std::string("in/with%20blank.bin")}) {
    const PointFile file = read_points(directory.write("a.gltf", w.gltf(uri)));
    EXPECT_EQ(file.points, glb.points);
    EXPECT_EQ(file.faces, glb.faces);
  }
  EXPECT_EQ(read_points(directory.write("b.glb", w.glb() + "more")).trailing_bytes, 4U);
}

/// All kinds of numbers, apart from each other, replaced here and there, as strips and fans.
TEST(Gltf, HasItsNumbersInManyKinds) {
  const std::vector<Vector3d> square = {{0, 0, 0}, {1, 0, 0}, {0, 0, -1}, {1, 0, -1}};
  const auto points_of = [&](const Written& w) { return read("a.glb", w.glb()).points; };
  const auto with = [](Written& w, int position, int mode = 5) {
    w.mesh({{"attributes", {{"POSITION", position}}}, {"mode", mode}});
    return w;
  };
  const std::vector<Vector3d> upright = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  {
    Written w;
    const int at = w.accessor(packed<std::int8_t>({0, 0, 0, 127, 0, 0, 0, 0, -127, 127, 0, -128}), 5120,
                              "VEC3", 4, {{"normalized", true}});
    EXPECT_EQ(points_of(with(w, at)), upright);
  }
  {
    Written w;
    const int at = w.accessor(packed<std::int16_t>({0, 0, 0, 1, 0, 0, 0, 0, -1, 1, 0, -1}), 5122, "VEC3", 4);
    EXPECT_EQ(points_of(with(w, at)), upright);
  }
  {  // 20 bytes apart, after 4 others
    Written w;
    std::string bytes = "junk";
    for (const Vector3d& x : square) bytes += packed<float>({x(0), x(1), x(2), 7, 8});
    const int at = w.accessor(bytes, 5126, "VEC3", 4, {{"byteOffset", 4}});
    w.root["bufferViews"][0]["byteStride"] = 20;
    EXPECT_EQ(points_of(with(w, at)), upright);
  }
  {  // zeros, of which two are replaced by others
    Written w;
    const int numbers = w.accessor(packed<std::uint8_t>({1, 2, 3}), 5121, "SCALAR", 3);
    const int values = w.accessor(packed<float>({1, 0, 0, 0, 0, -1, 1, 0, -1}), 5126, "VEC3", 3);
    w.root["accessors"].push_back({{"componentType", 5126},
                                   {"type", "VEC3"},
                                   {"count", 4},
                                   {"sparse",
                                    {{"count", 3},
                                     {"indices", {{"bufferView", numbers}, {"componentType", 5121}}},
                                     {"values", {{"bufferView", values}}}}}});
    EXPECT_EQ(points_of(with(w, 2)), upright);
  }
  // A strip's triangles turn alike, and so do a fan's.
  for (const int mode : {5, 6}) {
    Written w;
    const auto order = mode == 5 ? packed<std::uint32_t>({0, 1, 2, 3}) : packed<std::uint32_t>({0, 1, 3, 2});
    const int at = w.accessor(packed<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}), 5126, "VEC3", 4),
              corners = w.accessor(order, 5125, "SCALAR", 4);
    w.mesh({{"attributes", {{"POSITION", at}}}, {"mode", mode}, {"indices", corners}});
    const PointFile file = read("a.glb", w.glb());
    ASSERT_EQ(file.faces.size(), 2U);
    for (const Face& f : file.faces) {
      const Vector3d normal =
          (file.points[f[1]] - file.points[f[0]]).cross(file.points[f[2]] - file.points[f[0]]);
      EXPECT_EQ(normal, Vector3d(0, -1, 0)) << mode;
    }
  }
  // Points alone are a cloud; lines are none of it.
  Written w;
  const int at = w.accessor(packed<float>({1, 2, 3, 1, 2, 3}), 5126, "VEC3", 2);
  w.mesh({{"attributes", {{"POSITION", at}}}, {"mode", 0}});
  w.mesh({{"attributes", {{"POSITION", at}}}, {"mode", 1}});
  EXPECT_EQ(points_of(w), (std::vector<Vector3d>{{1, -3, 2}, {1, -3, 2}}));
}

/// Nodes in one another, by matrices or by their parts: against products of 4x4 matrices.
TEST(Gltf, IsPlacedByItsNodes) {
  Random random(71);
  SCOPED_TRACE(random.trace());
  const auto homogeneous = [](const Eigen::Matrix3d& linear, const Vector3d& shift) {
    Matrix4d m = Matrix4d::Identity();
    m.topLeftCorner<3, 3>() = linear;
    m.topRightCorner<3, 1>() = shift;
    return m;
  };
  Eigen::Matrix3d up;
  up << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  for (int i = 0; i < testing::share(300); ++i) {
    Written w = tetrahedron();
    Matrix4d whole = homogeneous(up, Vector3d::Zero());
    const int depth = random.integer(1, 4);
    for (int k = 0; k < depth; ++k) {
      const Vector3d shift = random.vector<3>(), scale = random.vector<3>();
      const Eigen::Quaterniond turn(
          Eigen::AngleAxisd(random.uniform(-3, 3), random.vector<3>().normalized()));
      const Matrix4d local =
          homogeneous(turn.toRotationMatrix() * Eigen::Matrix3d(scale.asDiagonal()), shift);
      json node;
      if (random.integer(0, 1)) {
        node["matrix"] = std::vector<double>(local.data(), local.data() + 16);
      } else {
        node["translation"] = {shift(0), shift(1), shift(2)};
        node["rotation"] = {turn.x(), turn.y(), turn.z(), turn.w()};
        node["scale"] = {scale(0), scale(1), scale(2)};
      }
      if (k + 1 < depth)
        node["children"] = {k + 1};
      else
        node["mesh"] = 0;
      w.root["nodes"].push_back(node);
      whole = whole * local;
    }
    w.root["scenes"].push_back({{"nodes", {0}}});
    const PointFile file = read("a.glb", w.glb());
    const Vector3d sound[] = {{0, 0, 0}, {0, 2, 0}, {1, 0, 0}, {0, 0, double(0.1F)}};
    const bool mirrors = whole.determinant() < 0;
    const std::size_t order[] = {0, mirrors ? 2U : 1U, mirrors ? 1U : 2U, 3};
    ASSERT_EQ(file.points.size(), 4U);
    for (std::size_t k = 0; k < 4; ++k) {
      const Vector3d expected = (whole * sound[order[k]].homogeneous()).head<3>();
      double nearest = 1;
      for (const Vector3d& p : file.points) nearest = std::min(nearest, (p - expected).norm());
      EXPECT_LT(nearest, 1e-12 * (1 + whole.norm()));
    }
    // What is mirrored still looks outwards.
    EXPECT_NEAR(volume_of(file), std::abs(whole.determinant()) * double(0.1F) / 3,
                1e-12 * (1 + std::pow(whole.norm(), 3)));
  }
}

TEST(Gltf, OfAMeshInTwoPlacesHasItTwice) {
  Written w = tetrahedron();
  w.root["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"translation", {0, 2, 0}}}, {{"children", {0, 1}}}};
  const PointFile file = read("a.glb", w.glb());
  EXPECT_EQ(file.points.size(), 7U);  // one corner of both
  EXPECT_EQ(file.faces.size(), 8U);
}

// COLLADA.

/// A bar of one polygon with a dent at each end, twice: as it is and as `nodes` places it.
std::string dae(const std::string& asset, const std::string& geometry, const std::string& nodes) {
  return "<?xml version=\"1.0\"?>\n<COLLADA version=\"1.4.1\"><asset>" + asset +
         "</asset>\n<library_geometries><geometry id=\"g\"><mesh>\n" + geometry +
         "\n</mesh></geometry></library_geometries>\n" + "<library_visual_scenes><visual_scene id=\"v\">" +
         nodes +
         "</visual_scene></library_visual_scenes><scene><instance_visual_scene "
         "url=\"#v\"/></scene></COLLADA>";
}
std::string points_of_dae(const std::string& numbers, int count) {
  return "<source id=\"s\"><float_array id=\"f\">" + numbers +
         "</float_array><technique_common><accessor source=\"#f\" count=\"" + std::to_string(count) +
         "\" stride=\"3\"><param name=\"X\"/><param name=\"Y\"/><param "
         "name=\"Z\"/></accessor></technique_common>"
         "</source><vertices id=\"n\"><input semantic=\"POSITION\" source=\"#s\"/></vertices>";
}
const std::string kInput = "<input semantic=\"VERTEX\" source=\"#n\" offset=\"0\"/>";
const std::string kPlaced = "<node><instance_geometry url=\"#g\"/></node>";
const std::string kSquare = points_of_dae("0 0 0 1 0 0 1 1 0 0 1 0", 4);

TEST(Dae, IsInMetresAndUpright) {
  const std::string face = "<polylist count=\"1\">" + kInput + "<vcount>3</vcount><p>0 1 2</p></polylist>";
  const std::string points = points_of_dae("0 0 0 1 0 0 2 4 8", 3);
  const auto read_with = [&](const std::string& asset) {
    const PointFile file = read("a.dae", dae(asset, points + face, kPlaced));
    return std::pair(file.points.at(1), file.points.at(2));
  };
  using Two = std::pair<Vector3d, Vector3d>;
  EXPECT_EQ(read_with("<up_axis>Z_UP</up_axis>"), Two({1, 0, 0}, {2, 4, 8}));
  EXPECT_EQ(read_with("<up_axis> Y_UP </up_axis>"), Two({1, 0, 0}, {2, -8, 4}));
  EXPECT_EQ(read_with(""), Two({1, 0, 0}, {2, -8, 4}));
  EXPECT_EQ(read_with("<up_axis>X_UP</up_axis>"), Two({0, 0, 1}, {-4, -8, 2}));
  EXPECT_EQ(read_with("<unit name=\"quarter\" meter=\"0.25\"/><up_axis>Z_UP</up_axis>"),
            Two({0.25, 0, 0}, {0.5, 1, 2}));
}

TEST(Dae, HasItsPolygonsCutByTheirEars) {
  // An L of area 3.
  const std::string points = points_of_dae("0 0 0 2 0 0 2 1 0 1 1 0 1 2 0 0 2 0", 6);
  const std::string parts[] = {
      "<polylist count=\"1\">" + kInput + "<vcount>6</vcount><p>3 4 5 0 1 2</p></polylist>",
      "<polygons count=\"1\">" + kInput + "<p>2 3 4 5 0 1</p></polygons>",
      "<polygons count=\"1\"><input semantic=\"NORMAL\" source=\"#s\" offset=\"0\"/><input "
      "semantic=\"VERTEX\" "
      "source=\"#n\" offset=\"1\"/><p>9 0 9 1 9 2 9 3 9 4 9 5</p></polygons>",
      "<triangles count=\"4\">" + kInput + "<p>0 1 2 0 2 3 0 3 5 3 4 5</p></triangles>",
      "<trifans count=\"1\">" + kInput + "<p>3 4 5 0 1 2</p></trifans>",
      "<tristrips count=\"2\">" + kInput + "<p>1 2 0 3</p><p>0 3 5 4</p></tristrips>"};
  for (const std::string& part : parts) {
    const PointFile file = read("a.dae", dae("<up_axis>Z_UP</up_axis>", points + part, kPlaced));
    double area = 0;
    for (const auto& t : triangles_of(file.points, file.faces)) {
      const double twice =
          (file.points[t[1]] - file.points[t[0]]).cross(file.points[t[2]] - file.points[t[0]]).z();
      EXPECT_GT(twice, 0) << part;
      area += 0.5 * twice;
    }
    EXPECT_EQ(area, 3) << part;
  }
}

TEST(Dae, IsPlacedByItsNodesInTheirOrder) {
  const std::string face = "<polylist count=\"1\">" + kInput + "<vcount>4</vcount><p>0 1 2 3</p></polylist>";
  const auto first = [&](const std::string& steps) {
    return read("a.dae", dae("<up_axis>Z_UP</up_axis>", kSquare + face,
                             "<node>" + steps + "<instance_geometry url=\"#g\"/></node>"))
        .points;
  };
  using All = std::vector<Vector3d>;
  EXPECT_EQ(first("<translate>5 0 0</translate><rotate>0 0 2 90</rotate>"),
            (All{{5, 0, 0}, {5, 1, 0}, {4, 1, 0}, {4, 0, 0}}));
  EXPECT_EQ(first("<rotate>0 0 1 -270</rotate><translate>5 0 0</translate>"),
            (All{{0, 5, 0}, {0, 6, 0}, {-1, 6, 0}, {-1, 5, 0}}));
  EXPECT_EQ(first("<matrix>0 -1 0 7 1 0 0 8 0 0 1 9 0 0 0 1</matrix><scale>2 3 4</scale>"),
            (All{{7, 8, 9}, {7, 10, 9}, {4, 10, 9}, {4, 8, 9}}));
  // Mirrored: the polygon goes the other way round.
  const PointFile mirrored =
      read("a.dae", dae("<up_axis>Z_UP</up_axis>", kSquare + face,
                        "<node><scale>-1 1 1</scale><instance_geometry url=\"#g\"/></node>"));
  EXPECT_EQ(mirrored.points, (All{{0, 0, 0}, {-1, 0, 0}, {-1, 1, 0}, {0, 1, 0}}));
  EXPECT_EQ(mirrored.faces, (std::vector<Face>{{3, 2, 1, 0}}));
  // A node of the library, in two places: against glTF's.
  const std::string text = dae(
      "<up_axis>Y_UP</up_axis>", kSquare + face,
      "<node><translate>0 0 1</translate><instance_node url=\"#k\"/></node><node><instance_node url=\"#k\"/>"
      "</node>");
  const std::size_t at = text.find("<library_visual_scenes>");
  const PointFile twice =
      read("a.dae",
           text.substr(0, at) +
               "<library_nodes><node id=\"k\"><rotate>1 0 0 30</rotate><instance_geometry url=\"#g\"/></node>"
               "</library_nodes>" +
               text.substr(at));
  Written w;
  const int points = w.accessor(packed<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}), 5126, "VEC3", 4);
  w.mesh({{"attributes", {{"POSITION", points}}}, {"mode", 5}});
  const double half = std::sin(3.14159265358979323846 / 12), other = std::cos(3.14159265358979323846 / 12);
  w.root["nodes"] = {{{"rotation", {half, 0, 0, other}}, {"mesh", 0}},
                     {{"translation", {0, 0, 1}}, {"children", {2}}},
                     {{"rotation", {half, 0, 0, other}}, {"mesh", 0}}};
  const PointFile same = read("a.glb", w.glb());
  ASSERT_EQ(twice.points.size(), 8U);
  ASSERT_EQ(same.points.size(), 8U);
  for (const Vector3d& p : twice.points) {
    double nearest = 1;
    for (const Vector3d& q : same.points) nearest = std::min(nearest, (p - q).norm());
    EXPECT_LT(nearest, 1e-14);
  }
}

// What is refused.

class MalformedScenes : public ::testing::TestWithParam<BadFile> {};

TEST_P(MalformedScenes, AreRefusedInOneLine) {
  testing::expect_refused(GetParam(), [](const auto& path) { read_points(path); });
}

std::string changed(const char* pointer, const json& to) {
  Written w = tetrahedron();
  w.root["nodes"] = {{{"mesh", 0}}};
  w.root[json::json_pointer(pointer)] = to;
  return w.glb();
}
std::string with_part(const std::string& part) { return dae("", kSquare + part, kPlaced); }
std::string with_nodes(const std::string& nodes) {
  return dae("", kSquare + "<polygons>" + kInput + "<p>0 1 2 3</p></polygons>", nodes);
}

INSTANTIATE_TEST_SUITE_P(
    Table, MalformedScenes,
    ::testing::Values(
        BadFile{"glb_short", "a.glb", "glTF", "4 bytes", "20 or more"},
        BadFile{"glb_version", "a.glb", std::string("glTF\1\0\0\0\x14\0\0\0", 12) + "12345678", "version 1",
                "version 2"},
        BadFile{"glb_length", "a.glb", std::string("glTF\2\0\0\0\xff\0\0\0", 12) + "12345678", "255 bytes",
                "the 20 bytes of the file"},
        BadFile{"glb_cut", "a.glb", tetrahedron().glb().substr(0, 300), "bytes", "the 300 bytes of the file"},
        BadFile{"gltf_no_json", "a.gltf", "points: 3", "byte 0", "JSON"},
        BadFile{"gltf_cut", "a.gltf", "{\"asset\": {", "its end", "JSON"},
        BadFile{"gltf_deep", "a.gltf", std::string(1000, '['), "levels", "at most 64"},
        BadFile{"gltf_large_number", "a.gltf", "{\"asset\": 1e999}", "too large", "range of double"},
        BadFile{"gltf_old", "a.gltf", "{\"asset\": {\"version\": \"1.0\"}}", "\"1.0\"", "2.0"},
        BadFile{"gltf_nothing", "a.gltf", "{\"asset\": {\"version\": \"2.0\"}}", "no points", "one point"},
        BadFile{"gltf_elsewhere", "a.gltf", tetrahedron().gltf("../a.bin"), "\"../a.bin\"", "same folder"},
        BadFile{"gltf_absolute", "a.gltf", tetrahedron().gltf("/etc/passwd"), "\"/etc/passwd\"",
                "same folder"},
        BadFile{"gltf_net", "a.gltf", tetrahedron().gltf("http://a/b"), "http", "same folder"},
        BadFile{"gltf_no_buffer", "a.gltf", tetrahedron().gltf("none.bin"), "no such file", "path"},
        BadFile{"gltf_base64", "a.gltf", tetrahedron().gltf("data:;base64,A*"), "buffers[0].uri", "base 64"},
        BadFile{"gltf_few_bytes", "a.gltf", tetrahedron().gltf("data:;base64,AAAA"), "buffers[0].byteLength",
                "3 bytes"},
        BadFile{"gltf_draco", "a.glb", changed("/extensionsRequired", {"KHR_draco_mesh_compression"}),
                "KHR_draco_mesh_compression", "without it"},
        BadFile{"gltf_view", "a.glb", changed("/accessors/0/bufferView", 7), "bufferViews[7]", "of the 2"},
        BadFile{"gltf_negative", "a.glb", changed("/accessors/0/bufferView", -1),
                "accessors[0].bufferView: -1", "whole number"},
        BadFile{"gltf_count", "a.glb", changed("/accessors/0/count", 5), "bufferViews[0]",
                "5 elements of 12"},
        BadFile{"gltf_huge_count", "a.glb", changed("/accessors/0/count", 4000000000000000000),
                "again and again", "at most"},
        BadFile{"gltf_offset", "a.glb", changed("/accessors/0/byteOffset", 18446744073709551615U),
                "bufferViews[0]", "18446744073709551615"},
        BadFile{"gltf_stride", "a.glb", changed("/bufferViews/0/byteStride", 8), "byteStride: 8",
                "12 to 252"},
        BadFile{"gltf_length", "a.glb", changed("/bufferViews/1/byteLength", 1000), "byteLength: 1000",
                "bytes"},
        BadFile{"gltf_component", "a.glb", changed("/accessors/0/componentType", 5130), "componentType: 5130",
                "5126"},
        BadFile{"gltf_no_component", "a.glb", changed("/accessors/1/componentType", 5122),
                "componentType: 5122", "5125"},
        BadFile{"gltf_vec2", "a.glb", changed("/accessors/0/type", "VEC2"), "VEC2", "VEC3"},
        BadFile{"gltf_zeros", "a.glb",
                changed("/accessors/0", {{"componentType", 5126}, {"type", "VEC3"}, {"count", 4}}), "zeros",
                "bufferView"},
        BadFile{"gltf_corners", "a.glb", changed("/accessors/1/count", 11), "11 corners", "three"},
        BadFile{"gltf_index", "a.glb", changed("/accessors/0/count", 3), "an accessor with 3", "below 3"},
        BadFile{"gltf_mode", "a.glb", changed("/meshes/0/primitives/0/mode", 7), "mode: 7", "0 to 6"},
        BadFile{"gltf_skin", "a.glb", changed("/nodes/0/skin", 0), "skin", "bones"},
        BadFile{"gltf_weights", "a.glb", changed("/nodes/0/weights", {0.5}), "weights[0]: 0.5", "0"},
        BadFile{"gltf_circle", "a.glb", changed("/scenes", {{{"nodes", {0, 0}}}}), "two places", "one node"},
        BadFile{"gltf_matrix", "a.glb", changed("/nodes/0/matrix", std::vector<double>(16, 1)), "last row",
                "0 0 0 1"},
        BadFile{"gltf_quaternion", "a.glb", changed("/nodes/0/rotation", {0, 0, 0, 2}), "another length",
                "length 1"},
        BadFile{"gltf_three", "a.glb", changed("/nodes/0/scale", {1, 2}), "scale: 2 values", "3 numbers"},
        BadFile{"gltf_mesh", "a.glb", changed("/nodes/0/mesh", "a\nb"), "\"a?b\"", "whole number"},

        BadFile{"dae_no_xml", "a.dae", "solid", "line 1: solid", "an element"},
        BadFile{"dae_other", "a.dae", "<robot/>", "<robot>", "<COLLADA>"},
        BadFile{"dae_entities", "a.dae", "<!DOCTYPE x [<!ENTITY y SYSTEM 'file:///etc/passwd'>]><COLLADA/>",
                "DOCTYPE", "not read"},
        BadFile{"dae_nothing", "a.dae", "<COLLADA/>", "no points", "one point"},
        BadFile{"dae_cut", "a.dae", with_part("").substr(0, 500), "the end of the file", "the end of"},
        BadFile{"dae_axis", "a.dae", dae("<up_axis>UP</up_axis>", kSquare, kPlaced), "\"UP\"", "Y_UP"},
        BadFile{"dae_unit", "a.dae", dae("<unit meter=\"0\"/>", kSquare, kPlaced), "meter=\"0\"", "positive"},
        BadFile{"dae_index", "a.dae", with_part("<polygons>" + kInput + "<p>0 1 4</p></polygons>"), "index 4",
                "below 4"},
        BadFile{"dae_negative", "a.dae", with_part("<polygons>" + kInput + "<p>0 1 -1</p></polygons>"),
                "\"-1\"", "whole numbers"},
        BadFile{
            "dae_word", "a.dae",
            dae("", points_of_dae("0 0 x", 1) + "<polygons>" + kInput + "<p>0 0 0</p></polygons>", kPlaced),
            "\"x\"", "numbers"},
        BadFile{
            "dae_few_numbers", "a.dae",
            dae("", points_of_dae("0 0 0", 2) + "<polygons>" + kInput + "<p>0 0 0</p></polygons>", kPlaced),
            "count=2", "3 numbers"},
        BadFile{"dae_holes", "a.dae",
                with_part("<polygons>" + kInput + "<ph><p>0 1 2</p><h>0 1 2</h></ph></polygons>"), "holes",
                "triangulated"},
        BadFile{"dae_short_list", "a.dae",
                with_part("<polylist>" + kInput + "<vcount>4 4</vcount><p>0 1 2 3</p></polylist>"), "shorter",
                "vcount"},
        BadFile{"dae_long_list", "a.dae",
                with_part("<polylist>" + kInput + "<vcount>3</vcount><p>0 1 2 3</p></polylist>"), "longer",
                "vcount"},
        BadFile{"dae_two_corners", "a.dae", with_part("<triangles>" + kInput + "<p>0 1</p></triangles>"),
                "2 corners", "three"},
        BadFile{"dae_no_vertex", "a.dae", with_part("<triangles><p>0 1 2</p></triangles>"), "without VERTEX",
                "places"},
        BadFile{"dae_unknown", "a.dae", with_nodes("<node><instance_geometry url=\"#h\"/></node>"), "\"#h\"",
                "<geometry>"},
        BadFile{"dae_elsewhere", "a.dae", with_nodes("<node><instance_geometry url=\"b.dae#g\"/></node>"),
                "b.dae#g", "of this file"},
        BadFile{"dae_circle", "a.dae", with_nodes("<node id=\"k\"><instance_node url=\"#k\"/></node>"),
                "levels", "no circle"},
        BadFile{"dae_bomb", "a.dae", with_nodes([] {
                  std::string nodes = kPlaced;
                  for (int i = 0; i < 40; ++i) {
                    const std::string next = "<instance_node url=\"#k" + std::to_string(i + 1) + "\"/>";
                    nodes += "<node id=\"k" + std::to_string(i) + "\">" + next + next + "</node>";
                  }
                  return nodes + "<node id=\"k40\"/>";
                }()),
                "again and again", "at most"},
        BadFile{"dae_bones", "a.dae", with_nodes("<node><instance_controller url=\"#g\"/></node>"),
                "controller", "bones"},
        BadFile{"dae_lookat", "a.dae", with_nodes("<node><lookat>1</lookat></node>"), "<lookat>", "matrix"},
        BadFile{"dae_matrix", "a.dae", with_nodes("<node><matrix>1 0</matrix></node>"), "<matrix> of 2",
                "16 finite"},
        BadFile{"dae_twice", "a.dae",
                with_nodes("<node id=\"k\"/><node id=\"k\"/><node><instance_node url=\"#k\"/></node>"),
                "\"#k\"", "one <node>"}),
    [](const auto& instance) { return instance.param.name; });

/// Whatever is cut off or overwritten: a result or an InputError of one line.
TEST(DamagedScenes, NeverCrashTheReader) {
  Random random(72);
  SCOPED_TRACE(random.trace());
  const TemporaryDirectory directory;
  Written w = tetrahedron();
  w.root["nodes"] = {{{"mesh", 0}, {"scale", {1, 2, -3}}}, {{"children", {0}}, {"rotation", {0, 0, 1, 0}}}};
  w.root["scenes"] = {{{"nodes", {1}}}};
  const std::pair<std::string, std::string> sound[] = {
      {"a.glb", w.glb()},
      {"a.gltf", w.gltf("data:;base64," + in_base64(w.bytes))},
      {"a.dae", with_nodes("<node><rotate>0 0 1 30</rotate><scale>1 2 -3</scale><node><instance_geometry "
                           "url=\"#g\"/></node></node>")}};
  int refused = 0, read = 0;
  for (const auto& [name, bytes] : sound) {
    ASSERT_FALSE(read_points(directory.write(name, bytes)).faces.empty()) << name;
    for (int k = 0; k < testing::share(400); ++k) {
      std::string damaged = bytes;
      if (k % 4 == 0) damaged.resize(std::size_t(random.integer(0, int(bytes.size()) - 1)));
      for (int n = random.integer(1, 4); n > 0 && !damaged.empty(); --n) {
        char& at = damaged[std::size_t(random.integer(0, int(damaged.size()) - 1))];
        at = random.integer(0, 1) ? char(random.integer(0, 255)) : char('0' + random.integer(0, 9));
      }
      try {
        const PointFile file = read_points(directory.write(name, damaged));
        for (const Face& face : file.faces)
          for (const std::uint32_t v : face) ASSERT_LT(v, file.points.size());
        ++read;
      } catch (const InputError& error) {
        EXPECT_THAT(error.what(), ::testing::Not(::testing::HasSubstr("\n")));
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, testing::share(300));
  EXPECT_GT(read, 0);
}

}  // namespace
}  // namespace vericone::files::scene_meshes_test
