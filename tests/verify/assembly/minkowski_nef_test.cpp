// SPDX-License-Identifier: GPL-3.0-or-later
//
// The Minkowski sums of minkowski_bounds.h, hulls of all pairwise sums, against CGAL's sums of Nef polyhedra,
// which know nothing of convexity.
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/convex_hull_3.h>
#include <CGAL/minkowski_sum_3.h>
#include <gtest/gtest.h>
#include <vericone/internal/verify/seeded_random.h>
#include <vericone/internal/verify/spatial/minkowski_bounds.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace vericone::verify::minkowski_nef_test {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Polyhedron = CGAL::Polyhedron_3<Kernel>;
using Nef = CGAL::Nef_polyhedron_3<Kernel>;
using Eigen::Vector3d;

/// Random points about the origin, on a grid that makes their sums exact.
std::vector<Vector3d> cloud(SeededRandom& random, int count) {
  Vector3d axes;
  for (int i = 0; i < 3; ++i) axes(i) = random.uniform(1, 10);
  const Eigen::Matrix3d turn = random.rotation();
  std::vector<Vector3d> points;
  for (int i = 0; i < count; ++i)
    points.push_back((turn * axes.cwiseProduct(random.direction<3>()) * 0x1p30).array().round() * 0x1p-30);
  return points;
}

Nef hull(const std::vector<Vector3d>& points) {
  std::vector<Kernel::Point_3> converted;
  for (const Vector3d& p : points) converted.emplace_back(p.x(), p.y(), p.z());
  Polyhedron result;
  CGAL::convex_hull_3(converted.begin(), converted.end(), result);
  return Nef(result);
}

TEST(MinkowskiSum, HullOfSumsIsTheSumOfNefPolyhedra) {
  for (std::uint64_t index = 0; index < 3; ++index) {
    SCOPED_TRACE(index);
    SeededRandom random(420, 1, index);
    const std::vector<Vector3d> first = cloud(random, 12), second = cloud(random, 20);
    Nef nef_first = hull(first), nef_second = hull(second);
    const Nef sum = CGAL::minkowski_sum_3(nef_first, nef_second);
    std::vector<std::array<double, 3>> expected, found;
    for (auto v = sum.vertices_begin(); v != sum.vertices_end(); ++v) {
      const auto& p = v->point();
      expected.push_back({CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())});
    }
    for (const Vector3d& p : minkowski_sum_vertices(first, second)) found.push_back({p.x(), p.y(), p.z()});
    std::sort(expected.begin(), expected.end());
    std::sort(found.begin(), found.end());
    EXPECT_GT(found.size(), 40);
    EXPECT_EQ(found, expected);
  }
}

}  // namespace
}  // namespace vericone::verify::minkowski_nef_test
