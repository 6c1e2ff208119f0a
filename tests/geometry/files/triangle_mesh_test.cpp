// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vericone/files/files.h>
#include <vericone/geometry/error.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <map>
#include <set>

#include "support/random.h"

namespace vericone::files::triangle_mesh_test {
namespace {

using Eigen::Vector3d;
using testing::Random;
using Rational = boost::multiprecision::cpp_rational;

PointFile of(std::vector<Vector3d> points, std::vector<Face> faces) {
  PointFile file;
  file.points = std::move(points);
  file.faces = std::move(faces);
  return file;
}

std::vector<Vector3d> cube_points() {
  std::vector<Vector3d> points;
  for (int i = 0; i < 8; ++i) points.emplace_back(i & 1, i >> 1 & 1, i >> 2);
  return points;
}
// Counter-clockwise from outside.
const std::vector<Face> kCube = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                 {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};

TEST(TriangleMesh, OfACubeIsClosed) {
  const TriangleMesh mesh = triangle_mesh(of(cube_points(), kCube));
  EXPECT_EQ(mesh.triangles.size(), 12U);
  EXPECT_EQ(mesh.report.polygons, 6U);
  EXPECT_EQ(mesh.report.edges, 18U);
  EXPECT_EQ(mesh.report.degenerate_triangles + mesh.report.duplicate_triangles +
                mesh.report.unreferenced_points + mesh.report.boundary_edges + mesh.report.nonmanifold_edges,
            0U);
  EXPECT_TRUE(mesh.report.is_closed());
  EXPECT_TRUE(mesh.report.is_oriented());
}

TEST(TriangleMesh, TellsHolesTurnedFacesAndTwins) {
  auto faces = kCube;
  faces.pop_back();
  MeshReport report = triangle_mesh(of(cube_points(), faces)).report;
  EXPECT_EQ(report.boundary_edges, 4U);
  EXPECT_FALSE(report.is_closed());
  EXPECT_TRUE(report.is_oriented());

  faces = kCube;
  std::ranges::reverse(faces[2]);
  report = triangle_mesh(of(cube_points(), faces)).report;
  EXPECT_TRUE(report.is_closed());
  EXPECT_EQ(report.misoriented_edges, 4U);
  EXPECT_FALSE(report.is_oriented());

  // A face twice: its edges are of three triangles, its diagonal of four.
  faces = kCube;
  faces.push_back(faces.front());
  report = triangle_mesh(of(cube_points(), faces)).report;
  EXPECT_EQ(report.duplicate_triangles, 2U);
  EXPECT_EQ(report.nonmanifold_edges, 5U);
  EXPECT_EQ(report.odd_edges, 4U);
  EXPECT_FALSE(report.is_closed());
}

TEST(TriangleMesh, TwinsAreLeftOutWhereAskedFor) {
  const TriangleMesh once = triangle_mesh(of(cube_points(), kCube));
  for (const bool turned : {false, true}) {
    std::vector<Face> triangles;
    for (const auto& t : once.triangles) triangles.push_back({t[0], t[1], t[2]});
    for (const auto& t : once.triangles)
      triangles.push_back(turned ? Face{t[2], t[1], t[0]} : Face{t[1], t[2], t[0]});
    const TriangleMesh mesh = triangle_mesh(of(cube_points(), triangles), {.drop_duplicates = true});
    EXPECT_EQ(mesh.report.duplicate_triangles, once.triangles.size());
    EXPECT_EQ(mesh.triangles, once.triangles);
    EXPECT_TRUE(mesh.report.is_closed() && mesh.report.is_oriented());
    EXPECT_EQ(mesh.report.nonmanifold_edges, 0U);
  }
}

TEST(TriangleMesh, TwoCubesOnAnEdgeAreClosed) {
  auto points = cube_points();
  std::vector<Face> faces = kCube;
  // Edge 2-6 of the second is edge 1-5 of the first.
  for (int i = 0; i < 8; ++i) points.push_back(cube_points()[std::size_t(i)] + Vector3d(1, -1, 0));
  for (Face face : kCube) {
    for (auto& v : face) v = v == 2 ? 1 : v == 6 ? 5 : v + 8;
    faces.push_back(face);
  }
  const MeshReport report = triangle_mesh(of(points, faces)).report;
  EXPECT_EQ(report.nonmanifold_edges, 1U);
  EXPECT_EQ(report.odd_edges, 0U);
  EXPECT_EQ(report.unreferenced_points, 2U);
  EXPECT_TRUE(report.is_closed());
  EXPECT_TRUE(report.is_oriented());
}

TEST(TriangleMesh, EqualPointsAreMergedWhereAskedFor) {
  // Each face with points of its own, as texture seams and STL have it; zeros of either sign.
  std::vector<Vector3d> points;
  std::vector<Face> faces;
  for (const Face& face : kCube) {
    faces.emplace_back();
    for (const auto v : face) {
      faces.back().push_back(std::uint32_t(points.size()));
      points.push_back(cube_points()[v]);
      if (points.size() % 2)
        for (double& x : points.back()) x = x == 0 ? -0.0 : x;
    }
  }
  const MeshReport apart = triangle_mesh(of(points, faces)).report;
  EXPECT_EQ(apart.boundary_edges, 24U);
  MeshOptions merged;
  merged.merge_equal_points = true;
  const TriangleMesh mesh = triangle_mesh(of(points, faces), merged);
  EXPECT_EQ(mesh.points.size(), 8U);
  EXPECT_TRUE(mesh.report.is_closed());
}

TEST(TriangleMesh, DegenerateTrianglesAreCountedAndDroppedWhereAskedFor) {
  const std::vector<Vector3d> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, 0, 0}, {1, 0, 0}, {9, 9, 9}};
  const std::vector<Face> faces = {{0, 1, 2}, {0, 3, 1}, {0, 1, 4}, {2, 2, 0}, {5, 5, 5}, {0, 3, 2}};
  const TriangleMesh kept = triangle_mesh(of(points, faces));
  EXPECT_EQ(kept.triangles.size(), 6U);
  EXPECT_EQ(kept.report.degenerate_triangles, 4U);
  EXPECT_EQ(kept.report.unreferenced_points, 0U);
  MeshOptions drop;
  drop.drop_degenerate = true;
  const TriangleMesh dropped = triangle_mesh(of(points, faces), drop);
  EXPECT_THAT(dropped.triangles, ::testing::ElementsAre(std::array<std::uint32_t, 3>{0, 1, 2},
                                                        std::array<std::uint32_t, 3>{0, 3, 2}));
  EXPECT_EQ(dropped.report.degenerate_triangles, 4U);
  EXPECT_EQ(dropped.report.unreferenced_points, 2U);
  // Nothing but points and segments is a mesh still.
  const MeshReport flat = triangle_mesh(of(points, {{0, 3, 1}, {5, 5, 5}})).report;
  EXPECT_EQ(flat.degenerate_triangles, 2U);
}

TEST(TriangleMesh, CloudsAreRefused) { EXPECT_THROW(triangle_mesh(of(cube_points(), {})), InputError); }

/// The same counts in other ways, on meshes of a few points that have every fault.
TEST(TriangleMesh, CountsAreThoseOfMaps) {
  Random random(450);
  SCOPED_TRACE(random.trace());
  for (int round = 0; round < 300; ++round) {
    const int n = random.integer(3, 9);
    std::vector<Vector3d> points;
    for (int i = 0; i < n; ++i)
      points.emplace_back(random.integer(0, 2), random.integer(0, 2), random.integer(0, 1));
    std::vector<Face> faces;
    for (int i = random.integer(1, 30); i > 0; --i) {
      faces.emplace_back();
      for (int k = 0; k < 3; ++k) faces.back().push_back(std::uint32_t(random.integer(0, n - 1)));
    }
    std::map<std::set<std::uint32_t>, std::pair<int, int>> edges;
    std::map<std::set<std::uint32_t>, int> corners;
    std::set<std::uint32_t> used;
    std::size_t degenerate = 0, duplicates = 0;
    for (const Face& f : faces) {
      used.insert(f.begin(), f.end());
      const Vector3d area = (points[f[1]] - points[f[0]]).cross(points[f[2]] - points[f[0]]);
      degenerate += area == Vector3d(0, 0, 0);  // small integers: exact
      const std::set<std::uint32_t> set(f.begin(), f.end());
      if (set.size() < 3) continue;
      duplicates += corners[set]++ > 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = f[k], b = f[(k + 1) % 3];
        auto& [up, down] = edges[{a, b}];
        ++(a < b ? up : down);
      }
    }
    MeshReport truth;
    for (const auto& [edge, ways] : edges) {
      const int all = ways.first + ways.second;
      truth.boundary_edges += all == 1;
      truth.nonmanifold_edges += all > 2;
      truth.odd_edges += all % 2 == 1;
      truth.misoriented_edges += std::abs(ways.first - ways.second) > 1;
    }
    const MeshReport report = triangle_mesh(of(points, faces)).report;
    ASSERT_EQ(report.edges, edges.size());
    ASSERT_EQ(report.boundary_edges, truth.boundary_edges);
    ASSERT_EQ(report.nonmanifold_edges, truth.nonmanifold_edges);
    ASSERT_EQ(report.odd_edges, truth.odd_edges);
    ASSERT_EQ(report.misoriented_edges, truth.misoriented_edges);
    ASSERT_EQ(report.degenerate_triangles, degenerate);
    ASSERT_EQ(report.duplicate_triangles, duplicates);
    ASSERT_EQ(report.unreferenced_points, std::size_t(n) - used.size());
  }
}

bool collinear_in_rationals(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  std::array<Rational, 3> u, v;
  for (int i = 0; i < 3; ++i) {
    u[std::size_t(i)] = Rational(b(i)) - Rational(a(i));
    v[std::size_t(i)] = Rational(c(i)) - Rational(a(i));
  }
  return u[0] * v[1] == u[1] * v[0] && u[1] * v[2] == u[2] * v[1] && u[2] * v[0] == u[0] * v[2];
}

TEST(Collinear, IsExact) {
  Random random(451);
  SCOPED_TRACE(random.trace());
  int yes = 0, no = 0;
  for (int round = 0; round < 3000; ++round) {
    // Points of a short line on a grid, of any size, perhaps one rounding away from it.
    const double scale = std::ldexp(1, random.integer(-1000, 900));
    const Vector3d start(random.integer(-1000, 1000), random.integer(-1000, 1000),
                         random.integer(-1000, 1000));
    const Vector3d step(random.integer(-9, 9), random.integer(-9, 9), random.integer(-9, 9));
    std::array<Vector3d, 3> p;
    for (auto& x : p) x = scale * (start + random.integer(-99, 99) * step);
    if (round % 2) {
      double& x = p[2](random.integer(0, 2));
      x = std::nextafter(x, random.integer(0, 1) ? 1e308 : -1e308);
    }
    const bool truth = collinear_in_rationals(p[0], p[1], p[2]);
    ASSERT_EQ(are_collinear(p[0], p[1], p[2]), truth)
        << p[0].transpose() << ", " << p[1].transpose() << ", " << p[2].transpose();
    ++(truth ? yes : no);
  }
  EXPECT_GT(yes, 1000);
  EXPECT_GT(no, 1000);
  constexpr double kMost = std::numeric_limits<double>::max(),
                   kLeast = std::numeric_limits<double>::denorm_min();
  EXPECT_TRUE(are_collinear({-kMost, 0, 0}, {kMost, 0, 0}, {1, 0, 0}));
  EXPECT_FALSE(are_collinear({-kMost, 0, 0}, {kMost, 0, 0}, {1, kLeast, 0}));
  EXPECT_FALSE(are_collinear({0, 0, 0}, {kLeast, 0, 0}, {0, 0, kLeast}));
}

}  // namespace
}  // namespace vericone::files::triangle_mesh_test
