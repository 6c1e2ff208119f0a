// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vericone/geometry/ellipsoid.h>
#include <vericone/geometry/error.h>
#include <vericone/lidar/lidar.h>
#if defined(__SSE__)
#include <xmmintrin.h>
#endif

#include <cmath>
#include <numbers>

#include "geometry/meshes.h"
#include "support/random.h"

namespace vericone::lidar::lidar_scan_test {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using testing::Mesh;
using testing::Random;

/// All triangles, in long double: three signed volumes for the inside, the plane for the range.
std::optional<Hit> by_brute_force(const Mesh& mesh, const Vector3d& origin, const Vector3d& direction) {
  using Wide = Eigen::Matrix<long double, 3, 1>;
  const Wide d = direction.cast<long double>();
  std::optional<Hit> best;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto corner = [&](int k) -> Wide {
      return (mesh.points[mesh.triangles[i][k]].cast<long double>() - origin.cast<long double>());
    };
    const Wide a = corner(0), b = corner(1), c = corner(2);
    const long double u = d.dot(b.cross(c)), v = d.dot(c.cross(a)), w = d.dot(a.cross(b));
    if (!((u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0)) || u + v + w == 0) continue;
    const Wide normal = (b - a).cross(c - a);
    const auto range = static_cast<double>(normal.dot(a) / normal.dot(d));
    if (range >= 0 && (!best || range < best->range)) best = Hit{range, i};
  }
  return best;
}

TEST(MeshScene, FindsWhatBruteForceFinds) {
  Random random(7301);
  SCOPED_TRACE(random.trace());
  int hits = 0, others = 0;
  for (int scene = 0; scene < 30; ++scene) {
    // Crossing bodies of any size anywhere, seen from near and very far.
    const double size = std::pow(10.0, random.uniform(-6, 6));
    Mesh mesh;
    for (int i = 0; i < 3; ++i)
      mesh.append(
          testing::sphere(2).mapped(size * random.rotation<3>() * random.vector<3>().cwiseAbs().asDiagonal(),
                                    size * random.vector<3>()));
    const Vector3d place = (scene % 3 == 0 ? 0 : 100 * size) * random.vector<3>();
    for (auto& p : mesh.points) p += place;
    const MeshScene fast(mesh.points, mesh.triangles);
    for (int i = 0; i < 200; ++i) {
      const double away = size * std::pow(10.0, random.uniform(-1, 4));
      const Vector3d origin = place + away * random.vector<3>().normalized(),
                     target = place + 1.5 * size * random.vector<3>(),
                     direction = (target - origin).normalized();
      const auto expected = by_brute_force(mesh, origin, direction), got = fast.first_hit(origin, direction);
      ASSERT_EQ(got.has_value(), expected.has_value());
      if (!got) continue;
      ++hits;
      others += got->triangle != expected->triangle;
      const auto& t = mesh.triangles[expected->triangle];
      const Vector3d& a = mesh.points[t[0]];
      const double cosine =
          std::abs((mesh.points[t[1]] - a).cross(mesh.points[t[2]] - a).normalized().dot(direction));
      EXPECT_NEAR(got->range, expected->range, 4e-15 * (away + place.norm() + size) / cosine);
    }
  }
  EXPECT_GT(hits, 1000);
  EXPECT_LE(others, 2);  // the other triangle of an edge that the ray meets
}

TEST(MeshScene, HasNoGapsAtEdgesAndCorners) {
  Random random(7302);
  SCOPED_TRACE(random.trace());
  const Mesh mesh = testing::sphere(3).mapped(Vector3d(1, 2, 0.5).asDiagonal(), {0.1, 0.2, 0.3});
  const MeshScene scene(mesh.points, mesh.triangles);
  // From inside every ray hits; aim at corners and at points of edges.
  for (int i = 0; i < 20'000; ++i) {
    const auto& t = mesh.triangles[random.integer(0, int(mesh.triangles.size()) - 1)];
    const double s = i % 2 ? random.uniform(0, 1) : 0;
    const Vector3d target = mesh.points[t[0]] + s * (mesh.points[t[1]] - mesh.points[t[0]]),
                   origin = Vector3d(0.1, 0.2, 0.3) + 0.1 * random.vector<3>().normalized(),
                   way = target - origin;
    const auto hit = scene.first_hit(origin, way.normalized());
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->range, way.norm(), 1e-13);
    EXPECT_TRUE(scene.sees(origin, target, 1e-12));
  }
}

TEST(MeshScene, LimitsOfRangeAreKept) {
  const Mesh cube = testing::cube();
  const MeshScene scene(cube.points, cube.triangles);
  const Vector3d eye(-3, 0.1, 0.2), x(1, 0, 0);
  EXPECT_EQ(scene.first_hit(eye, x)->range, 2);
  EXPECT_EQ(scene.first_hit(eye, x, 2, 2)->range, 2);
  EXPECT_EQ(scene.first_hit(eye, x, 2.0000001)->range, 4);
  EXPECT_FALSE(scene.first_hit(eye, x, 0, 1.9999999));
  EXPECT_FALSE(scene.first_hit(eye, x, 4.0000001));
  EXPECT_FALSE(scene.first_hit(eye, -x));
  EXPECT_TRUE(scene.sees(eye, {-1, 0.1, 0.2}, 1e-9));
  EXPECT_FALSE(scene.sees(eye, {1, 0.1, 0.2}, 1e-9));
}

#if defined(__SSE__)
TEST(MeshScene, LeavesTheFloatingPointEnvironment) {
  const Mesh mesh = testing::sphere(4);
  const unsigned before = _mm_getcsr();
  // As found by default, and with a mode and a flag that somebody else has set.
  for (const unsigned mode : {before, (before & ~_MM_ROUND_MASK) | _MM_ROUND_UP | _MM_EXCEPT_DENORM}) {
    _mm_setcsr(mode);
    {
      const MeshScene scene(mesh.points, mesh.triangles);
      EXPECT_EQ(_mm_getcsr(), mode);
      EXPECT_TRUE(scene.first_hit({3, 0.01, 0.02}, {-1, 0, 0}));
      EXPECT_EQ(_mm_getcsr(), mode);
    }
    EXPECT_EQ(_mm_getcsr(), mode);
    _mm_setcsr(before);
  }
}
#endif

TEST(MeshScene, RefusesWhatIsNoMesh) {
  Mesh mesh = testing::cube();
  const std::vector<Triangle> none;
  EXPECT_THROW(MeshScene(mesh.points, none), InputError);
  mesh.triangles[3][1] = 8;
  EXPECT_THROW(MeshScene(mesh.points, mesh.triangles), InputError);
  mesh = testing::cube();
  mesh.points[2].y() = std::nan("");
  EXPECT_THROW(MeshScene(mesh.points, mesh.triangles), InputError);
  // Without area, but a mesh: nothing is hit.
  const std::vector<Vector3d> line{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 0, 0}};
  const MeshScene flat(line, std::vector<Triangle>{{0, 1, 2}, {2, 3, 2}});
  EXPECT_FALSE(flat.first_hit({1, 1, 0}, {0, -1, 0}));
}

Isometry3d pose(const Vector3d& position, const Eigen::Matrix3d& rotation) {
  Isometry3d p;
  p.linear() = rotation;
  p.translation() = position;
  return p;
}

TEST(Scan, ReturnsAreOnTheMeshAndInTheirFrames) {
  Random random(7303);
  SCOPED_TRACE(random.trace());
  const Mesh mesh = testing::sphere(3).mapped(Vector3d(1, 2, 0.5).asDiagonal(), {8, 1, 2});
  const MeshScene scene(mesh.points, mesh.triangles);
  const Isometry3d agent = pose({1, 2, 3}, random.rotation<3>());
  Lidar lidar;
  lidar.pose = pose({0.2, 0.1, 0.3}, random.rotation<3>());
  lidar.beams = raster(181, 360, 2 * std::numbers::pi * 359 / 360, std::numbers::pi);
  const Scan result = scan(scene, lidar, agent, 1);
  ASSERT_EQ(result.beams.size(), 181U * 360U);
  EXPECT_GT(result.returns.size(), 200U);
  EXPECT_EQ(result.returns.size(), result.count(Beam::returned));
  EXPECT_EQ(result.returns.size() + result.count(Beam::missed), result.beams.size());
  for (const Return& r : result.returns) {
    EXPECT_EQ(result.beams[r.beam], Beam::returned);
    EXPECT_LT((agent * lidar.pose * r.in_sensor - r.in_world).norm(), 1e-14 * 20);
    EXPECT_LT(lidar.beams.direction(r.beam).cross(r.in_sensor).norm(), 1e-14 * 20);
    const Triangle& t = mesh.triangles[r.triangle];
    const Vector3d a = mesh.points[t[0]],
                   n = (mesh.points[t[1]] - a).cross(mesh.points[t[2]] - a).normalized();
    EXPECT_LT(std::abs(n.dot(r.in_world - a)), 1e-13);
    EXPECT_TRUE(scene.sees(result.pose.translation(), r.in_world, 1e-9));
  }
}

TEST(Scan, NoiseAndDropoutAreAsAsked) {
  // Inside a sphere every beam returns, and the range says what the noise was.
  const Mesh mesh = testing::sphere(5).mapped(10 * Eigen::Matrix3d::Identity(), Vector3d::Zero());
  const MeshScene scene(mesh.points, mesh.triangles);
  Lidar lidar;
  lidar.beams = spinning({-0.5, -0.25, 0, 0.25, 0.5}, 20'000);
  const Scan clean = scan(scene, lidar, Isometry3d::Identity(), 5);
  ASSERT_EQ(clean.count(Beam::returned), lidar.beams.size());
  lidar.range_noise = 0.02;
  lidar.dropout = 0.1;
  const Scan noisy = scan(scene, lidar, Isometry3d::Identity(), 5),
             again = scan(scene, lidar, Isometry3d::Identity(), 5),
             other = scan(scene, lidar, Isometry3d::Identity(), 6);
  const double n = double(lidar.beams.size());
  // Five standard deviations.
  EXPECT_NEAR(double(noisy.count(Beam::dropped)) / n, 0.1, 5 * std::sqrt(0.09 / n));
  double sum = 0, square = 0, fourth = 0;
  for (const Return& r : noisy.returns) {
    const double noise = r.in_sensor.norm() - clean.returns[r.beam].in_sensor.norm();
    sum += noise;
    square += noise * noise;
    fourth += std::pow(noise, 4);
  }
  const double m = double(noisy.returns.size());
  EXPECT_NEAR(sum / m, 0, 5 * 0.02 / std::sqrt(m));
  EXPECT_NEAR(square / m / (0.02 * 0.02), 1, 5 * std::sqrt(2 / m));
  EXPECT_NEAR(fourth / m / std::pow(0.02, 4), 3, 5 * std::sqrt(96 / m));
  ASSERT_EQ(noisy.beams, again.beams);
  for (std::size_t i = 0; i < noisy.returns.size(); ++i)
    EXPECT_EQ(noisy.returns[i].in_world, again.returns[i].in_world);
  EXPECT_NE(noisy.beams, other.beams);
  // A few beams alone, in one thread, get what they got among many.
  Lidar few = lidar;
  few.beams.elevations.resize(1);
  few.beams.azimuths.resize(2000);
  const Scan alone = scan(scene, few, Isometry3d::Identity(), 5);
  for (std::size_t i = 0; i < alone.returns.size(); ++i)
    EXPECT_EQ(alone.returns[i].in_world, noisy.returns[i].in_world);
}

TEST(Scan, TooNearHidesAndTooFarIsMissed) {
  const Mesh cube = testing::cube();
  const MeshScene scene(cube.points, cube.triangles);
  Lidar lidar;
  lidar.beams = raster(1, 1, 1, 1);
  const Isometry3d agent = pose({-3, 0.1, 0.2}, Eigen::Matrix3d::Identity());
  EXPECT_THAT(scan(scene, lidar, agent, 1).beams, ::testing::ElementsAre(Beam::returned));
  lidar.min_range = 2.5;
  EXPECT_THAT(scan(scene, lidar, agent, 1).beams, ::testing::ElementsAre(Beam::too_near));
  lidar.min_range = 0;
  lidar.max_range = 1.5;
  EXPECT_THAT(scan(scene, lidar, agent, 1).beams, ::testing::ElementsAre(Beam::missed));
}

TEST(Lidar, PatternsPointWhereTheySay) {
  const BeamPattern spin = spinning({0, 0.5}, 4);
  EXPECT_LT((spin.direction(5) - Vector3d(0, std::cos(0.5), std::sin(0.5))).norm(), 1e-15);
  const BeamPattern grid = raster(3, 5, 1.0, 0.4);
  EXPECT_EQ(grid.size(), 15U);
  EXPECT_NEAR(grid.spacing(), 0.25, 1e-15);
  EXPECT_LT((grid.direction(7) - Vector3d(1, 0, 0)).norm(), 1e-15);
  EXPECT_NEAR(std::atan2(grid.direction(0).y(), grid.direction(0).x()), -0.5, 1e-15);
  EXPECT_THROW(raster(0, 5, 1, 1), InputError);
  EXPECT_THROW(raster(1, 5, -1, 1), InputError);
  EXPECT_THROW(spinning({2}, 4), InputError);
  Lidar lidar;
  EXPECT_THROW(check(lidar), InputError);
  lidar.beams = grid;
  check(lidar);
  lidar.dropout = 1.5;
  EXPECT_THROW(check(lidar), InputError);
  lidar.dropout = 0;
  lidar.pose.linear() *= 2;
  EXPECT_THROW(check(lidar), InputError);
}

/// Noise takes no return out of the ranges, nor behind the sensor: what is measured there is none.
TEST(Scan, NoisyReturnsStayWithinTheRanges) {
  Mesh wall;
  wall.points = {{1.5, -9, -9}, {1.5, 9, -9}, {1.5, 9, 9}, {1.5, -9, 9}};
  wall.triangles = {{0, 1, 2}, {0, 2, 3}};
  const MeshScene scene(wall.points, wall.triangles);
  Lidar lidar;
  lidar.beams = raster(100, 100, 1e-3, 1e-3);  // all hits at 1.5 m
  lidar.range_noise = 0.5;
  for (const auto& [least, most] : {std::pair(0.0, 1000.0), std::pair(1.0, 1.6), std::pair(0.0, 1.6)}) {
    lidar.min_range = least;
    lidar.max_range = most;
    const Scan scan = lidar::scan(scene, lidar, Isometry3d::Identity(), 4);
    for (const Return& r : scan.returns) {
      EXPECT_GT(r.in_sensor.x(), 0);
      EXPECT_GE(r.in_sensor.norm(), least * (1 - 1e-12));
      EXPECT_LE(r.in_sensor.norm(), most * (1 + 1e-12));
    }
    const auto below = [](double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); };
    const double near = below((least - 1.5) / 0.5), far = below(-(most - 1.5) / 0.5);
    const auto share = [&](Beam what) { return double(scan.count(what)) / 10'000; };
    EXPECT_EQ(scan.returns.size(), scan.count(Beam::returned));
    EXPECT_NEAR(share(Beam::too_near), near, 0.02);
    EXPECT_NEAR(share(Beam::missed), far, 0.02);
    EXPECT_NEAR(share(Beam::returned), 1 - near - far, 0.02);
  }
}

}  // namespace
}  // namespace vericone::lidar::lidar_scan_test
