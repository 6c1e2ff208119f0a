// SPDX-License-Identifier: BSD-3-Clause
//
// Prints, in Markdown, what the front door costs: verdicts by Pair beside those of the families themselves,
// in one run; and sectors on planes.
//
// Usage: vericone_pair_ratios [ROUNDS [MAP.bt]]   (an octree map; boxes in rows without it)
#include <vericone/cones/pair.h>
#include <vericone/internal/cones/assembly/assembly_oracle.h>
#include <vericone/internal/cones/hulls/hull_oracle.h>
#include <vericone/testing/random_bodies.h>
#ifdef VERICONE_HAS_OCTOMAP
#include <vericone/octomap/read_octree.h>
#endif
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "items.h"

namespace {

using namespace vericone;
using namespace vericone::benchmarks;
using Eigen::Vector3d;

std::vector<Box> rows_of_boxes() {
  std::vector<Box> boxes;
  for (int i = 0; i < 40; ++i)
    for (int j = 0; j < 40; ++j)
      for (int k = 0; k < 3; ++k)
        if ((i / 4 + j / 4) % 2 == 0) {
          const Vector3d low(5 + 0.5 * i, 0.5 * j - 10, 0.5 * k);
          boxes.push_back({low, low + Vector3d::Constant(0.5)});
        }
  return boxes;
}

Assembly map_of(int argc, char** argv) {
#ifdef VERICONE_HAS_OCTOMAP
  if (argc > 2) {
    octomap::OctreeMeaning known;
    known.unknown_occupied = false;
    return Assembly::boxes(octomap::obstacle_boxes(octomap::read_octree(argv[2]), known));
  }
#else
  (void)argc, (void)argv;
#endif
  return Assembly::boxes(rows_of_boxes());
}

/// The family's own call and the pair's, by turns.
template <typename Family>
void row(const char* name, const std::vector<Family>& own, const std::vector<Pair>& pairs,
         const std::vector<Vector3d>& velocities, int rounds, int repeats) {
  const std::size_t count = own.size();
  const Vector3d still = Vector3d::Zero();
  std::vector<Item> items;
  items.push_back(item("own", velocities.size(), repeats,
                       [&](std::size_t i) { return own[i % count].verdict(velocities[i], still); }));
  items.push_back(item("pair", velocities.size(), repeats,
                       [&](std::size_t i) { return pairs[i % count].verdict(velocities[i], still); }));
  measure(items, rounds);
  const double of_family = median(items[0].times), of_pair = median(items[1].times);
  std::printf("| %s | %.1f ns | %.1f ns | %.3f |\n", name, of_family, of_pair, of_pair / of_family);
}

/// A body of that kind and a mesh 7 m from it.
Pair mesh_pair(testing::RandomBodies& random, BodyKind kind) {
  return {Placed(testing::any_body(random, kind)),
          Placed(testing::any_body(random, BodyKind::mesh), {{7, 1, 0}, Eigen::Matrix3d::Identity()})};
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::max(std::atoi(argv[1]), 1) : 21;
  testing::RandomBodies random(1);
  constexpr std::size_t kPairs =
      16;  // their numbers fit into the first cache: what is asked is the way there
  std::vector<ConeOracle> ellipsoids;
  std::vector<HullOracle> hulls;
  std::vector<Pair> of_ellipsoids, of_hulls;
  std::vector<Vector3d> velocities;
  for (std::size_t i = 0; i < kPairs; ++i) {
    const Ellipsoid a = random.ellipsoid({0, 0, 0}, 0.2, 2), b = random.ellipsoid({6, 1, 0}, 0.2, 2);
    ellipsoids.emplace_back(a, b);
    of_ellipsoids.emplace_back(Placed(a), Placed(b));
    const HullBody hull = testing::any_body(random, BodyKind::hull).hull()->translated({6, 1, 0});
    hulls.emplace_back(a, hull);
    of_hulls.emplace_back(Placed(a), Placed(hull));
  }
  for (std::size_t i = 0; i < 4096; ++i) velocities.push_back(Vector3d(6, 1, 0) + random.in_box(4));
  const Assembly map = map_of(argc, argv);
  const Vector3d middle = map.bounds().center();
  const Ellipsoid agent = Ellipsoid::from_axes(
      {map.bounds().low.x() - 3, middle.y(), map.bounds().high.z() + 2}, {0.4, 0.4, 0.2});
  const Pose still;
  std::vector<AssemblyOracle> octree;
  octree.emplace_back(agent, map, still);
  const std::vector<Pair> of_octree{Pair(Placed(agent), Placed(map))};
  std::vector<Vector3d> over;
  const Vector3d size = map.bounds().half_widths();
  for (std::size_t i = 0; i < 512; ++i)
    over.push_back(middle + size.cwiseProduct(random.in_box(1.2)) - agent.center());

  std::printf("| verdict of | the family's own call | Pair::verdict | ratio |\n| --- | --- | --- | --- |\n");
  row("two ellipsoids", ellipsoids, of_ellipsoids, velocities, rounds, 8);
  row("an ellipsoid and a hull of 6 to 12 points", hulls, of_hulls, velocities, rounds, 2);
  const std::string name = "an ellipsoid and a map of " + std::to_string(map.size()) + " boxes";
  row(name.c_str(), octree, of_octree, over, rounds, 2);

  const std::vector<Pair> meshes{mesh_pair(random, BodyKind::mesh)},
      dented{mesh_pair(random, BodyKind::combined)};
  std::vector<Item> sectors;
  const auto add = [&](const char* what, const std::vector<Pair>& pairs) {
    sectors.push_back(item(what, std::size_t{32}, 1, [&](std::size_t i) {
      return pairs[i % pairs.size()].sector(velocities[i].cross(Vector3d(6, 1, 0)));
    }));
  };
  add("two ellipsoids", of_ellipsoids);
  add("an ellipsoid and a hull of 6 to 12 points", of_hulls);
  add(name.c_str(), of_octree);
  add("two meshes of 7 triangles", meshes);
  add("a dented body and a mesh of 7 triangles", dented);
  measure(sectors, std::max(rounds / 4, 1));
  std::printf("\n| Pair::sector of | on one plane |\n| --- | --- |\n");
  for (const Item& it : sectors) std::printf("| %s | %.1f us |\n", it.name.c_str(), median(it.times) / 1000);
}
