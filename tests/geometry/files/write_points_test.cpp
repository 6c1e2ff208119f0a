// SPDX-License-Identifier: BSD-3-Clause
//
// What is written reads back as the same numbers.
#include <gtest/gtest.h>
#include <vericone/files/files.h>
#include <vericone/geometry/error.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

namespace vericone::files::write_points_test {
namespace {

using Eigen::Vector3d;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// A folder of its own, gone at the end.
class WritePoints : public ::testing::Test {
 protected:
  WritePoints() {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~WritePoints() override { std::filesystem::remove_all(folder_); }

  std::string refused_field(const std::string& name, const std::vector<Vector3d>& points,
                            const Triangles& triangles) const {
    try {
      write_points(folder_ / name, points, triangles);
    } catch (const InputError& e) {
      return e.field();
    }
    return "";
  }

  const std::filesystem::path folder_ =
      std::filesystem::path(::testing::TempDir()) /
      (std::string("vericone_") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
  const std::vector<Vector3d> points_{
      {0.1, -1e-300, 1e22}, {1 / 3.0, 5e-324, -0.0}, {-7, 1e300, 2}, {1, 2, 3}};
  const Triangles triangles_{{0, 1, 2}, {2, 1, 3}};
};

TEST_F(WritePoints, MeshesReadBackBitForBit) {
  for (const char* name : {"mesh.ply", "mesh.obj", "mesh.off", "MESH.PLY"}) {
    write_points(folder_ / name, points_, triangles_);
    const PointFile read = read_points(folder_ / name);
    ASSERT_EQ(read.points.size(), points_.size()) << name;
    for (std::size_t i = 0; i < points_.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        EXPECT_EQ(read.points[i](k), points_[i](k)) << name;
        EXPECT_EQ(std::signbit(read.points[i](k)), std::signbit(points_[i](k))) << name;
      }
    EXPECT_EQ(triangles_of(read.points, read.faces), triangles_) << name;
  }
}

TEST_F(WritePoints, CloudsReadBackBitForBit) {
  for (const char* name : {"cloud.ply", "cloud.pcd", "cloud.xyz", "cloud.obj", "cloud.off"}) {
    write_points(folder_ / name, points_);
    const PointFile read = read_points(folder_ / name);
    EXPECT_EQ(read.points, points_) << name;
    EXPECT_TRUE(read.faces.empty()) << name;
  }
}

TEST_F(WritePoints, StlKeepsFloatsAndRefusesOthers) {
  const std::vector<Vector3d> floats{{0, 0, 0}, {0.5, 0, 1}, {double(0.1F), 1, 0}, {3, 3, 3}};
  write_points(folder_ / "mesh.stl", floats, triangles_);
  const PointFile read = read_points(folder_ / "mesh.stl");
  EXPECT_EQ(read.points, floats);
  EXPECT_EQ(triangles_of(read.points, read.faces), triangles_);
  EXPECT_EQ(refused_field("mesh2.stl", points_, triangles_), "points[0][0]");
  EXPECT_EQ(refused_field("mesh3.stl", floats, {}), "triangles");
}

TEST_F(WritePoints, RefusesWhatNoFileHolds) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refused_field("a.ply", {}, {}), "points");
  EXPECT_EQ(refused_field("a.ply", {{0, nan, 0}}, {}), "points[0][1]");
  EXPECT_EQ(refused_field("a.ply", points_, {{0, 1, 4}}), "triangles[0][2]");
  EXPECT_EQ(refused_field("a.xyz", points_, triangles_), "triangles");
  EXPECT_EQ(refused_field("a.pcd", points_, triangles_), "triangles");
  EXPECT_EQ(refused_field("a.txt2", points_, triangles_), "path");
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

TEST_F(WritePoints, LeavesTheOldFileWhereItFails) {
  EXPECT_THROW(write_points(folder_ / "missing" / "a.ply", points_), std::runtime_error);
  write_points(folder_ / "a.ply", points_);
  const std::vector<Vector3d> many(10000, Vector3d::Ones());
  Stop stop;
  stop.request();
  {
    const StopScope scope(&stop);
    EXPECT_THROW(write_points(folder_ / "a.ply", many), Interrupted);
    EXPECT_THROW(write_points(folder_ / "b.off", many), Interrupted);
  }
  EXPECT_EQ(read_points(folder_ / "a.ply").points, points_);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 1);
  write_points(folder_ / "many.off", many);
  const StopScope scope(&stop);
  EXPECT_THROW(static_cast<void>(read_points(folder_ / "many.off")), Interrupted);
}

}  // namespace
}  // namespace vericone::files::write_points_test
