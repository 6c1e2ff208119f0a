// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vericone/files/files.h>
#include <vericone/geometry/error.h>

#include <Eigen/Geometry>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>

#include "geometry/files/written_clouds.h"
#include "support/random.h"

namespace vericone::files::read_clouds_test {
namespace {

using Eigen::Vector3d;
using ::testing::ElementsAre, ::testing::ElementsAreArray;
using testing::LasFile, testing::little, testing::Points, testing::Random, testing::TemporaryDirectory;

class ReadClouds : public ::testing::Test {
 protected:
  PointFile read(const std::string& name, const std::string& bytes) const {
    return read_points(directory_.write(name, bytes));
  }

  TemporaryDirectory directory_;
};

const float kNan = std::numeric_limits<float>::quiet_NaN();

TEST_F(ReadClouds, StlBecomesAnIndexedMesh) {
  // A tetrahedron: four points in twelve corners, one of them with a zero of another sign.
  const Vector3d a(0, 0, 0), b(1, 0, 0), c(0, 0.1F, 0), d(0, 0, 1e-30F), z(-0.0, 0.0, -0.0);
  const Points corners = {a, c, b, a, b, d, z, d, c, b, c, d};
  for (const char* title : {"solid binary as well", "plain"}) {
    const auto file = read("a.stl", testing::to_stl_binary(corners, title));
    EXPECT_EQ(file.format, "STL binary");
    EXPECT_THAT(file.points, ElementsAre(a, c, b, d));
    EXPECT_THAT(file.faces, ElementsAre(Face{0, 1, 2}, Face{0, 2, 3}, Face{0, 3, 1}, Face{2, 1, 3}));
    EXPECT_EQ(file.unreferenced_points, 0U);
  }
  std::string text = "solid facet of endsolid # 3\n";
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    if (i == 6) text += "endsolid facet of\r\n\r\nSOLID\r\n";
    text += "  facet normal nan -nan(ind) 0\n outer loop\n";
    for (std::size_t k = i; k < i + 3; ++k) {
      char line[100];
      std::snprintf(line, sizeof line, "\tVertex %.17g %.17g %.17g\r\n", corners[k].x(), corners[k].y(),
                    corners[k].z());
      text += line;
    }
    text += "endloop\nendfacet\n";
  }
  const auto file = read("b.STL", text + "endsolid");
  EXPECT_EQ(file.format, "STL ascii");
  EXPECT_THAT(file.points, ElementsAre(a, c, b, d));
  EXPECT_THAT(file.faces, ElementsAre(Face{0, 1, 2}, Face{0, 2, 3}, Face{0, 3, 1}, Face{2, 1, 3}));
}

TEST_F(ReadClouds, StlManyPointsAreMergedAsASetWould) {
  Random random(420);
  SCOPED_TRACE(random.trace());
  Points corners;
  for (int i = 0; i < 30000; ++i)
    corners.emplace_back(random.integer(-9, 9), random.integer(-9, 9), 0.1F * float(random.integer(-9, 9)));
  const auto file = read("a.stl", testing::to_stl_binary(corners));
  for (std::size_t f = 0; f < file.faces.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) ASSERT_EQ(file.points[file.faces[f][k]], corners[3 * f + k]);
  const auto less = [](const Vector3d& p, const Vector3d& q) {
    return std::lexicographical_compare(p.begin(), p.end(), q.begin(), q.end());
  };
  auto distinct = corners, merged = file.points;
  std::ranges::sort(distinct, less);
  distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
  std::ranges::sort(merged, less);
  EXPECT_THAT(merged, ElementsAreArray(distinct));
}

TEST_F(ReadClouds, StlFacetsWithCornersThatAreNotFiniteAreDropped) {
  const Vector3d nan(kNan, kNan, kNan), a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  const auto file = read("a.stl", testing::to_stl_binary({a, b, nan, nan, b, a, a, b, c}));
  EXPECT_EQ(file.faces.size(), 1U);
  EXPECT_EQ(file.dropped_faces, 2U);
  EXPECT_EQ(file.dropped_points, 2U);
  EXPECT_THAT(file.points, ElementsAre(a, b, c));
}

TEST_F(ReadClouds, BinaryStlWithBytesAfterItsFacets) {
  const Points corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const auto file = read("a.stl", testing::to_stl_binary(corners) + "\n");
  EXPECT_THAT(file.points, ElementsAreArray(corners));
  EXPECT_EQ(file.faces.size(), 1U);
  EXPECT_EQ(file.trailing_bytes, 1U);
  EXPECT_EQ(read("b.stl", testing::to_stl_binary(corners)).trailing_bytes, 0U);
}

/// PDAL writes capitals, others fields of no values as padding.
TEST_F(ReadClouds, PcdFieldsOfOtherWriters) {
  const Points points = {{1, 2, 3}, {4, 5, 6}};
  const auto capitals =
      testing::pcd_header("X Y Z Intensity", "8 8 8 2", "F F F U", "1 1 1 1", 2, 1, "ascii");
  EXPECT_THAT(read("a.pcd", capitals + "1 2 3 9\n4 5 6 9\n").points, ElementsAreArray(points));
  // x is the point's where both are there.
  const auto both = testing::pcd_header("X x y z", "4 4 4 4", "F F F F", "1 1 1 1", 2, 1, "ascii");
  EXPECT_THAT(read("b.pcd", both + "9 1 2 3\n9 4 5 6\n").points, ElementsAreArray(points));
  const auto empty = [](const std::string& data) {
    return testing::pcd_header("x none y _ z", "4 2 4 1 4", "F U F U F", "1 0 1 3 1", 2, 1, data);
  };
  std::string body;
  for (const auto& p : points)
    body += little(float(p.x())) + little(float(p.y())) + "abc" + little(float(p.z()));
  EXPECT_THAT(read("c.pcd", empty("binary") + body).points, ElementsAreArray(points));
  EXPECT_THAT(read("d.pcd", empty("ascii") + "1 2 0 0 0 3\n4 5 0 0 0 6\n").points, ElementsAreArray(points));
  const auto longer = read("e.pcd", empty("binary") + body + "more");
  EXPECT_THAT(longer.points, ElementsAreArray(points));
  EXPECT_EQ(longer.trailing_bytes, 4U);
}

TEST_F(ReadClouds, PcdFieldsOfAllTypesCountsAndOrders) {
  // Every type of coordinate, with other fields and padding around them.
  const auto check = [&](const std::string& size, const std::string& type, auto one) {
    using T = decltype(one);
    SCOPED_TRACE(type + size);
    const std::string names = "label z _ x normal y", sizes = "2 " + size + " 1 " + size + " 4 " + size,
                      types = "U " + type + " U " + type + " F " + type, counts = "1 1 3 1 3 1";
    const Points points = {{3, 100, 7}, {1, 2, 127}, {0, 5, 6}};
    std::string text, body, labels, zs, pads, xs, normals, ys;
    for (const auto& p : points) {
      const std::string label = little(std::uint16_t{9}), pad = "abc",
                        normal = little(kNan) + little(0.F) + little(1.F);
      const std::string x = little(T(p.x())), y = little(T(p.y())), z = little(T(p.z()));
      body += label + z + pad + x + normal + y;
      labels += label, zs += z, pads += pad, xs += x, normals += normal, ys += y;
      text += "9 " + to_text(p.z()) + " 1 1 1 " + to_text(p.x()) + " nan 0 1 " + to_text(p.y()) + "\n";
    }
    const auto header = [&](const std::string& data) {
      return testing::pcd_header(names, sizes, types, counts, 3, 1, data);
    };
    const auto ascii = read("a.pcd", header("ascii") + text);
    EXPECT_EQ(ascii.format, "PCD ascii");
    EXPECT_THAT(ascii.points, ElementsAreArray(points));
    const auto binary = read("b.pcd", header("binary") + body);
    EXPECT_EQ(binary.format, "PCD binary");
    EXPECT_THAT(binary.points, ElementsAreArray(points));
    // Up to the end of a page.
    EXPECT_THAT(read("c.pcd", header("binary") + body + std::string(999, '\0')).points,
                ElementsAreArray(points));
    const auto packed = testing::pcd_compressed(labels + zs + pads + xs + normals + ys);
    const auto compressed = read("named.anyhow", header("binary_compressed") + packed + std::string(3, '\0'));
    EXPECT_EQ(compressed.format, "PCD binary_compressed");
    EXPECT_THAT(compressed.points, ElementsAreArray(points));
    EXPECT_EQ(compressed.width, 0U);
    EXPECT_EQ(compressed.height, 0U);
  };
  check("1", "I", std::int8_t{}), check("1", "U", std::uint8_t{});
  check("2", "I", std::int16_t{}), check("2", "U", std::uint16_t{});
  check("4", "I", std::int32_t{}), check("4", "U", std::uint32_t{}), check("4", "F", float{});
  check("8", "I", std::int64_t{}), check("8", "U", std::uint64_t{}), check("8", "F", double{});
}

TEST_F(ReadClouds, PcdKeepsEveryBit) {
  Random random(421);
  Points points;
  std::string text, body, xs, ys, zs;
  for (int i = 0; i < 1000; ++i) {
    const Vector3d p = random.vector<3>() * std::pow(10, random.integer(-300, 300));
    points.push_back(p);
    char line[100];
    std::snprintf(line, sizeof line, "%.17g %.17g\t%.17g\r\n", p.x(), p.y(), p.z());
    text += line;
    body += little(p.x()) + little(p.y()) + little(p.z());
    xs += little(p.x()), ys += little(p.y()), zs += little(p.z());
  }
  const auto header = [](const std::string& data) {
    return testing::pcd_header("x y z", "8 8 8", "F F F", "1 1 1", 1000, 1, data);
  };
  EXPECT_THAT(read("a.pcd", header("ascii") + text).points, ElementsAreArray(points));
  EXPECT_THAT(read("a.pcd", header("binary") + body).points, ElementsAreArray(points));
  EXPECT_THAT(read("a.pcd", header("binary_compressed") + testing::pcd_compressed(xs + ys + zs)).points,
              ElementsAreArray(points));
}

TEST_F(ReadClouds, PcdOrganisedWithNan) {
  std::string text;
  for (int i = 0; i < 6; ++i) text += i % 2 ? "nan nan nan\n" : std::to_string(i) + " 0 0\n";
  const auto file =
      read("a.pcd", testing::pcd_header("x y z", "4 4 4", "F F F", "1 1 1", 3, 2, "ascii") + text);
  EXPECT_EQ(file.width, 3U);
  EXPECT_EQ(file.height, 2U);
  EXPECT_EQ(file.dropped_points, 3U);
  EXPECT_THAT(file.points, ElementsAre(Vector3d(0, 0, 0), Vector3d(2, 0, 0), Vector3d(4, 0, 0)));
}

TEST_F(ReadClouds, PcdOfOldVersions) {
  EXPECT_EQ(read("a.pcd", "# .PCD v.5\nVERSION .5\nCOLUMNS x y z\nPOINTS 2\nDATA ascii\n1 2 3\n4 5 6\n")
                .points.size(),
            2U);
  EXPECT_EQ(read("a.pcd", "VERSION .6\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 1\nDATA binary\n" +
                              little(1.F) + little(2.F) + little(3.F))
                .points.front(),
            Vector3d(1, 2, 3));
}

TEST_F(ReadClouds, LasOfAllVersionsAndFormats) {
  for (int minor = 0; minor <= 4; ++minor)
    for (int format = 0; format <= 10; ++format) {
      LasFile las;
      las.minor = minor;
      las.format = minor < 4 ? format % 6 : format;
      las.offset = {500000, 4.5e6, -3};
      las.points = {
          {0, 0, 0}, {1, -2, 3}, {std::numeric_limits<int>::max(), std::numeric_limits<int>::min(), 7}};
      las.bytes_more = std::size_t(format);
      const auto file = read("a.las", las.bytes());
      EXPECT_EQ(file.format, "LAS 1." + std::to_string(minor));
      ASSERT_EQ(file.points.size(), 3U);
      EXPECT_EQ(file.points[0], las.offset);
      // Waveforms and other records may follow the points.
      EXPECT_EQ(read("a.las", las.bytes() + "waveforms").points.size(), 3U);
    }
}

TEST_F(ReadClouds, LasCoordinatesAreRoundedOnce) {
  using Rational = boost::multiprecision::cpp_rational;
  Random random(422);
  SCOPED_TRACE(random.trace());
  LasFile las;
  las.scale = {0.01, 0.001, 1e-7};
  las.offset = {500000.1, -4.2e6, 1.0 / 3};
  for (int i = 0; i < 2000; ++i)
    las.points.emplace_back(random.integer(-2147483647, 2147483647), random.integer(-9999, 9999),
                            random.integer(-2147483647, 2147483647));
  const auto file = read("a.las", las.bytes());
  ASSERT_EQ(file.points.size(), las.points.size());
  int once = 0;
  for (std::size_t i = 0; i < las.points.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const Rational exact = Rational(las.points[i](k)) * Rational(las.scale(k)) + Rational(las.offset(k));
      const double x = file.points[i](k);
      const Rational error = abs(exact - Rational(x));
      const auto distance = [&](double y) { return Rational(abs(exact - Rational(y))); };
      ASSERT_LE(error, distance(std::nextafter(x, 1e300)));
      ASSERT_LE(error, distance(std::nextafter(x, -1e300)));
      once += x != las.points[i](k) * las.scale(k) + las.offset(k);
    }
  EXPECT_GT(once, 100) << "rounding twice would have done";
}

TEST_F(ReadClouds, XyzVariants) {
  const Points points = {{1, 2, 3}, {-4.5, 5e-3, 6}};
  for (const std::string text :
       {"1 2 3\n-4.5 5e-3 6", "# made by hand\n\n1\t2  3 255 tree # here\n -4.5 5e-3 6\r\n",
        "1 2 3 a tree, or two; yes\n-4.5 5e-3 6 ,\n", "1,2,3\n-4.5,5e-3,6\n",
        "1, 2, 3, a, b\n-4.5 ,5e-3,6,\n", "1;2;3;;;\n-4.5; 5e-3 ;+6\n",
        "x,y,z,intensity\n1,2,3,9\n-4.5,5e-3,6,\n", "time,Z,\"Y\",name,x\n0.5,3,2,a b,1\n0.5,6,5e-3,,-4.5\n",
        "//X Y Z R G B\n2\n1 2 3 0 0 0\n-4.5 5e-3 6 0 0 0\n",
        "// a note\n//another\nx y z\n1 2 3\n//end\n-4.5 5e-3 6",
        "2\n1 2 3 -1000 0 0 0\n-4.5 5e-3 6 -1000 0 0 0\n"}) {
    SCOPED_TRACE(text);
    for (const char* name : {"a.xyz", "a.txt", "a.csv", "a.pts", "a.asc", "a.pwn"}) {
      const auto file = read(name, text);
      EXPECT_EQ(file.format, "XYZ");
      EXPECT_THAT(file.points, ElementsAreArray(points));
    }
  }
  EXPECT_EQ(read("a.xyz", "nan nan nan\n1 2 3\n").dropped_points, 1U);
}

TEST_F(ReadClouds, KittiAndNuscenes) {
  std::string kitti, nuscenes;
  for (int i = 0; i < 4; ++i) {
    const std::string p =
        little(0.1F * float(i)) + little(i == 2 ? kNan : -1.F) + little(1e-30F) + little(0.5F);
    kitti += p;
    nuscenes += p + little(7.F);
  }
  const auto file = read("000000.bin", kitti);
  EXPECT_EQ(file.format, "KITTI");
  EXPECT_EQ(file.dropped_points, 1U);
  EXPECT_THAT(file.points, ElementsAre(Vector3d(0, -1, 1e-30F), Vector3d(0.1F, -1, 1e-30F),
                                       Vector3d(0.1F * 3.F, -1, 1e-30F)));
  const auto other = read("sweep.pcd.bin", nuscenes);
  EXPECT_EQ(other.format, "nuScenes");
  EXPECT_EQ(other.points, file.points);
}

TEST_F(ReadClouds, ScanGraphsAreInTheWorldFrame) {
  const double h = std::sqrt(0.5);
  // A quarter turn about z takes x to y.
  const std::vector<testing::Scan> scans = {{{{1, 0, 0}, {0, 2, 0.1}}, {10, 20, 30}, {1, 0, 0, 0}},
                                            {{{1, 0, 0}, {0, 2, 0}, {0, 0, 3}}, {-1, 0, 0}, {h, 0, 0, h}},
                                            {{}, {0, 0, 0}, {1, 0, 0, 0}}};
  const Points truth = {{11, 20, 30}, {10, 22, 30.1}, {-1, 1, 0}, {-3, 0, 0}, {-1, 0, 3}};
  for (const int edges : {0, 2}) {
    const auto file = read("a.graph", testing::to_scan_graph(scans, edges));
    EXPECT_EQ(file.format, "scan graph");
    ASSERT_EQ(file.points.size(), truth.size());
    for (std::size_t i = 0; i < truth.size(); ++i) EXPECT_LT((file.points[i] - truth[i]).norm(), 1e-14);
  }
  const auto text = read("a.log",
                         "# roll pitch yaw\nNODE 10 20 30 0 0 0\n1 0 0\n0 2 0.1\n"
                         "NODE -1 0 0 0 0 1.5707963267948966\n1 0 0\n0 2 0\n0 0 3");
  EXPECT_EQ(text.format, "scan graph text");
  ASSERT_EQ(text.points.size(), truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) EXPECT_LT((text.points[i] - truth[i]).norm(), 1e-14);
  // Roll, pitch and yaw about the fixed axes x, y and z, in this order.
  const auto turned = read("a.log", "NODE 0 0 0 0.3 -0.5 2\n1 2 3\n").points.front();
  const auto turn = [](double angle, int axis) {
    return Eigen::AngleAxisd(angle, Vector3d::Unit(axis)).toRotationMatrix();
  };
  EXPECT_LT((turned - turn(2, 2) * (turn(-0.5, 1) * (turn(0.3, 0) * Vector3d(1, 2, 3)))).norm(), 1e-14);
}

}  // namespace
}  // namespace vericone::files::read_clouds_test
