// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cones over star-shaped polyhedra, facet against facet (combined_truth.h), against CGAL's Minkowski sum of
// the whole bodies as Nef polyhedra, which cuts them into convex pieces of its own.
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Polyhedron_incremental_builder_3.h>
#include <CGAL/minkowski_sum_3.h>
#include <gtest/gtest.h>
#include <vericone/internal/verify/combined/families.h>
#include <vericone/internal/verify/combined/truth.h>
#include <vericone/internal/verify/seeded_random.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace vericone::verify::combined_nef_test {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Polyhedron = CGAL::Polyhedron_3<Kernel>;
using Nef = CGAL::Nef_polyhedron_3<Kernel>;
using Point = Kernel::Point_3;
using Eigen::Vector3d;

/// The polyhedron, or its mirror image in the origin.
struct Build : CGAL::Modifier_base<Polyhedron::HalfedgeDS> {
  const StarPolyhedron& p;
  bool mirrored;
  Build(const StarPolyhedron& polyhedron, bool mirror) : p(polyhedron), mirrored(mirror) {}
  void operator()(Polyhedron::HalfedgeDS& target) override {
    CGAL::Polyhedron_incremental_builder_3<Polyhedron::HalfedgeDS> b(target, true);
    b.begin_surface(p.vertices.size(), p.facets.size());
    for (const GridVector& v : p.vertices) {
      const Vector3d x = (mirrored ? -1 : 1) * as_vector(v);
      b.add_vertex(Point(x.x(), x.y(), x.z()));
    }
    for (const auto& f : p.facets) {
      b.begin_facet();
      for (int i = 0; i < 3; ++i) b.add_vertex_to_facet(f[mirrored ? 2 - i : i]);
      b.end_facet();
    }
    b.end_surface();
  }
};

Nef nef(const StarPolyhedron& p, bool mirrored) {
  Polyhedron q;
  Build build(p, mirrored);
  q.delegate(build);
  EXPECT_TRUE(q.is_valid() && q.is_closed());
  return Nef(q);
}

bool ray_meets(const Nef& sum, const Vector3d& w) {
  // To a point beyond everything.
  const Vector3d end = 0x1p20 * w;
  std::vector<Point> points{Point(0, 0, 0), Point(end.x(), end.y(), end.z())};
  using Iterator = std::vector<Point>::iterator;
  std::vector<std::pair<Iterator, Iterator>> line{{points.begin(), points.end()}};
  Nef segment(line.begin(), line.end(), Nef::Polylines_tag());
  return !(sum * segment).is_empty();
}

TEST(CombinedTruth, FacetsAgreeWithTheSumOfNefPolyhedra) {
  constexpr int kUnit = -8;
  int in = 0, out = 0;
  const auto check = [&](const CombinedEllipsoid& a, const CombinedEllipsoid& b, const GridVector& c,
                         std::uint64_t index) {
    const StarPolyhedron p = polyhedral_bounds(a, 0, kUnit, {}).inner,
                         q = polyhedral_bounds(b, 0, kUnit, c).inner;
    ASSERT_EQ(p.facets.size(), 20);
    ASSERT_EQ(q.facets.size(), 20);
    ASSERT_TRUE(surely_apart(p, q));
    Nef first = nef(p, true), second = nef(q, false);
    const Nef sum = CGAL::minkowski_sum_3(first, second);
    SeededRandom random(780, 1, index);
    for (int k = 0; k < 12; ++k) {
      const Vector3d toward = as_vector(c).normalized() + random.uniform(0.2, 1.2) * random.direction<3>();
      const GridVector w = grid_direction(toward);
      const bool meets = ray_meets(sum, as_vector(w));
      EXPECT_EQ(surely_meets(p, q, w), meets) << k;
      EXPECT_EQ(surely_misses(p, q, w), !meets) << k;
      (meets ? in : out) += 1;
    }
  };
  // A dented body with both dents on vertices of the icosahedron, and a waisted one.
  const Ellipsoid ball = Ellipsoid::from_axes({0, 0, 0}, {4, 4, 4}),
                  small = Ellipsoid::from_axes({0, 0, 0}, {1, 2, 1.5});
  const double s = 1 / std::hypot(1, std::numbers::phi);
  Eigen::Matrix3d turn;
  turn.col(0) = Vector3d(-s, std::numbers::phi * s, 0);
  turn.col(1) = Vector3d(0, 0, 1);
  turn.col(2) = turn.col(0).cross(turn.col(1));
  const CombinedEllipsoid dented(ball, {hyperboloid(2, {1.2, 1.5, 1.5}, turn)}),
      waisted(ball, {hyperboloid(1, {2, 1.5, 1.5}, turn)});
  check(small, dented, {1100, 800, 700}, 0);
  check(dented, small, {-900, 1200, 400}, 1);
  check(small, waisted, {1000, -700, 900}, 2);
  // Both not convex.
  check(waisted, dented, {1500, 1300, -800}, 3);
  EXPECT_GT(in, 10);
  EXPECT_GT(out, 10);
}

}  // namespace
}  // namespace vericone::verify::combined_nef_test
