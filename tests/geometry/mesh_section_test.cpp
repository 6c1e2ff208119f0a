// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vericone/internal/geometry/mesh/mesh_section.h>

#include <cmath>
#include <numbers>
#include <set>

#include "geometry/meshes.h"
#include "support/random.h"

namespace vericone::mesh_section_test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::Mesh;
using testing::Random;

PlaneFrame frame(const Vector3d& origin, const Vector3d& normal) {
  PlaneFrame plane;
  plane.origin = origin;
  plane.x_axis = normal.unitOrthogonal();
  plane.y_axis = normal.normalized().cross(plane.x_axis);
  return plane;
}

double area(const std::vector<SectionLine>& lines) {
  double sum = 0;
  for (const SectionLine& line : lines) sum += signed_area(line);
  return sum;
}

/// Every piece closed, every segment in its triangle, every triangle at most once.
void expect_sound(const Mesh& mesh, const PlaneFrame& plane, const std::vector<SectionLine>& lines,
                  double size) {
  std::set<std::uint32_t> seen;
  for (const SectionLine& line : lines) {
    EXPECT_TRUE(line.closed);
    EXPECT_EQ(line.triangles.size(), line.points.size() > 1 ? line.points.size() : 0);
    for (std::size_t i = 0; i < line.triangles.size(); ++i) {
      EXPECT_TRUE(seen.insert(line.triangles[i]).second);
      const auto& t = mesh.triangles[line.triangles[i]];
      const Vector3d a = mesh.points[t[0]], u = mesh.points[t[1]] - a, v = mesh.points[t[2]] - a;
      const Vector2d next = line.points[(i + 1) % line.points.size()];
      EXPECT_NE(line.points[i], next);
      for (const Vector2d& p : {line.points[i], next}) {
        const Vector3d x = plane.to_space(p) - a;
        EXPECT_LT(std::abs(u.cross(v).normalized().dot(x)), 1e-12 * size);
        const Vector3d n = u.cross(v);
        EXPECT_GT(u.cross(x).dot(n), -1e-12 * size * size * size * size);
        EXPECT_GT(x.cross(v).dot(n), -1e-12 * size * size * size * size);
      }
    }
  }
}

TEST(MeshSection, EllipsoidsHaveOneLoopOfTheKnownArea) {
  Random random(7501);
  SCOPED_TRACE(random.trace());
  const Mesh fine = testing::sphere(5);
  double worst = 0;
  for (int i = 0; i < 100; ++i) {
    const Eigen::Matrix3d factor =
        random.rotation<3>() *
        Vector3d(random.uniform(0.3, 3), random.uniform(0.3, 3), random.uniform(0.3, 3)).asDiagonal();
    const Vector3d center = 5 * random.vector<3>(), normal = random.vector<3>().normalized();
    const Mesh mesh = fine.mapped(factor, center);
    const double height = random.uniform(-0.95, 0.95), rho = (factor.transpose() * normal).norm();
    const PlaneFrame plane = frame(center + height * rho * normal + random.vector<3>().cross(normal), normal);
    const auto lines = mesh_section(mesh.points, mesh.triangles, plane);
    ASSERT_EQ(lines.size(), 1U);
    expect_sound(mesh, plane, lines, 20);
    // In the plane at h the section of the ellipsoid is (1 - h^2) of the central one, of area pi |F| / rho.
    const double exact = std::numbers::pi * (1 - height * height) * std::abs(factor.determinant()) / rho;
    // The mesh is inside, by up to (edge / radius)^2 / 8 along normals; relative to a small section it is
    // more.
    const double edge = 0.04, missing = 1 - area(lines) / exact;
    EXPECT_GT(missing, 0);
    EXPECT_LT(missing, edge * edge / 2 / (1 - height * height));
    worst = std::max(worst, missing);
  }
  EXPECT_GT(worst, 1e-4);  // that the bound is not idle
}

TEST(MeshSection, AreasSumToTheVolume) {
  // Of any closed mesh: between the heights of corners the area is quadratic, and two Gauss points are exact.
  Random random(7502);
  SCOPED_TRACE(random.trace());
  Mesh mesh = testing::sphere(1);
  for (auto& p : mesh.points) p *= random.uniform(0.2, 1.5);
  double volume = 0;
  for (const auto& t : mesh.triangles)
    volume += mesh.points[t[0]].dot(mesh.points[t[1]].cross(mesh.points[t[2]])) / 6;
  for (int i = 0; i < 10; ++i) {
    const Vector3d normal = random.vector<3>().normalized();
    std::vector<double> heights;
    for (const auto& p : mesh.points) heights.push_back(normal.dot(p));
    std::sort(heights.begin(), heights.end());
    double sum = 0;
    for (std::size_t k = 0; k + 1 < heights.size(); ++k) {
      const double low = heights[k], high = heights[k + 1];
      const auto at = [&](double part) {
        const PlaneFrame plane = frame((low + part * (high - low)) * normal, normal);
        return area(mesh_section(mesh.points, mesh.triangles, plane));
      };
      const double g = 0.5 / std::sqrt(3.0);
      sum += (high - low) * 0.5 * (at(0.5 - g) + at(0.5 + g));
    }
    EXPECT_NEAR(sum, volume, 1e-10 * std::abs(volume));
  }
}

TEST(MeshSection, CornersInThePlaneCountAsAbove) {
  const Mesh cube = testing::cube();
  const auto at = [&](double z, double up = 1) {
    return mesh_section(cube.points, cube.triangles, {{0, 0, z}, {1, 0, 0}, {0, up, 0}});
  };
  // The top face in the plane: its border. The bottom face: nothing is below. From the other side it is the
  // other way about, clockwise as seen in the mirrored coordinates.
  EXPECT_NEAR(area(at(1)), 4, 1e-15);
  ASSERT_EQ(at(1).size(), 1U);
  EXPECT_TRUE(at(1)[0].closed);
  EXPECT_EQ(at(1)[0].points.size(), 4U);
  EXPECT_TRUE(at(-1).empty());
  EXPECT_TRUE(at(1, -1).empty());
  EXPECT_NEAR(area(at(-1, -1)), 4, 1e-15);
  EXPECT_NEAR(area(at(0)), 4, 1e-15);
  EXPECT_TRUE(at(1.0000001).empty());
  EXPECT_NEAR(area(at(std::nextafter(1.0, 0))), 4, 1e-14);
  // By a corner: a point. Along a diagonal plane through edges: the rectangle.
  const PlaneFrame corner = frame({1, 1, 1}, {1, 1, 1});
  const auto touch = mesh_section(cube.points, cube.triangles, corner);
  ASSERT_EQ(touch.size(), 1U);
  EXPECT_EQ(touch[0].points.size(), 1U);
  EXPECT_TRUE(touch[0].closed && touch[0].triangles.empty());
  const PlaneFrame diagonal{{0, 0, 0}, {0, 0, 1}, Vector3d(1, 1, 0)};
  const auto cut = mesh_section(cube.points, cube.triangles, diagonal);
  ASSERT_EQ(cut.size(), 1U);
  EXPECT_NE(signed_area(cut[0]), 0);
  EXPECT_TRUE(cut[0].closed);
}

TEST(MeshSection, DegeneratePlanesOfAnyMeshGiveClosedPieces) {
  // Planes through corners and edges, exactly: corners on a grid, planes spanned by three of them.
  Random random(7503);
  SCOPED_TRACE(random.trace());
  Mesh mesh = testing::sphere(2);
  for (auto& p : mesh.points)
    for (int k = 0; k < 3; ++k) p(k) = std::round(p(k) * 3);  // also triangles without area
  int on_plane = 0, pieces = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto corner = [&]() -> const Vector3d& {
      return mesh.points[random.integer(0, int(mesh.points.size()) - 1)];
    };
    const Vector3d o = corner(), x = corner() - o, y = corner() - o;
    if (x.cross(y).isZero()) continue;
    const PlaneFrame plane{o, x, y};
    for (const auto& p : mesh.points) on_plane += plane.normal().dot(p - o) == 0;
    for (const SectionLine& line : mesh_section(mesh.points, mesh.triangles, plane)) {
      EXPECT_TRUE(line.closed);
      ++pieces;
    }
  }
  EXPECT_GT(on_plane, 10'000);
  EXPECT_GT(pieces, 1'000);
}

TEST(MeshSection, OpenMeshesGiveOpenPieces) {
  Mesh mesh = testing::sphere(3);
  std::erase_if(mesh.triangles, [&](const auto& t) { return mesh.points[t[0]].x() > 0.5; });
  const PlaneFrame plane{{0, 0, 0.01}, {1, 0, 0}, {0, 1, 0}};
  const auto lines = mesh_section(mesh.points, mesh.triangles, plane);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_FALSE(lines[0].closed);
  EXPECT_EQ(lines[0].triangles.size(), lines[0].points.size() - 1);
  // Counter-clockwise: from the upper border of the hole over -x to the lower one.
  EXPECT_GT(lines[0].points.front().y(), 0.5);
  EXPECT_LT(lines[0].points.back().y(), -0.5);
  // Turned triangles are joined all the same.
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3)
    std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
  EXPECT_EQ(mesh_section(mesh.points, mesh.triangles, plane).size(), 1U);
}

TEST(MeshSection, SeveralPiecesAndHoles) {
  Mesh mesh = testing::sphere(3).mapped(2 * Eigen::Matrix3d::Identity(), {0, 0, 0});
  Mesh hole = testing::sphere(3);
  for (auto& t : hole.triangles) std::swap(t[1], t[2]);
  mesh.append(hole);
  mesh.append(testing::sphere(3).mapped(Eigen::Matrix3d::Identity(), {5, 0, 0}));
  const auto lines = mesh_section(mesh.points, mesh.triangles, {{0, 0, 0.01}, {1, 0, 0}, {0, 1, 0}});
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_NEAR(area(lines), 4 * std::numbers::pi, 0.15);
  EXPECT_TRUE(mesh_section(mesh.points, mesh.triangles, {{0, 0, 9}, {1, 0, 0}, {0, 1, 0}}).empty());
}

}  // namespace
}  // namespace vericone::mesh_section_test
