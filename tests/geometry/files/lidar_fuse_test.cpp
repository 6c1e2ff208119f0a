// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vericone/geometry/error.h>
#include <vericone/lidar/lidar.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <optional>

#include "geometry/meshes.h"
#include "support/random.h"

namespace vericone::lidar::lidar_fuse_test {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using testing::Random;

Isometry3d pose(const Vector3d& position, const Eigen::Matrix3d& rotation = Eigen::Matrix3d::Identity()) {
  Isometry3d p = Isometry3d::Identity();
  p.linear() = rotation;
  p.translation() = position;
  return p;
}

double degrees(const Eigen::Matrix3d& rotation) {
  return Eigen::AngleAxisd(rotation).angle() * 180 / std::numbers::pi;
}

/// A box with a ball and an ellipsoid in it: nothing can slide.
testing::Mesh junk() {
  testing::Mesh m = testing::cube();
  m.append(testing::sphere(4).mapped(0.6 * Eigen::Matrix3d::Identity(), {-1, 0.5, 0.8}));
  m.append(testing::sphere(4).mapped(Vector3d(0.5, 0.3, 0.8).asDiagonal(), {-0.9, -0.8, -0.5}));
  return m;
}

struct Engagement {
  std::vector<std::vector<Vector3d>> scans;
  std::vector<Isometry3d> truth, initial;
};

/// Three lidars on an agent 4 m away, the poses of the second and third known up to an error.
Engagement engagement(const testing::Mesh& mesh, Random& random, double noise, double error) {
  const MeshScene scene(mesh.points, mesh.triangles);
  const Isometry3d agent = pose({-4, 0, 0});
  Engagement e;
  for (const Vector3d& at : {Vector3d(0, 0, 0), Vector3d(0.1, 0.6, 0.2), Vector3d(0, -0.5, 0.4)}) {
    Lidar lidar;
    lidar.pose = pose(at);
    lidar.beams = raster(80, 80, 0.9, 0.9);
    lidar.range_noise = noise;
    const Scan s = scan(scene, lidar, agent, e.scans.size() + 1);
    e.scans.push_back(s.sensor_points());
    e.truth.push_back(s.pose);
    const Vector3d turn = random.vector<3>().normalized();
    e.initial.push_back(e.scans.size() == 1
                            ? s.pose
                            : pose(error * random.vector<3>().normalized()) * s.pose *
                                  Isometry3d(Eigen::AngleAxisd(error * 0.5, turn).toRotationMatrix()));
  }
  return e;
}

TEST(Fuse, RecoversKnownErrorsOfPoses) {
  Random random(7401);
  SCOPED_TRACE(random.trace());
  const testing::Mesh mesh = junk();
  for (const double noise : {0.0, 0.005}) {
    double worst_shift = 0, worst_turn = 0;
    for (int i = 0; i < 5; ++i) {
      const Engagement e = engagement(mesh, random, noise, 0.08);
      const Fusion f = fuse(e.scans, e.initial, {.max_distance = 0.3, .last_distance = 0.05});
      ASSERT_TRUE(f.converged) << f.reason;
      EXPECT_EQ(f.cloud.size(), e.scans[0].size() + e.scans[1].size() + e.scans[2].size());
      for (std::size_t k = 0; k < e.scans.size(); ++k) {
        const Isometry3d off = e.truth[k].inverse() * f.poses[k];
        // At the obstacle, where it counts.
        const Vector3d centre = e.truth[k].inverse() * Vector3d(-1, 0, 0);
        worst_shift = std::max(worst_shift, (off * centre - centre).norm());
        worst_turn = std::max(worst_turn, degrees(off.linear()));
      }
    }
    RecordProperty(noise > 0 ? "noisy_shift_um" : "shift_um", int(1e6 * worst_shift));
    std::cout << "noise " << noise << " m: off by at most " << worst_shift << " m and " << worst_turn
              << " deg\n";
    EXPECT_LT(worst_shift, 0.001);
    EXPECT_LT(worst_turn, noise > 0 ? 0.1 : 0.02);
  }
}

TEST(Fuse, RepeatsItself) {
  Random random(7402);
  SCOPED_TRACE(random.trace());
  const Engagement e = engagement(junk(), random, 0.005, 0.05);
  const Fusion one = fuse(e.scans, e.initial), two = fuse(e.scans, e.initial);
  ASSERT_TRUE(one.converged && two.converged);
  for (std::size_t i = 0; i < one.poses.size(); ++i) EXPECT_EQ(one.poses[i].matrix(), two.poses[i].matrix());
}

TEST(Fuse, SaysWhereThereIsNoAnswer) {
  Random random(7403);
  SCOPED_TRACE(random.trace());
  // A ball turns in itself, a wall slides in itself.
  const Engagement ball = engagement(testing::sphere(5), random, 0.001, 0.02);
  Fusion f = fuse(ball.scans, ball.initial);
  EXPECT_FALSE(f.converged);
  EXPECT_THAT(f.reason, ::testing::HasSubstr("slide"));
  EXPECT_TRUE(f.poses.empty() && f.cloud.empty());
  const Engagement wall =
      engagement(testing::cube().mapped(Vector3d(1, 20, 20).asDiagonal(), {0, 0, 0}), random, 0.001, 0.02);
  f = fuse(wall.scans, wall.initial);
  EXPECT_FALSE(f.converged);
  EXPECT_THAT(f.reason, ::testing::HasSubstr("slide"));
  // Too far off: nothing corresponds.
  Engagement far = engagement(junk(), random, 0, 0.02);
  far.initial[2].translation() += Vector3d(0, 50, 0);
  f = fuse(far.scans, far.initial);
  EXPECT_FALSE(f.converged);
  EXPECT_THAT(f.reason, ::testing::HasSubstr("overlap"));
  // Too little time.
  const Engagement good = engagement(junk(), random, 0.005, 0.05);
  f = fuse(good.scans, good.initial, {.tolerance = 1e-12, .max_sweeps = 1});
  EXPECT_FALSE(f.converged);
  EXPECT_THAT(f.reason, ::testing::HasSubstr("still moved"));
}

TEST(Fuse, RefusesBadInput) {
  const std::vector<std::vector<Vector3d>> scans(2, std::vector<Vector3d>(10, Vector3d::Zero()));
  const std::vector<Isometry3d> poses(2, Isometry3d::Identity());
  EXPECT_THROW(fuse({}, {}), InputError);
  EXPECT_THROW(fuse(scans, std::span(poses).first(1)), InputError);
  EXPECT_THROW(fuse(scans, poses, {.max_distance = -1}), InputError);
  EXPECT_THROW(fuse(scans, poses, {.last_distance = 0}), InputError);
  EXPECT_THROW(fuse(scans, poses, {.voxel = std::nan("")}), InputError);
  EXPECT_THROW(fuse(scans, poses, {.max_sweeps = 0}), InputError);
  std::vector<std::vector<Vector3d>> bad = scans;
  bad[1][3].z() = std::nan("");
  EXPECT_THROW(fuse(bad, poses), InputError);
  bad[1].resize(3);
  EXPECT_THROW(fuse(bad, poses), InputError);
  // All points in one place fix nothing.
  EXPECT_FALSE(fuse(scans, poses).converged);
}

/// x y z intensity as little-endian floats behind a header.
std::vector<Vector3d> read_ply(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::size_t count = 0;
  for (std::string line; std::getline(in, line) && line.rfind("end_header", 0) != 0;)
    if (line.rfind("element vertex ", 0) == 0) count = std::stoul(line.substr(15));
  std::vector<Vector3d> points;
  for (std::array<float, 4> v{};
       points.size() < count && in.read(reinterpret_cast<char*>(v.data()), sizeof v);)
    points.emplace_back(v[0], v[1], v[2]);
  return points;
}

TEST(Fuse, RealPairOfScans) {
  const char* given = std::getenv("VERICONE_DATA_DIR");
  const std::filesystem::path folder = given ? given : VERICONE_DEFAULT_DATA_DIR;
  if (!std::filesystem::exists(folder / "small_gicp_source.ply"))
    GTEST_SKIP() << "small_gicp_source.ply is not here; set VERICONE_DATA_DIR to the folder with it";
  const std::vector<std::vector<Vector3d>> scans{read_ply(folder / "small_gicp_target.ply"),
                                                 read_ply(folder / "small_gicp_source.ply")};
  ASSERT_GT(scans[0].size(), 60'000U);
  ASSERT_GT(scans[1].size(), 60'000U);
  Isometry3d truth;
  std::ifstream numbers(folder / "small_gicp_T_target_source.txt");
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) numbers >> truth.matrix()(i, j);
  ASSERT_TRUE(numbers);
  const std::vector<Isometry3d> initial(2, Isometry3d::Identity());
  const Fusion f =
      fuse(scans, initial, {.max_distance = 4, .last_distance = 0.5, .voxel = 0.25, .tolerance = 1e-4});
  ASSERT_TRUE(f.converged) << f.reason;
  const Isometry3d off = truth.inverse() * f.poses[1];
  std::cout << "off by " << off.translation().norm() << " m and " << degrees(off.linear()) << " deg; overlap "
            << f.fits[1].overlap << ", rms " << f.fits[1].rms << " m, weakest " << f.fits[1].weakest << ", "
            << f.sweeps << " sweeps\n";
  EXPECT_LT(off.translation().norm(), 0.02);
  EXPECT_LT(degrees(off.linear()), 0.3);
}

}  // namespace
}  // namespace vericone::lidar::lidar_fuse_test
