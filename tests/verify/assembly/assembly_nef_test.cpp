// SPDX-License-Identifier: GPL-3.0-or-later
//
// Closed meshes with notches and holes and convex polyhedra as agents: rays against CGAL's Minkowski sums of
// Nef polyhedra, which know nothing of pieces.
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Polyhedron_incremental_builder_3.h>
#include <CGAL/convex_hull_3.h>
#include <CGAL/minkowski_sum_3.h>
#include <gtest/gtest.h>
#include <vericone/cones/map/cone_map.h>
#include <vericone/internal/cones/assembly/assembly_oracle.h>
#include <vericone/internal/cones/map/cell.h>
#include <vericone/internal/verify/seeded_random.h>

#include <array>
#include <cmath>
#include <map>
#include <vector>

namespace vericone::verify::assembly_nef_test {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Polyhedron = CGAL::Polyhedron_3<Kernel>;
using Nef = CGAL::Nef_polyhedron_3<Kernel>;
using Point = Kernel::Point_3;
using Eigen::Vector3d;

struct Mesh {
  std::vector<Vector3d> points;
  std::vector<Assembly::Triangle> triangles;

  void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    triangles.push_back({a, b, c});
    triangles.push_back({a, c, d});
  }
};

/// A ring of n sides about the z axis, corners on integers: a square profile carried round. n = 4: a window.
Mesh ring(const std::vector<std::array<int, 2>>& inner, int outer_factor, int half_height) {
  Mesh m;
  const auto n = static_cast<std::uint32_t>(inner.size());
  // For each corner: inner low, inner high, outer low, outer high.
  for (const auto& [x, y] : inner)
    for (int factor : {1, outer_factor})
      for (int z : {-half_height, half_height}) m.points.emplace_back(factor * x, factor * y, z);
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t a = 4 * i, b = 4 * ((i + 1) % n);
    m.quad(a + 2, b + 2, b + 3, a + 3);  // outer
    m.quad(a, a + 1, b + 1, b);          // inner
    m.quad(a + 1, a + 3, b + 3, b + 1);  // above
    m.quad(a, b, b + 2, a + 2);          // below
  }
  return m;
}

/// An L of three unit cubes by 4, two high.
Mesh l_shape() {
  Mesh m;
  const int xy[6][2] = {{0, 0}, {8, 0}, {8, 4}, {4, 4}, {4, 8}, {0, 8}};
  for (int z : {-2, 2})
    for (const auto& p : xy) m.points.emplace_back(p[0], p[1], z);
  for (std::uint32_t i = 0; i < 6; ++i) m.quad(i, (i + 1) % 6, 6 + (i + 1) % 6, 6 + i);
  for (const auto& [a, b, c, d] : {std::array<std::uint32_t, 4>{0, 1, 2, 3}, {0, 3, 4, 5}}) {
    m.quad(a + 6, b + 6, c + 6, d + 6);
    m.quad(d, c, b, a);
  }
  return m;
}

void move(Mesh& m, const Vector3d& by) {
  for (Vector3d& x : m.points) x += by;
}

struct Build : CGAL::Modifier_base<Polyhedron::HalfedgeDS> {
  const Mesh& m;
  explicit Build(const Mesh& mesh) : m(mesh) {}
  void operator()(Polyhedron::HalfedgeDS& target) override {
    CGAL::Polyhedron_incremental_builder_3<Polyhedron::HalfedgeDS> b(target, true);
    b.begin_surface(m.points.size(), m.triangles.size());
    for (const Vector3d& x : m.points) b.add_vertex(Point(x.x(), x.y(), x.z()));
    for (const auto& t : m.triangles) {
      b.begin_facet();
      for (auto i : t) b.add_vertex_to_facet(i);
      b.end_facet();
    }
    b.end_surface();
  }
};

Nef nef(const Mesh& m) {
  Polyhedron p;
  Build build(m);
  p.delegate(build);
  EXPECT_TRUE(p.is_valid() && p.is_closed());
  return Nef(p);
}

Nef mirrored_hull(const std::vector<Vector3d>& points) {
  std::vector<Point> converted;
  for (const Vector3d& x : points) converted.emplace_back(-x.x(), -x.y(), -x.z());
  Polyhedron p;
  CGAL::convex_hull_3(converted.begin(), converted.end(), p);
  return Nef(p);
}

class Sum {
 public:
  Sum(const Mesh& obstacle, const std::vector<Vector3d>& agent) {
    Nef a = mirrored_hull(agent), b = nef(obstacle);
    closed_ = CGAL::minkowski_sum_3(a, b);
    interior_ = closed_.interior();
  }
  /// From a little way out to beyond everything.
  Membership along(const Vector3d& w) const {
    std::vector<Point> points{Point(0, 0, 0), Point(0x1p20 * w.x(), 0x1p20 * w.y(), 0x1p20 * w.z())};
    using Iterator = std::vector<Point>::iterator;
    std::vector<std::pair<Iterator, Iterator>> line{{points.begin(), points.end()}};
    const Nef segment(line.begin(), line.end(), Nef::Polylines_tag());
    if ((closed_ * segment).is_empty()) return Membership::out;
    return (interior_ * segment).is_empty() ? Membership::on : Membership::in;
  }

 private:
  Nef closed_, interior_;
};

struct Tally {
  std::array<int, 3> answers{};
};

/// All velocities with the same answer; those exactly through corners, along edges, and random ones.
void compare(const Mesh& mesh, const std::vector<Vector3d>& agent, std::uint64_t index, Tally& tally) {
  SCOPED_TRACE("case " + std::to_string(index));
  const Sum sum(mesh, agent);
  const HullBody body(agent);
  const AssemblyOracle oracle(body, Assembly::mesh(mesh.points, mesh.triangles));
  ASSERT_EQ(oracle.relation(), Relation::disjoint);
  SeededRandom random(950, 1, index);
  const auto any = [&](const std::vector<Vector3d>& points) {
    return points[static_cast<std::size_t>(random.integer(0, static_cast<int>(points.size()) - 1))];
  };
  for (int k = 0; k < 200; ++k) {
    Vector3d w = any(mesh.points) - any(agent);
    if (k % 4 == 1) w += any(mesh.points) - any(agent);
    if (k % 4 == 2)
      for (int i = 0; i < 3; ++i) w(i) += random.integer(-2, 2);
    if (k % 4 == 3)
      for (int i = 0; i < 3; ++i) w(i) += random.uniform(-6, 6);
    const Membership truth = sum.along(w);
    ++tally.answers[static_cast<std::size_t>(truth)];
    const Membership found = oracle.membership(w);
    // Pieces are triangles: along a common edge of two, or in the plane of a facet, both are only touched
    // where the solid is overlapped. What is met is met.
    EXPECT_EQ(found == Membership::out, truth == Membership::out) << w.transpose();
    if (truth == Membership::on) {
      EXPECT_EQ(found, Membership::on) << w.transpose();
    }
    const auto contact = oracle.first_contact(w);
    EXPECT_EQ(contact.has_value(), truth != Membership::out);
  }
}

std::vector<Vector3d> box_agent(const Vector3d& half) { return HullBody::box(-half, half).points(); }
std::vector<Vector3d> tetrahedron() { return {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}; }
std::vector<Vector3d> octahedron() {
  return {{2, 0, 0}, {-2, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
}

const std::vector<std::array<int, 2>> kSquare{{4, 4}, {-4, 4}, {-4, -4}, {4, -4}},
    kHexagon{{4, 0}, {2, 3}, {-2, 3}, {-4, 0}, {-2, -3}, {2, -3}},
    kOctagon{{5, 2}, {2, 5}, {-2, 5}, {-5, 2}, {-5, -2}, {-2, -5}, {2, -5}, {5, -2}};

TEST(AssemblyNef, RaysMeetTheSumsOfNefPolyhedra) {
  Tally tally;
  std::uint64_t index = 0;
  for (const auto& agent : {tetrahedron(), box_agent({1, 1, 2}), octahedron()}) {
    Mesh l = l_shape();
    move(l, {7, 5, 6});
    compare(l, agent, index++, tally);
    Mesh window = ring(kSquare, 2, 1);
    move(window, {1, -1, 14});
    compare(window, agent, index++, tally);
    Mesh torus = ring(index % 2 ? kHexagon : kOctagon, 2, 2);
    move(torus, {-2, 1, 15});
    compare(torus, agent, index++, tally);
  }
  std::printf("9 sums: in %d on %d out %d\n", tally.answers[0], tally.answers[1], tally.answers[2]);
  EXPECT_GT(tally.answers[0], 500);
  EXPECT_GT(tally.answers[1], 40);
  EXPECT_GT(tally.answers[2], 200);
}

TEST(AssemblyNef, TheConeThroughTheWindowIsSafe) {
  const auto agent = box_agent({1, 1, 1});
  Mesh window = ring(kSquare, 2, 1);
  move(window, {0, 0, 14});
  const Sum sum(window, agent);
  const AssemblyOracle oracle(HullBody(agent), Assembly::mesh(window.points, window.triangles));
  // The hole of half width 4 less 1, the nearer rim at 13 - 1, the farther at 15 + 1: |x| < 3 z / 16.
  const auto at = [](double x, double y) { return Vector3d(x, y, 16); };
  for (double s : {-1.0, 1.0}) {
    EXPECT_EQ(sum.along(at(3 * s, 0)), Membership::on);
    EXPECT_EQ(oracle.membership(at(3 * s, 0)), Membership::on);
    EXPECT_EQ(oracle.membership(at(3 * s, 3)), Membership::on);
    EXPECT_EQ(oracle.membership(at(0, std::nextafter(3 * s, 4 * s))), Membership::in);
    EXPECT_EQ(oracle.membership(at(0, std::nextafter(3 * s, 0))), Membership::out);
  }
  // Safe cells of the map cover the inside of the opening, none reaches beyond it; the sum agrees.
  ConeMapOptions options;
  options.resolution = 0.03;
  const ConeMap map = cone_map(oracle, options);
  EXPECT_EQ(map.cells[cell_at(map, at(0, 0))].label, Certified::out);
  int through = 0;
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    const DirectionCell cell = map.cell(i);
    const Vector3d middle = cell[0] + cell[1] + cell[2];
    if (middle.z() < 0.7 * middle.norm() || map.cells[i].label == Certified::undecided) continue;
    const bool hole =
        std::abs(middle.x()) < 3 * middle.z() / 16 && std::abs(middle.y()) < 3 * middle.z() / 16;
    if (hole) {
      EXPECT_EQ(map.cells[i].label, Certified::out);
      if (++through % 4 == 0) {
        for (const Vector3d& d : cell) EXPECT_EQ(sum.along(d), Membership::out);
      }
    }
  }
  EXPECT_GT(through, 20);
}

}  // namespace
}  // namespace vericone::verify::assembly_nef_test
