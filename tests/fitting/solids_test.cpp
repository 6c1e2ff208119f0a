// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/fitting/solids.h>

#include <Eigen/Geometry>

#include <cmath>
#include <random>
#include <vector>

namespace {

using namespace vericone;
using namespace vericone::fitting;
using Eigen::Matrix3d, Eigen::Vector3d;

Matrix3d some_turn(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const Eigen::Quaterniond q(normal(random), normal(random), normal(random), normal(random));
  return q.normalized().toRotationMatrix();
}

Solid some_solid(SolidKind kind, std::mt19937_64& random) {
  std::uniform_real_distribution<double> size(0.3, 1.2), place(-1, 1);
  return {kind,
          {place(random), place(random), place(random)},
          some_turn(random),
          {size(random), size(random), size(random)}};
}

std::vector<Vector3d> some_cloud(int count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<Vector3d> points;
  for (int i = 0; i < count; ++i) points.emplace_back(3 * normal(random), 2 * normal(random), normal(random));
  return points;
}

TEST(Solids, SurfacesAreClosedAndOfTheirVolume) {
  std::mt19937_64 random(1);
  for (const SolidKind kind : kSolidKinds) {
    const Solid solid = some_solid(kind, random);
    const CombinedSurface s = surface(solid);
    Sample mesh{s.vertices, {}};
    for (const auto& t : s.triangles)
      mesh.triangles.push_back(
          {std::uint32_t(t.vertices[0]), std::uint32_t(t.vertices[1]), std::uint32_t(t.vertices[2])});
    const std::optional<double> volume = enclosed_volume(mesh);
    ASSERT_TRUE(volume.has_value()) << to_string(kind);
    EXPECT_LE(*volume, solid.volume() * (1 + 1e-12)) << to_string(kind);
    EXPECT_GE(*volume, 0.985 * solid.volume()) << to_string(kind);
    for (const Vector3d& x : s.vertices) EXPECT_NEAR(solid.depth(x), 0, 1e-12);
  }
}

/// Against points thrown at random: an independent membership, in world coordinates.
TEST(Solids, VolumesOfUnionsAreThoseOfRandomPoints) {
  std::mt19937_64 random(2);
  for (int round = 0; round < 3; ++round) {
    std::vector<Solid> solids;
    for (const SolidKind kind : kSolidKinds) solids.push_back(some_solid(kind, random));
    constexpr int kThrown = 200'000;
    constexpr double kHalf = 4;
    std::uniform_real_distribution<double> place(-kHalf, kHalf);
    int hits = 0;
    for (int i = 0; i < kThrown; ++i) {
      const Vector3d x(place(random), place(random), place(random));
      bool inside = false;
      for (const Solid& s : solids) inside = inside || s.depth(x) >= 0;
      hits += inside;
    }
    const double share = double(hits) / kThrown, box = std::pow(2 * kHalf, 3);
    const VolumeEstimate found = volume(solids);
    EXPECT_NEAR(found.value, box * share, 5 * box * std::sqrt(share * (1 - share) / kThrown));
    EXPECT_LT(found.error, 1e-3 * found.value);
  }
}

/// Exact signs: whole numbers on the boundary are inside, a size in the last place less puts them out.
TEST(Solids, TouchingPointsAreInsideAndTheNextSizeIsNot) {
  const Matrix3d turn = (Matrix3d() << 0, -1, 0, 1, 0, 0, 0, 0, 1).finished();
  const auto inside = [&](const Solid& s, const Vector3d& x) {
    return check({s}, {{x}, {}}).points_inside == 1;
  };
  struct Case {
    Solid solid;
    Vector3d on;  // in the body's frame
    int size;     // that is in the way
  };
  for (const Case& c : {Case{{SolidKind::sphere, {1, 2, 3}, turn, {7, 0, 0}}, {2, 3, 6}, 0},
                        Case{{SolidKind::capsule, {1, 2, 3}, turn, {7, 8, 0}}, {2, 3, 10}, 0},
                        Case{{SolidKind::capsule, {1, 2, 3}, turn, {7, 8, 0}}, {2, 3, -10}, 1},
                        Case{{SolidKind::cylinder, {1, 2, 3}, turn, {5, 8, 0}}, {3, 4, 1}, 0},
                        Case{{SolidKind::cylinder, {1, 2, 3}, turn, {5, 8, 0}}, {1, 1, -4}, 1},
                        Case{{SolidKind::box, {1, 2, 3}, turn, {1, 2, 3}}, {1, 2, -3}, 2},
                        Case{{SolidKind::ellipsoid, {1, 2, 3}, turn, {2, 4, 8}}, {0, 4, 0}, 1}}) {
    const Vector3d x = c.solid.center + turn * c.on;
    EXPECT_TRUE(inside(c.solid, x)) << to_string(c.solid.kind);
    Solid less = c.solid;
    less.sizes(c.size) = std::nextafter(less.sizes(c.size), 0.0);
    EXPECT_FALSE(inside(less, x)) << to_string(c.solid.kind);
  }
}

TEST(Solids, FitsDoNotDependOnTheFrame) {
  const std::vector<Vector3d> cloud = some_cloud(300, 3);
  std::mt19937_64 random(4);
  for (const SolidKind kind : kSolidKinds) {
    SolidOptions options;
    options.kinds = {kind};
    const SolidFit first = fit_solids({cloud, {}}, options);
    EXPECT_TRUE(first.certified);
    for (const double scale : {1e-3, 1.0, 1e3}) {
      const Matrix3d turn = some_turn(random);
      Sample moved;
      for (const Vector3d& x : cloud) moved.points.push_back(scale * (turn * x + Vector3d(5, -7, 11)));
      const SolidFit again = fit_solids(moved, options);
      EXPECT_TRUE(again.certified);
      EXPECT_NEAR(again.volume.value / std::pow(scale, 3) / first.volume.value, 1, 1e-6) << to_string(kind);
    }
  }
}

TEST(Solids, FlatAndSingleSamplesHaveBodies) {
  std::vector<Vector3d> flat;
  for (Vector3d x : some_cloud(100, 5)) flat.emplace_back(x.x(), x.y(), 1);
  for (const SolidKind kind : {SolidKind::sphere, SolidKind::capsule, SolidKind::cylinder, SolidKind::box}) {
    SolidOptions options;
    options.kinds = {kind};
    EXPECT_TRUE(fit_solids({flat, {}}, options).certified) << to_string(kind);
    EXPECT_TRUE(fit_solids({{{0, 0, 0}, {1, 2, 3}}, {}}, options).certified) << to_string(kind);
  }
  SolidOptions ellipsoid;
  ellipsoid.kinds = {SolidKind::ellipsoid};
  EXPECT_THROW(fit_solids({flat, {}}, ellipsoid), InputError);
  EXPECT_THROW(check(std::vector<Solid>{}, {flat, {}}), InputError);
  Solid bad;
  bad.rotation *= 1.001;
  EXPECT_THROW(check({bad}, {flat, {}}), InputError);
}

}  // namespace
