// SPDX-License-Identifier: GPL-3.0-or-later
//
// Balls and real meshes against CGAL's AABB trees: distances now and in passing, and ray casting.
#include <CGAL/AABB_tree.h>
#include <CGAL/version.h>
#if CGAL_VERSION_MAJOR >= 6
#include <CGAL/AABB_traits_3.h>
#include <CGAL/AABB_triangle_primitive_3.h>
#else
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_triangle_primitive.h>
#endif
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <gtest/gtest.h>
#include <vericone/internal/cones/assembly/assembly_oracle.h>
#include <vericone/internal/verify/seeded_random.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <variant>

#include "verify/campaigns/real_data.h"

namespace vericone::verify::assembly_aabb_test {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangles = std::vector<Kernel::Triangle_3>;
using Eigen::Vector3d;

// CGAL 6 has names of its own for 3D, and variants of std in place of Boost's.
#if CGAL_VERSION_MAJOR >= 6
using Primitive = CGAL::AABB_triangle_primitive_3<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits_3<Kernel, Primitive>>;
using std::get_if;
#else
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;
template <typename Value, typename Variant>
const Value* get_if(const Variant* variant) {
  return boost::get<Value>(variant);
}
#endif

Kernel::Point_3 point(const Vector3d& x) { return {x.x(), x.y(), x.z()}; }

class AabbTrees : public ::testing::TestWithParam<std::string> {};

TEST_P(AabbTrees, DistancesAndFirstHits) {
  const auto mesh = real_mesh(GetParam());
  if (!mesh) GTEST_SKIP() << not_here(GetParam());
  Triangles triangles;
  std::vector<Kernel::Segment_3> edges;
  std::set<std::pair<std::uint32_t, std::uint32_t>> seen;
  for (const auto& t : mesh->triangles) {
    triangles.emplace_back(point(mesh->points[t[0]]), point(mesh->points[t[1]]), point(mesh->points[t[2]]));
    for (int i = 0; i < 3; ++i)
      if (seen.insert(std::minmax(t[i], t[(i + 1) % 3])).second)
        edges.emplace_back(point(mesh->points[t[i]]), point(mesh->points[t[(i + 1) % 3]]));
  }
  std::erase_if(triangles, [](const auto& t) { return t.is_degenerate(); });
  std::erase_if(edges, [](const auto& e) { return e.is_degenerate(); });
  Tree tree(triangles.begin(), triangles.end());
  tree.accelerate_distance_queries();
  const Assembly assembly = Assembly::mesh(mesh->points, mesh->triangles);
  const Box bounds = assembly.bounds();
  const double size = bounds.half_widths().maxCoeff();

  constexpr std::uint64_t kSeed = 1;
  int apart = 0, hits = 0, passes = 0;
  double worst = 0;
  for (std::uint64_t index = 0; index < 1000; ++index) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", case " + std::to_string(index));
    SeededRandom random(960, kSeed, index);
    const Vector3d at = bounds.center() + random.uniform(0, 2) * size * random.direction<3>();
    const double distance = std::sqrt(tree.squared_distance(point(at)));
    // A ball of a fifth of the distance, or one that is a little too large.
    const double radius = index % 10 ? 0.2 * distance : 1.0001 * distance;
    const AssemblyOracle oracle(Ellipsoid::from_axes(at, Vector3d::Constant(radius)), assembly);
    ASSERT_EQ(oracle.relation(), index % 10 ? Relation::disjoint : Relation::overlapping);
    const AssemblyMiss now = oracle.miss_distance(Vector3d::Zero());
    EXPECT_LE(now.least, std::max(0.0, distance - radius) * (1 + 1e-9) + 1e-12 * size);
    EXPECT_GE(now.most, std::max(0.0, distance - radius) * (1 - 1e-9) - 1e-12 * size);
    if (index % 10 == 0) continue;
    ++apart;
    worst = std::max(worst, (now.most - now.least) / size);

    // A ball so small that it meets what a ray meets.
    const double tiny = std::min(1e-9 * size, 0.1 * distance);
    const AssemblyOracle probe(Ellipsoid::from_axes(at, Vector3d::Constant(tiny)), assembly);
    const Vector3d target =
        mesh->points[static_cast<std::size_t>(random.integer(0, static_cast<int>(mesh->points.size()) - 1))];
    const Vector3d w = (target + 0.5 * size * random.direction<3>() - at).normalized();
    const Kernel::Ray_3 ray(point(at), Kernel::Vector_3(w.x(), w.y(), w.z()));
    const auto all = [&] {
      std::vector<Tree::Intersection_and_primitive_id<Kernel::Ray_3>::Type> found;
      tree.all_intersections(ray, std::back_inserter(found));
      return found;
    };
    const auto first = tree.first_intersected_primitive(ray);
    ASSERT_EQ(probe.membership(w) != Membership::out, first.has_value());
    if (first) {
      ++hits;
      double nearest = INFINITY;
      for (const auto& hit : all())
        if (const auto* p = get_if<Kernel::Point_3>(&hit.first))
          nearest = std::min(nearest, std::sqrt(CGAL::squared_distance(*p, point(at))));
      const auto contact = probe.first_contact(w);
      ASSERT_TRUE(contact);
      // Before the ray does, by the radius over the sine of the angle.
      EXPECT_LE(contact->time, nearest * (1 + 1e-12) + 1e-12 * size);
      const double slope = std::max(1e-3, std::abs(contact->normal.dot(w)));
      EXPECT_GE(contact->time, nearest - 2 * tiny / slope - 1e-9 * size);
    } else if (index % 2) {
      // In passing: an edge is nearest, or a place of the start.
      ++passes;
      double squared = distance * distance;
      for (const auto& e : edges) squared = std::min(squared, CGAL::squared_distance(e, ray));
      const double miss = std::max(0.0, std::sqrt(squared) - radius);
      const AssemblyMiss passing = oracle.miss_distance(w);
      EXPECT_LE(passing.least, miss * (1 + 1e-9) + 1e-9 * size);
      EXPECT_GE(passing.most, miss * (1 - 1e-9) - 1e-9 * size);
    }
  }
  std::printf(
      "%s: %zu triangles, %d balls apart, widest distance %.2g of the size, %d hits, %d misses measured\n",
      GetParam().c_str(), triangles.size(), apart, worst, hits, passes);
  EXPECT_GT(hits, 300);
  EXPECT_GT(passes, 20);
}

INSTANTIATE_TEST_SUITE_P(Real, AabbTrees,
                         ::testing::Values("ycb_006_mustard_bottle.obj", "stanford-bunny.obj",
                                           "data/meshes/refined_elephant.off"),
                         [](const auto& mesh) {
                           std::string name;
                           for (char c : std::filesystem::path(mesh.param).stem().string())
                             name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
                           return name;
                         });

}  // namespace
}  // namespace vericone::verify::assembly_aabb_test
