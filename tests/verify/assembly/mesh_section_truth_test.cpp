// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sections of real meshes against CGAL's slicer in exact constructions.
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_slicer.h>
#include <CGAL/Surface_mesh.h>
#include <gtest/gtest.h>
#include <vericone/internal/geometry/mesh/mesh_section.h>
#include <vericone/internal/verify/seeded_random.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "verify/campaigns/real_data.h"

namespace vericone::verify::mesh_section_truth_test {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Eigen::Vector2d;
using Eigen::Vector3d;

struct Line {
  bool closed = false;
  double length = 0, area = 0;
  bool operator<(const Line& o) const { return std::pair(closed, length) < std::pair(o.closed, o.length); }
};

/// Pieces of some length, in order of it.
struct Section {
  std::vector<Line> lines;
  double length = 0;

  void add(const Line& line) {
    if (line.length == 0) return;
    lines.push_back(line);
    length += line.length;
  }
  void sort() { std::sort(lines.begin(), lines.end()); }
  std::size_t longer_than(double least) const {
    return std::count_if(lines.begin(), lines.end(), [&](const Line& l) { return l.length > least; });
  }
};

Section ours(const RealMesh& mesh, const PlaneFrame& plane) {
  Section r;
  for (const SectionLine& s : mesh_section(mesh.points, mesh.triangles, plane)) {
    Line line{s.closed, 0, s.closed ? std::abs(signed_area(s)) : 0};
    for (std::size_t i = 0; i + (s.closed ? 0 : 1) < s.points.size(); ++i)
      line.length += (s.points[(i + 1) % s.points.size()] - s.points[i]).norm();
    r.add(line);
  }
  r.sort();
  return r;
}

Section of_cgal(CGAL::Polygon_mesh_slicer<Mesh, Kernel>& slicer, const PlaneFrame& plane) {
  const Vector3d n = plane.normal();
  const auto& o = plane.origin;
  std::vector<std::vector<Kernel::Point_3>> polylines;
  slicer(Kernel::Plane_3(Kernel::Point_3(o.x(), o.y(), o.z()), Kernel::Vector_3(n.x(), n.y(), n.z())),
         std::back_inserter(polylines));
  Section r;
  for (const auto& polyline : polylines) {
    Line line{polyline.size() > 2 && polyline.front() == polyline.back(), 0, 0};
    Vector3d first, last, twice = Vector3d::Zero();
    for (std::size_t i = 0; i < polyline.size(); ++i) {
      const auto& p = polyline[i];
      const Vector3d x(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()));
      if (i == 0) first = x;
      if (i > 0) line.length += (x - last).norm();
      if (i > 0) twice += (last - first).cross(x - first);
      last = x;
    }
    if (line.closed) line.area = twice.norm() / 2;
    r.add(line);
  }
  r.sort();
  return r;
}

class Sections : public ::testing::TestWithParam<std::string> {};

TEST_P(Sections, AreThoseOfCgal) {
  const auto mesh = real_mesh(GetParam());
  if (!mesh) GTEST_SKIP() << not_here(GetParam());
  Mesh exact;
  std::vector<Mesh::Vertex_index> vertices;
  for (const Vector3d& x : mesh->points)
    vertices.push_back(exact.add_vertex(Kernel::Point_3(x.x(), x.y(), x.z())));
  for (const auto& t : mesh->triangles)
    ASSERT_NE(exact.add_face(vertices[t[0]], vertices[t[1]], vertices[t[2]]), Mesh::null_face());
  CGAL::Polygon_mesh_slicer<Mesh, Kernel> slicer(exact);
  double size = 0;
  for (const Vector3d& x : mesh->points)
    size = std::max(size, (x - mesh->points.front()).cwiseAbs().maxCoeff());

  constexpr std::uint64_t kSeed = 1;
  std::size_t cut = 0, through_vertices = 0, several = 0;
  for (std::uint64_t index = 0; index < 50; ++index) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", plane " + std::to_string(index));
    SeededRandom random(930, kSeed, index);
    const int last = static_cast<int>(mesh->points.size()) - 1;
    const Vector3d corner = mesh->points[static_cast<std::size_t>(random.integer(0, last))];
    const bool through = index % 3 == 0;  // exactly through a vertex of the mesh
    const Vector3d normal = random.direction<3>();
    PlaneFrame plane;
    plane.origin = corner;
    if (!through) plane.origin += 0.1 * size * random.direction<3>();
    plane.x_axis = normal.unitOrthogonal();
    plane.y_axis = normal.cross(plane.x_axis);
    const Section a = ours(*mesh, plane), b = of_cgal(slicer, plane);
    EXPECT_NEAR(a.length, b.length, 1e-9 * (b.length + 1e-6 * size));
    // Through a saddle pieces may be joined either way.
    if (through && a.lines.size() != b.lines.size()) continue;
    ASSERT_EQ(a.longer_than(1e-9 * size), b.longer_than(1e-9 * size));
    if (a.lines.size() != b.lines.size()) continue;
    for (std::size_t i = 0; i < a.lines.size(); ++i) {
      EXPECT_EQ(a.lines[i].closed, b.lines[i].closed);
      EXPECT_NEAR(a.lines[i].length, b.lines[i].length, 1e-9 * (a.length + 1e-6 * size));
      EXPECT_NEAR(a.lines[i].area, b.lines[i].area, 1e-9 * (a.length * a.length + 1e-6 * size * size));
    }
    cut += !a.lines.empty();
    through_vertices += through;
    several += a.lines.size() > 1;
  }
  std::printf("%s: %zu triangles, %zu planes cut it, %zu exactly through a vertex, %zu in several pieces\n",
              GetParam().c_str(), mesh->triangles.size(), cut, through_vertices, several);
  EXPECT_GT(cut, 35);
  EXPECT_GT(through_vertices, 10);
}

INSTANTIATE_TEST_SUITE_P(Real, Sections,
                         ::testing::Values("216Kleopatra.obj", "ycb_006_mustard_bottle.obj",
                                           "stanford-bunny.obj", "data/meshes/elephant.off",
                                           "data/meshes/knot1.off", "data/meshes/homer.off",
                                           "data/meshes/holes.off", "data/meshes/armadillo.off"),
                         [](const auto& mesh) {
                           std::string name;
                           for (char c : std::filesystem::path(mesh.param).stem().string())
                             name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
                           return name;
                         });

}  // namespace
}  // namespace vericone::verify::mesh_section_truth_test
