// SPDX-License-Identifier: BSD-3-Clause
//
// Cells of directions: all in, all out, or to be divided.
#include <algorithm>

#include "answers/frontier.h"
#include "assembly/gap.h"
#include "assembly/state.h"

namespace vericone::assembly {

bool meets_all(const Core& core, const Directions (&rays)[3]) {
  for (const Directions& ray : rays) {
    const Eigen::Vector3d away = RayResidual{ray.ray[0]}(core.center());
    if (gap(core, ray, away.isZero(0) ? core.center() : away).answer != Gap::Answer::met) return false;
  }
  return true;
}

}  // namespace vericone::assembly

namespace vericone {
using namespace assembly;

namespace {

/// The piece that meets all of the cell is looked for where the middles of boxes come nearest to the middle
/// of the cell; only so far.
bool some_piece_meets_all(const Scene& scene, const DirectionCell& cell, const Directions& directions,
                          const Frontier& frontier) {
  constexpr int kMostNodes = 96, kMostPieces = 6;
  struct Item {
    std::uint32_t node;
    double distance;
  };
  const auto nodes = scene.nodes();
  const RayResidual residual{directions.middle};
  const auto nearness = [&](const Box& box) {
    const Eigen::Vector3d y = scene.frame().to_frame() * (box.center() - scene.frame().origin());
    return residual(y).norm();
  };
  const auto farther = [](const Item& a, const Item& b) { return a.distance > b.distance; };
  Item heap[2 * kMostNodes];
  int size = 0, visited = 0, pieces = 0;
  const auto nearer = [](const Item& a, const Item& b) { return a.distance < b.distance; };
  // The nearest of them.
  for (const std::uint32_t node : frontier) {
    const Item item{node, nearness(nodes[node].box())};
    if (size == kMostNodes) {
      if (!(item.distance < heap[0].distance)) continue;
      std::pop_heap(heap, heap + size--, nearer);
    }
    heap[size++] = item;
    std::push_heap(heap, heap + size, nearer);
  }
  std::make_heap(heap, heap + size, farther);
  Directions rays[3];
  while (size > 0 && visited < kMostNodes && pieces < kMostPieces) {
    std::pop_heap(heap, heap + size, farther);
    const Hierarchy::Node& node = nodes[heap[--size].node];
    ++visited;
    if (!node.is_leaf()) {
      for (std::uint32_t child = node.first; child < node.first + 2 && size < 2 * kMostNodes; ++child) {
        heap[size++] = {child, nearness(nodes[child].box())};
        std::push_heap(heap, heap + size, farther);
      }
      continue;
    }
    if (rays[0].count == 0)
      for (int i = 0; i < 3; ++i) rays[i] = Directions(scene.frame(), {cell[std::size_t(i)]});
    for (std::uint32_t slot = node.first; slot < node.first + node.count; ++slot) {
      ++pieces;
      if (meets_all(scene.core(slot), rays)) return true;
    }
  }
  return false;
}

}  // namespace

Frontier AssemblyOracle::start() const { return {0}; }

Certified AssemblyOracle::classify(const DirectionCell& cell, const Frontier& parent, Frontier& own) const {
  const Scene& scene = *state_;
  own.clear();
  if (state_->relation != Relation::disjoint) return Certified::in;
  const DirectionCell turned{scene.to_body(cell[0]), scene.to_body(cell[1]), scene.to_body(cell[2])};
  const Directions directions(scene.frame(), {turned[0], turned[1], turned[2]});
  if (directions.spread_too_far()) {
    own = parent;
    return Certified::undecided;
  }
  require_indices(parent, scene.nodes().size());
  // First: where one piece meets all, there are often thousands that meet some.
  if (some_piece_meets_all(scene, turned, directions, parent)) return Certified::in;
  const CircularResidual residual(directions);
  const BoxTest test(scene.frame(), directions, residual);
  const auto nodes = scene.nodes();
  const double small = 0.25 * residual.sine;  // boxes that look smaller than this are not divided
  std::vector<std::uint32_t> stack(parent.rbegin(), parent.rend());
  while (!stack.empty()) {
    const std::uint32_t index = stack.back();
    const Hierarchy::Node& node = nodes[index];
    stack.pop_back();
    if (test.apart(node)) continue;
    if (!node.is_leaf()) {
      const Box box = node.box();
      const Eigen::Vector3d c = box.center() - scene.frame().origin();
      if (scene.frame().norm() * box.half_widths().norm() < small * (scene.frame().to_frame() * c).norm()) {
        own.push_back(index);
      } else {
        stack.push_back(node.first + 1);
        stack.push_back(node.first);
      }
      continue;
    }
    bool apart = true;
    for (std::uint32_t slot = node.first; slot < node.first + node.count && apart; ++slot) {
      const Box box = scene.slot_box(slot);
      if (test.apart(box.low, box.high)) continue;
      const Core core = scene.core(slot);
      const Eigen::Vector3d away = residual(core.center());
      apart = gap(core, directions, away.isZero(0) ? core.center() : away).answer == Gap::Answer::apart;
    }
    if (!apart) own.push_back(index);
  }
  return own.empty() ? Certified::out : Certified::undecided;
}

}  // namespace vericone
