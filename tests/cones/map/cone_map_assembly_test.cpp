// SPDX-License-Identifier: BSD-3-Clause
//
// Cone maps of meshes, boxes and clouds: orifice cones of windows, doors and rings.
#include <gtest/gtest.h>
#include <vericone/cones/map/cone_map.h>
#include <vericone/internal/cones/assembly/assembly_oracle.h>
#include <vericone/internal/cones/hulls/hull_oracle.h>
#include <vericone/internal/cones/map/cell.h>
#include <vericone/internal/cones/map/classifiers.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

#include "cones/map/cone_map_checks.h"

namespace vericone::cone_map_assembly_test {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;
using testing::cap, testing::expect_never_contradicted, testing::RandomBodies;

ConeMap map_of(const DirectionClassifier& classifier, double resolution) {
  ConeMapOptions options;
  options.resolution = resolution;
  return cone_map(classifier, options);
}

Ellipsoid ball(double radius, const Vector3d& center = Vector3d::Zero()) {
  return Ellipsoid::from_axes(center, {radius, radius, radius});
}

/// Piece by piece with the exact predicate of hulls.
template <typename Agent>
class Brute {
 public:
  Brute(const Agent& agent, const Assembly& obstacle) {
    for (std::size_t i = 0; i < obstacle.size(); ++i) oracles_.emplace_back(agent, obstacle.piece(i));
  }
  Certified operator()(const Vector3d& d) const {
    for (const HullOracle& o : oracles_)
      if (o.membership(d) != Membership::out) return Certified::in;
    return Certified::out;
  }

 private:
  std::vector<HullOracle> oracles_;
};

/// A grid of squares in the plane x = 4, each of two triangles, without those that `open` names.
template <typename Open>
Assembly wall(int per_metre, double half, const Open& open) {
  const int n = static_cast<int>(2 * half * per_metre);
  std::vector<Vector3d> points;
  std::vector<Assembly::Triangle> triangles;
  const auto at = [&](double i) { return -half + i / per_metre; };
  for (int i = 0; i <= n; ++i)
    for (int k = 0; k <= n; ++k) points.emplace_back(4, at(i), at(k));
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      if (open(Vector2d(at(i + 0.5), at(k + 0.5)))) continue;
      const auto a = static_cast<std::uint32_t>(i * (n + 1) + k), b = a + static_cast<std::uint32_t>(n) + 1;
      triangles.push_back({a, b, a + 1});
      triangles.push_back({b, b + 1, a + 1});
    }
  return Assembly::mesh(std::move(points), std::move(triangles));
}

/// Distance of the ray from the origin along the unit vector d from the segment: the least over the segment
/// of the distance of its points, a convex function, by thirds.
double distance_from_ray(const Vector3d& d, const Vector3d& a, const Vector3d& b) {
  const auto distance = [&](double s) {
    const Vector3d x = (1 - s) * a + s * b;
    return (x - std::max(0.0, x.dot(d)) * d).norm();
  };
  double low = 0, high = 1;
  for (int i = 0; i < 60; ++i) {
    const double s = (2 * low + high) / 3, t = (low + 2 * high) / 3;
    (distance(s) < distance(t) ? high : low) = distance(s) < distance(t) ? t : s;
  }
  return distance(0.5 * (low + high));
}

TEST(ConeMapOfAssemblies, TheWindowOfAWallIsItsOrificeCone) {
  RandomBodies random(21);
  SCOPED_TRACE(random.trace());
  // A window of 2 m x 1.5 m, off the middle.
  const Vector2d low(-0.5, -0.75), high(1.5, 0.75);
  const auto open = [&](const Vector2d& x) {
    return low.x() < x.x() && x.x() < high.x() && low.y() < x.y() && x.y() < high.y();
  };
  const Assembly obstacle = wall(4, 5, open);
  const Vector3d through(4, 0.5, 0);
  for (const double radius : {0.1, 0.4}) {
    // Through the window and no nearer to its four edges than the radius.
    const Vector3d corner[] = {
        {4, low.x(), low.y()}, {4, high.x(), low.y()}, {4, high.x(), high.y()}, {4, low.x(), high.y()}};
    const auto passes = [&](const Vector3d& direction) {
      const Vector3d d = direction.normalized();
      if (!(d.x() > 0) || !open(Vector2d(d.y(), d.z()) * (4 / d.x()))) return false;
      for (int i = 0; i < 4; ++i)
        if (distance_from_ray(d, corner[i], corner[(i + 1) % 4]) < radius) return false;
      return true;
    };
    double truth = 0;  // d Omega = du dv / (1 + u^2 + v^2)^(3/2) for the direction (1, u, v)
    constexpr int kGrid = 400;
    const Vector2d step = (high - low) / 4 / kGrid;
    for (int i = 0; i < kGrid; ++i)
      for (int k = 0; k < kGrid; ++k) {
        const Vector3d d(1, low.x() / 4 + (i + 0.5) * step.x(), low.y() / 4 + (k + 0.5) * step.y());
        if (passes(d)) truth += step.x() * step.y() / std::pow(d.norm(), 3);
      }
    double before = 1;
    for (const double resolution : {0.04, 0.02, 0.01}) {
      const ConeMap map = map_of(AssemblyOracle(ball(radius), obstacle), resolution);
      const auto region = region_around(map, through);
      ASSERT_TRUE(region);
      EXPECT_EQ(region->label, Certified::out);
      EXPECT_LE(region->solid_angle, truth * 1.003);
      EXPECT_GE(region->most_solid_angle, truth * 0.997);
      EXPECT_LT(region->most_solid_angle - region->solid_angle, 0.7 * before);
      before = region->most_solid_angle - region->solid_angle;
      const auto around = region_around(map, {-1, 0, 0});
      ASSERT_TRUE(around);
      EXPECT_NE(region->possible, around->possible) << "proved to be apart";
      EXPECT_EQ(region->boundary.size(), 1);
      for (int i = 0; i < 2000; ++i) {
        const Vector3d d = (Vector3d(4, random.uniform(low.x() - 0.5, high.x() + 0.5),
                                     random.uniform(low.y() - 0.5, high.y() + 0.5)));
        const Certified label = map.cells[cell_at(map, d)].label;
        if (label != Certified::undecided) {
          ASSERT_EQ(label == Certified::out, passes(d)) << d.transpose();
        }
      }
    }
    std::cout << "[ window   ] radius " << radius << " m: " << truth << " sr\n";
  }
}

TEST(ConeMapOfAssemblies, ATorusHasAHole) {
  RandomBodies random(22);
  SCOPED_TRACE(random.trace());
  std::vector<Vector3d> points;
  std::vector<Assembly::Triangle> triangles;
  constexpr int kAround = 40, kTube = 16;
  const Vector3d center(5, 0, 0);
  for (int i = 0; i < kAround; ++i)
    for (int k = 0; k < kTube; ++k) {
      const double u = 2 * std::numbers::pi * i / kAround, v = 2 * std::numbers::pi * k / kTube;
      const double r = 2 + 0.5 * std::cos(v);
      points.push_back(center + Vector3d(0.5 * std::sin(v), r * std::cos(u), r * std::sin(u)));
      const auto at = [](int a, int b) {
        return static_cast<std::uint32_t>(a % kAround * kTube + b % kTube);
      };
      triangles.push_back({at(i, k), at(i + 1, k), at(i, k + 1)});
      triangles.push_back({at(i + 1, k), at(i + 1, k + 1), at(i, k + 1)});
    }
  const Assembly torus = Assembly::mesh(points, triangles);
  const Ellipsoid agent = Ellipsoid::from_axes({0, 0, 0}, {0.5, 0.3, 0.2}, random.rotation());
  const ConeMap map = map_of(AssemblyOracle(agent, torus), 0.01);
  expect_never_contradicted(map, random, 1500, Brute(agent, torus));
  const auto hole = region_around(map, {1, 0, 0}), outside = region_around(map, {-1, 0, 0});
  ASSERT_TRUE(hole && outside);
  EXPECT_NE(hole->possible, outside->possible);
  EXPECT_NE(hole->cells, outside->cells);
  const auto body = region_around(map, {5, 2, 0});
  ASSERT_TRUE(body);
  EXPECT_EQ(body->label, Certified::in);
  EXPECT_EQ(body->boundary.size(), 2) << "outside, and the hole";
  EXPECT_LT(map.undecided, 0.1);
  // A ball too large for the hole finds none.
  const ConeMap large = map_of(AssemblyOracle(ball(1.6), torus), 0.02);
  for (const auto& r : regions(large)) {
    if (r.label == Certified::out) {
      EXPECT_EQ(r.possible, region_around(large, {-1, 0, 0})->possible);
    }
  }
  EXPECT_EQ(region_around(large, {1, 0, 0})->label, Certified::in);
}

/// The shell of a room of 4 m x 3 m x 2.5 m of cubes, as of an octree, with a door in the wall x = 2.
std::vector<Box> room(double cube, bool door) {
  std::vector<Box> boxes;
  const Vector3d half(2, 1.5, 1.25);
  const Eigen::Array3i n = (2 * half / cube).array().round().cast<int>();
  for (int i = -1; i <= n.x(); ++i)
    for (int j = -1; j <= n.y(); ++j)
      for (int k = -1; k <= n.z(); ++k) {
        const Eigen::Array3i at(i, j, k);
        if (((at >= 0) && (at < n)).all()) continue;
        const Vector3d low = -half + cube * at.cast<double>().matrix();
        const bool in_door =
            i == n.x() && low.y() >= -1e-9 && low.y() < 1 - 1e-9 && k >= 0 && low.z() < 0.75 - 1e-9;
        if (!(door && in_door)) boxes.push_back({low, low + Vector3d::Constant(cube)});
      }
  return boxes;
}

TEST(ConeMapOfAssemblies, OutOfARoomLeadsTheDoor) {
  RandomBodies random(23);
  SCOPED_TRACE(random.trace());
  const HullBody agent = HullBody::box({-0.6, -0.3, -0.3}, {-0.2, 0.1, 0.2});
  const Assembly walls = Assembly::boxes(room(0.25, true));
  const AssemblyOracle oracle(agent, walls);
  ASSERT_EQ(oracle.relation(), Relation::disjoint);
  const ConeMap map = map_of(oracle, 0.01);
  expect_never_contradicted(map, random, 600, Brute(agent, walls));
  const Vector3d to_door = Vector3d(2.125, 0.5, -0.25) - Vector3d(-0.4, -0.1, -0.05);
  const auto way = region_around(map, to_door);
  ASSERT_TRUE(way);
  EXPECT_EQ(way->label, Certified::out);
  EXPECT_EQ(way->boundary.size(), 1) << "no cells that could not be decided within";
  // Nothing else leads out.
  for (const auto& r : regions(map))
    if (r.label == Certified::out) {
      EXPECT_EQ(r.possible, way->possible);
    }
  EXPECT_GE(way->most_solid_angle, map.safe);
  EXPECT_GT(way->solid_angle, 0.02);
  // With the door shut every direction collides: proved, but for seams if any.
  const ConeMap shut = map_of(AssemblyOracle(agent, Assembly::boxes(room(0.25, false))), 0.02);
  EXPECT_EQ(shut.safe, 0);
  EXPECT_LT(shut.undecided, 0.01);
}

TEST(ConeMapOfAssemblies, ConvexPolyhedraAndEllipsoids) {
  RandomBodies random(26);
  SCOPED_TRACE(random.trace());
  const auto hull_at = [&](const Vector3d& center) {
    std::vector<Vector3d> points;
    for (int i = 0; i < 12; ++i) points.push_back(center + random.in_box(0.8));
    return HullBody(points);
  };
  const auto truth = [](const HullOracle& oracle) {
    return [&](const Vector3d& d) {
      return oracle.membership(d) == Membership::out ? Certified::out : Certified::in;
    };
  };
  for (int k = 0; k < 5; ++k) {
    const Vector3d at = random.uniform(3, 6) * random.direction();
    const HullBody agent = hull_at({0, 0, 0}), obstacle = hull_at(at);
    const ConeMap hulls = map_of(AssemblyOracle(agent, Assembly::polyhedra({obstacle})), 0.01);
    expect_never_contradicted(hulls, random, 1000, truth(HullOracle(agent, obstacle)));
    EXPECT_LT(hulls.undecided, 0.05);
    // A polyhedron before an ellipsoid: the two exchanged.
    const Ellipsoid body = random.ellipsoid(at, 0.3, 1);
    const ConeMap exchanged = map_of(
        MirroredClassifier(std::make_shared<AssemblyOracle>(body, Assembly::polyhedra({agent}))), 0.01);
    expect_never_contradicted(exchanged, random, 1000, truth(HullOracle(agent, body)));
    EXPECT_LT(exchanged.undecided, 0.05);
  }
}

TEST(ConeMapOfAssemblies, ACloudOfPoints) {
  RandomBodies random(24);
  SCOPED_TRACE(random.trace());
  std::vector<Vector3d> points;
  for (int i = 0; i < 300; ++i) points.push_back(random.uniform(3, 6) * random.direction());
  const Assembly cloud = Assembly::cloud(points, 0.1);
  const Ellipsoid agent = Ellipsoid::from_axes({0, 0, 0}, {0.3, 0.2, 0.1}, random.rotation());
  const AssemblyOracle oracle(agent, cloud);
  const ConeMap map = map_of(oracle, 0.01);
  expect_never_contradicted(map, random, 3000, [&](const Vector3d& d) {
    return oracle.membership(d) == Membership::out ? Certified::out : Certified::in;
  });
  EXPECT_GT(regions(map).size(), 3);
  // One ball alone: a circle.
  const ConeMap one = map_of(AssemblyOracle(ball(0.5), Assembly::cloud({{3, 4, 0}}, 0.75)), 0.01);
  EXPECT_LE(one.colliding, cap(std::asin(0.25)));
  EXPECT_GE(one.colliding + one.undecided, cap(std::asin(0.25)));
}

TEST(ConeMapOfAssemblies, AScannedObject) {
  const char* given = std::getenv("VERICONE_DATA_DIR");
  const auto file = std::filesystem::path(given ? given : VERICONE_DEFAULT_DATA_DIR) / "stanford-bunny.obj";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not here";
  std::vector<Vector3d> points;
  std::vector<Assembly::Triangle> triangles;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "v") words >> points.emplace_back().x() >> points.back().y() >> points.back().z();
    if (kind != "f") continue;
    auto& t = triangles.emplace_back();
    for (std::uint32_t& corner : t) {
      words >> kind;
      corner = static_cast<std::uint32_t>(std::stoul(kind)) - 1;
    }
  }
  ASSERT_EQ(triangles.size(), 69451);
  const Assembly bunny = Assembly::mesh(points, triangles);
  const Vector3d middle = bunny.bounds().center();
  const Ellipsoid agent = ball(0.01, middle + Vector3d(0.1, 0.1, 0.25));
  const AssemblyOracle oracle(agent, bunny);
  const auto start = std::chrono::steady_clock::now();
  const ConeMap map = map_of(oracle, 0.01);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  RandomBodies random(25);
  SCOPED_TRACE(random.trace());
  expect_never_contradicted(map, random, 100, Brute(agent, bunny));
  expect_never_contradicted(map, random, 5000, [&](const Vector3d& d) {
    return oracle.membership(d) == Membership::out ? Certified::out : Certified::in;
  });
  EXPECT_EQ(map.cells[cell_at(map, middle - agent.center())].label, Certified::in);
  EXPECT_GT(map.colliding, 0.1);
  EXPECT_LT(map.undecided, 0.05);
  std::cout << "[ bunny    ] " << map.colliding << " to " << map.colliding + map.undecided << " sr, "
            << map.cells.size() << " cells, " << map.asked << " asked, " << seconds << " s\n";
}

}  // namespace
}  // namespace vericone::cone_map_assembly_test
