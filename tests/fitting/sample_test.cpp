// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/fitting/hull.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/fitting/canonical.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <numeric>
#include <random>

namespace vericone::fitting::sample_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Sample skewed_cloud(std::uint64_t seed, int count) {
  std::mt19937_64 engine(seed);
  std::exponential_distribution<double> skewed(1);
  Sample sample;
  for (int i = 0; i < count; ++i)
    sample.points.emplace_back(3 * skewed(engine), 2 * skewed(engine), skewed(engine));
  return sample;
}

/// Four vertices of a lopsided tetrahedron, the first one twice.
Sample tetrahedron() {
  Sample sample;
  sample.points = {{0, 0, 0}, {4, 0, 0}, {0, 2, 0}, {0, 0, 1}, {0, 0, 0}, {9, 9, 9}};
  sample.triangles = {{0, 2, 1}, {4, 1, 3}, {4, 3, 2}, {1, 2, 3}};
  return sample;
}

TEST(CanonicalSample, IsTheSameInEveryFrameAndOrder) {
  const Sample sample = skewed_cloud(1, 500);
  const CanonicalSample first = canonical(sample);
  const Matrix3d turn = Eigen::AngleAxisd(1.1, Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  for (const double scale : {1e-3, 1.0, 1e3}) {
    Sample moved = sample;
    for (Vector3d& x : moved.points) x = scale * (turn * x + Vector3d(5, -7, 3));
    std::shuffle(moved.points.begin(), moved.points.end(), std::mt19937_64(7));
    const CanonicalSample other = canonical(moved);
    ASSERT_EQ(other.points.size(), first.points.size());
    for (std::size_t i = 0; i < first.points.size(); ++i)
      EXPECT_LT((other.points[i] - first.points[i]).norm(), 1e-13) << i;
    EXPECT_NEAR(other.frame.scale / first.frame.scale, scale, 1e-13 * scale);
  }
}

TEST(CanonicalSample, DoesNotDependOnTheOrderBitForBit) {
  Sample sample = skewed_cloud(2, 300);
  sample.points.insert(sample.points.end(), sample.points.begin(), sample.points.begin() + 40);
  const CanonicalSample first = canonical(sample);
  EXPECT_EQ(first.points.size(), 300u);
  std::shuffle(sample.points.begin(), sample.points.end(), std::mt19937_64(3));
  const CanonicalSample other = canonical(sample);
  EXPECT_EQ(other.points, first.points);
  EXPECT_EQ(other.weights, first.weights);
  EXPECT_EQ(other.frame.origin, first.frame.origin);
}

TEST(CanonicalSample, FrameGivesThePointsBack) {
  const Sample sample = skewed_cloud(4, 100);
  const CanonicalSample canon = canonical(sample);
  EXPECT_LT((canon.frame.axes * canon.frame.axes.transpose() - Matrix3d::Identity()).norm(), 1e-14);
  EXPECT_GT(canon.frame.axes.determinant(), 0);
  double reach = 0;
  for (std::size_t i = 0; i < canon.points.size(); ++i) {
    EXPECT_LT((canon.frame.to_world(canon.points[i]) - sample.points[canon.original[i]]).norm(), 1e-13);
    reach = std::max(reach, canon.points[i].norm());
  }
  EXPECT_NEAR(reach, 1, 1e-14);
}

TEST(CanonicalSample, MeshesCountByArea) {
  const CanonicalSample canon = canonical(tetrahedron());
  EXPECT_EQ(canon.points.size(), 4u);  // neither the copy nor the point that nothing uses
  EXPECT_EQ(canon.triangles.size(), 4u);
  EXPECT_NEAR(std::accumulate(canon.weights.begin(), canon.weights.end(), 0.0), 1, 1e-15);
  // Areas 4, 2, 1 and that of the slanted face; the origin has the first three.
  const double slanted = Vector3d(-4, 2, 0).cross(Vector3d(-4, 0, 1)).norm() / 2;
  for (std::size_t i = 0; i < 4; ++i)
    if (const Vector3d x = tetrahedron().points[canon.original[i]]; x.isZero()) {
      EXPECT_NEAR(canon.weights[i], 7 / (3 * (7 + slanted)), 1e-14);
    }
  for (const auto& t : canon.triangles) EXPECT_TRUE(t[0] < t[1] && t[0] < t[2]);
}

TEST(CanonicalSample, TrianglesWithoutAreaAreLeftOut) {
  Sample sample = tetrahedron();
  sample.triangles.push_back({0, 4, 1});
  EXPECT_EQ(canonical(sample).triangles.size(), 4u);
}

TEST(CanonicalSample, RefusesWhatIsNoSample) {
  const auto field = [](const Sample& sample) {
    try {
      canonical(sample);
      return std::string("accepted");
    } catch (const InputError& e) {
      return e.field();
    }
  };
  EXPECT_EQ(field({}), "points");
  EXPECT_EQ(field({{{1, 2, 3}, {1, 2, 3}}, {}}), "points");
  EXPECT_EQ(field({{{1, 2, 3}, {1, std::nan(""), 3}}, {}}), "points[1]");
  EXPECT_EQ(field({{{1, 2, 3}, {1, 1e101, 3}}, {}}), "points[1]");
  EXPECT_EQ(field({{{1, 2, 3}, {1, 1, 3}}, {{0, 1, 2}}}), "triangles[0]");
}

}  // namespace
}  // namespace vericone::fitting::sample_test
