// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <vericone/internal/verify/seeded_random.h>
#include <vericone/internal/verify/spatial/min_ellipsoid_check.h>

#include <Eigen/LU>

#include <cmath>

#ifdef VERICONE_HAVE_FILES
#include <vericone/files/files.h>
#include <vericone/geometry/error.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "geometry/files/written_files.h"
#endif

namespace vericone::verify::min_ellipsoid_test {
namespace {

constexpr std::uint64_t kSeed = 20250301;
constexpr int kClouds = 40;
constexpr double kEpsilon = 1e-3;  // of volume, asked of CGAL

template <int D>
Eigen::Matrix<double, D, 1> in_box(SeededRandom& random) {
  Eigen::Matrix<double, D, 1> p;
  for (int i = 0; i < D; ++i) p(i) = random.uniform(-1, 1);
  return p;
}

/// A random linear map and a small shift. CGAL updates the inverse of a matrix of coordinates thousands of
/// times in doubles, so its certificate holds as far as that inverse does: the map is kept well-conditioned.
template <int D>
struct Affine {
  Eigen::Matrix<double, D, D> linear;
  Eigen::Matrix<double, D, 1> shift;

  explicit Affine(SeededRandom& random) {
    do {
      for (int i = 0; i < D; ++i) {
        for (int j = 0; j < D; ++j) linear(i, j) = random.uniform(-1, 1);
        shift(i) = random.uniform(-1, 1);
      }
    } while (std::abs(linear.determinant()) < 0.1);
  }
  Eigen::Matrix<double, D, 1> operator()(const Eigen::Matrix<double, D, 1>& p) const {
    return linear * p + shift;
  }
};

template <int D>
void expect_agreement(const std::vector<Eigen::Matrix<double, D, 1>>& points, double& nearest) {
  const MinEllipsoidComparison<D> c = compare_min_ellipsoid<D>(points, kEpsilon);
  EXPECT_EQ(c.outside_ours, 0);
  EXPECT_EQ(c.outside_cgal, 0);
  EXPECT_TRUE(c.ours.converged());
  EXPECT_LE(c.ours.volume_ratio_bound, 1 + 1e-6);
  EXPECT_LE(c.cgal_ratio_bound, 1 + 1.01 * kEpsilon);
  EXPECT_TRUE(c.volumes_agree()) << c.our_volume << " bound " << c.ours.volume_ratio_bound << ", CGAL "
                                 << c.cgal_volume << " bound " << c.cgal_ratio_bound;
  nearest = std::min(nearest, c.cgal_volume / c.our_volume - 1);
  EXPECT_LE(c.our_volume, c.cgal_volume);  // ours is the smaller one by much more than its own gap
}

template <int D>
void random_clouds() {
  double nearest = 1;
  for (std::uint64_t index = 0; index < kClouds; ++index) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + " index " + std::to_string(index));
    SeededRandom random(300 + D, kSeed, index);
    const Affine<D> map(random);
    const int count = D + 2 + random.integer(0, index % 2 ? 10 : 1000);
    std::vector<Eigen::Matrix<double, D, 1>> points;
    for (int i = 0; i < count; ++i) points.push_back(map(in_box<D>(random)));
    expect_agreement<D>(points, nearest);
  }
  std::printf("CGAL's volume is at least %.2g larger\n", nearest);
}

/// Points on an ellipsoid, to rounding: all of them are nearly active.
template <int D>
void on_ellipsoids() {
  double nearest = 1;
  for (std::uint64_t index = 0; index < kClouds; ++index) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + " index " + std::to_string(index));
    SeededRandom random(310 + D, kSeed, index);
    const Affine<D> map(random);
    const int count = D + 2 + random.integer(0, 300);
    std::vector<Eigen::Matrix<double, D, 1>> points;
    for (int i = 0; i < count; ++i) points.push_back(map(random.direction<D>()));
    expect_agreement<D>(points, nearest);
    if (count > 100) {
      // Dense enough to fix the ellipsoid: its volume is that of the map.
      const double volume = (D == 2 ? 1 : 4.0 / 3) * 3.14159265358979 * std::abs(map.linear.determinant());
      const MinEllipsoidComparison<D> c = compare_min_ellipsoid<D>(points, kEpsilon);
      EXPECT_NEAR(c.our_volume / volume, 1, 1e-6);
    }
  }
  std::printf("CGAL's volume is at least %.2g larger\n", nearest);
}

#ifdef VERICONE_HAVE_FILES
/// About their middle and within the unit cube, where CGAL's certificate holds.
std::vector<Eigen::Vector3d> near_origin(std::vector<Eigen::Vector3d> points) {
  Eigen::Vector3d low = points.front(), high = low;
  for (const auto& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  for (auto& p : points) p = (p - 0.5 * (low + high)) / (0.5 * (high - low).maxCoeff());
  return points;
}

/// Every file with points that are not in one plane; the number of those.
std::size_t real_files(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::size_t checked = 0;
  for (const auto& path : paths) {
    SCOPED_TRACE(path.filename());
    std::vector<Eigen::Vector3d> points;
    MinVolumeResult<3> r;
    try {
      points = files::read_points(path).points;
      r = min_volume_ellipsoid<3>(points);
    } catch (const InputError&) {
      continue;  // no file of points, or a flat one
    }
    ++checked;
    EXPECT_TRUE(r.converged());
    EXPECT_LT(r.optimality_gap, 1e-6);
    EXPECT_LT(r.volume_ratio_bound - 1, 2e-6);
    if (points.size() < 5) continue;
    points = near_origin(std::move(points));
    const double volume = min_volume_ellipsoid<3>(points).body.volume();
    const CgalMinEllipsoid<3> cgal = cgal_min_ellipsoid<3>(points, 0.01);
    EXPECT_LE(cgal.ratio_bound, 1.0101);
    EXPECT_LE(cgal.volume, cgal.ratio_bound * volume * (1 + 1e-12));
    EXPECT_LE(volume, r.volume_ratio_bound * cgal.volume * (1 + 1e-12));
  }
  return checked;
}

TEST(MinEllipsoid, RealScans) {
  const char* given = std::getenv("VERICONE_DATA_DIR");
  const std::filesystem::path folder(given ? given : VERICONE_DEFAULT_DATA_DIR);
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not here";
  EXPECT_GT(real_files(folder), 0);
}

TEST(MinEllipsoid, MeshesAndCloudsOfCgal) {
  if (!std::filesystem::exists(VERICONE_CGAL_MESHES))
    GTEST_SKIP() << VERICONE_CGAL_MESHES << " is not here (libcgal-demo)";
  const testing::TemporaryDirectory directory;
  const std::string command =
      "tar -xzf '" VERICONE_CGAL_MESHES "' -C '" + directory.path().string() + "' data/meshes data/points_3";
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_GT(real_files(directory.path() / "data" / "meshes"), 50);
  EXPECT_GT(real_files(directory.path() / "data" / "points_3"), 10);
}
#endif

TEST(MinEllipsoid, RandomCloudsInThePlane) { random_clouds<2>(); }
TEST(MinEllipsoid, RandomCloudsInSpace) { random_clouds<3>(); }
TEST(MinEllipsoid, PointsOnEllipses) { on_ellipsoids<2>(); }
TEST(MinEllipsoid, PointsOnEllipsoids) { on_ellipsoids<3>(); }

}  // namespace
}  // namespace vericone::verify::min_ellipsoid_test
