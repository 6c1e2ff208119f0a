// SPDX-License-Identifier: BSD-3-Clause
//
// Cells of directions. `out`: every pair of parts has a plane that keeps it from the cell. `in`: one pair of
// convex parts meets in all directions of the cell, or of each of the parts into which it is cut.
//
// A frontier has, first, the length of that of the ellipsoid inside a delimited body, then that, then two
// indices a pair: of the agent's part, and of the obstacle's node.
#include <algorithm>

#include "answers/frontier.h"
#include "composite/delimited.h"
#include "composite/pieces.h"

namespace vericone {
using namespace assembly;

namespace composite {
namespace {

constexpr std::uint32_t kPackedLevels = 9;
constexpr std::size_t kMostKept = 256;  // pairs that a frontier holds before it is refined no further

std::uint32_t packed(const Cell& cell) {
  return cell.level << 27 | cell.at[0] << 18 | cell.at[1] << 9 | cell.at[2];
}
Cell unpacked(std::uint32_t index) {
  return {{index >> 18 & 511, index >> 9 & 511, index & 511}, index >> 27};
}

struct NodePair {
  std::uint32_t a, b;
};

/// The agent's part of that index.
Box part_box(const State& state, std::uint32_t a) {
  return state.agent ? state.agent->hierarchy().nodes()[a].box() : state.cells->box(unpacked(a));
}
bool part_is_last(const State& state, std::uint32_t a) {
  if (state.agent) return state.agent->hierarchy().nodes()[a].is_leaf();
  return unpacked(a).level >= std::min(kPackedLevels, state.cells->most_levels());
}
template <class Use>
void divide_part(const State& state, std::uint32_t a, Use&& use) {
  if (!state.agent) return state.cells->divide(unpacked(a), [&](const Cell& part) { use(packed(part)); });
  const Hierarchy::Node& node = state.agent->hierarchy().nodes()[a];
  use(node.first);
  use(node.first + 1);
}

/// Whether all pieces of two leaves are proved to be apart from the directions.
template <class Test>
bool pieces_apart(const State& state, const NodePair& pair, const Directions& directions, const Test& test) {
  const Hierarchy::Node& node = state.obstacle.hierarchy().nodes()[pair.b];
  const auto apart = [&](const Box& box, std::uint32_t slot, auto&& core_of) {
    const Box body = difference(box, piece_box(state.obstacle, slot));
    if (test.apart(body.low, body.high)) return true;
    const Core core = core_of(slot);
    return gap(core, directions, first_normal(core, directions)).answer == Gap::Answer::apart;
  };
  for (std::uint32_t slot = node.first; slot < node.first + node.count; ++slot) {
    if (!state.agent) {
      const Box box = part_box(state, pair.a);
      const Frame frame = state.frame(HullBody::box(box.low, box.high));
      if (!apart(box, slot, [&](std::uint32_t j) { return piece_core(frame, state.obstacle, j); }))
        return false;
      continue;
    }
    const Hierarchy::Node& own = state.agent->hierarchy().nodes()[pair.a];
    for (std::uint32_t i = own.first; i < own.first + own.count; ++i) {
      const PieceFrame piece(state, i);
      if (!apart(piece_box(*state.agent, i), slot, [&](std::uint32_t j) { return piece.core(j); }))
        return false;
    }
  }
  return true;
}

/// The pairs of parts that may meet in the cell, refined from those of its parent.
template <class Test>
std::vector<NodePair> refined(const State& state, std::vector<NodePair> pairs, const Directions& directions,
                              const Test& test) {
  const auto nodes = state.obstacle.hierarchy().nodes();
  const double sine = test.residual().sine;
  for (bool changed = true; changed;) {
    changed = false;
    std::vector<NodePair> next;
    for (const NodePair& pair : pairs) {
      const Box a = part_box(state, pair.a), b = nodes[pair.b].box(), both = difference(a, b);
      if (test.apart(both.low, both.high)) continue;
      const bool last_a = part_is_last(state, pair.a), last_b = nodes[pair.b].is_leaf();
      if (last_b && (last_a || !state.agent) && pieces_apart(state, pair, directions, test)) continue;
      const bool looks_small =
          both.half_widths().norm() < 0.5 * sine * (both.center() - state.zero.origin()).norm();
      if ((last_a && last_b) || looks_small) {
        next.push_back(pair);
        continue;
      }
      changed = true;
      if (last_b || (!last_a && size(a) > size(b))) {
        divide_part(state, pair.a, [&](std::uint32_t part) { next.push_back({part, pair.b}); });
      } else {
        next.push_back({pair.a, nodes[pair.b].first});
        next.push_back({pair.a, nodes[pair.b].first + 1});
      }
    }
    if (next.size() > kMostKept && next.size() > pairs.size()) break;
    pairs = std::move(next);
  }
  return pairs;
}

/// Whether one pair of convex parts, met by the ray in the middle, is met in the whole cell. `middle_met`:
/// whether any is met by that ray.
bool one_pair_meets(const State& state, const DirectionCell& cell, bool& middle_met) {
  const Eigen::Vector3d middle = cell[0] + cell[1] + cell[2];
  const Directions ray(state.zero, {middle});
  const Directions rays[3] = {{state.zero, {cell[0]}}, {state.zero, {cell[1]}}, {state.zero, {cell[2]}}};
  const Slabs slabs(state.zero, difference(state.agent_bounds(), state.obstacle.bounds()), middle);
  const auto enter = [&](const Box& box) { return slabs.enter(box.low.data(), box.high.data()); };
  if (state.cells) {
    const auto apart = [&](const Box& box) { return std::isinf(enter(box)); };
    middle_met = true;
    return CellSearch(state, ray, apart, 2000, &rays).run() == Certified::in;
  }
  bool found = false;
  int tries = 0;
  middle_met = false;
  for_each_pair(state, enter, [&](std::uint32_t i, std::uint32_t j) {
    const PieceFrame piece(state, i);
    const Core core = piece.core(j);
    if (gap(core, ray, first_normal(core, ray)).answer != Gap::Answer::met) return true;
    middle_met = true;
    found = meets_all(core, rays);
    return !found && ++tries < 4;
  });
  return found;
}

/// The same for the cell, or its quarters, and so on. Parts that share rounded corners leave no gap: what is
/// met is met by a margin of many roundings.
bool pairs_meet(const State& state, const DirectionCell& cell, int levels) {
  bool middle_met;
  if (one_pair_meets(state, cell, middle_met)) return true;
  if (!middle_met || levels == 0) return false;
  const Eigen::Vector3d a = 0.5 * (cell[1] + cell[2]), b = 0.5 * (cell[2] + cell[0]),
                        c = 0.5 * (cell[0] + cell[1]);
  return pairs_meet(state, {a, b, c}, levels - 1) && pairs_meet(state, {cell[0], c, b}, levels - 1) &&
         pairs_meet(state, {cell[1], a, c}, levels - 1) && pairs_meet(state, {cell[2], b, a}, levels - 1);
}

}  // namespace
}  // namespace composite

Frontier CompositePair::start() const {
  Frontier all;
  if (state_->within) all = state_->within->start();
  all.insert(all.begin(), static_cast<std::uint32_t>(all.size()));
  all.insert(all.end(), {0, 0});
  return all;
}

namespace composite {
namespace {

DirectionCell in_obstacle_frame(const State& state, const DirectionCell& cell) {
  return {state.to_obstacle(cell[0]), state.to_obstacle(cell[1]), state.to_obstacle(cell[2])};
}

/// Where the pairs of a frontier begin.
Frontier::const_iterator pairs_of(const Frontier& frontier) { return frontier.begin() + 1 + frontier[0]; }

void require_pairs(const State& state, const Frontier& parent) {
  require_frontier(!parent.empty() && parent[0] < parent.size() && (parent.size() - 1 - parent[0]) % 2 == 0,
                   parent);
  const std::size_t nodes = state.obstacle.hierarchy().nodes().size();
  const auto is_part = [&](std::uint32_t a) {
    return state.agent ? a < state.agent->hierarchy().nodes().size() : unpacked(a).level <= kPackedLevels;
  };
  for (auto i = pairs_of(parent); i != parent.end(); i += 2)
    require_frontier(is_part(i[0]) && i[1] < nodes, parent);
}

/// Whether no pair of the parent's may meet in the cell; otherwise `own` has those that may, and `inner`.
bool no_pair_is_left(const State& state, const Directions& directions, const Frontier& parent,
                     const Frontier& inner, Frontier& own) {
  std::vector<NodePair> pairs;
  for (auto i = pairs_of(parent); i != parent.end(); i += 2) pairs.push_back({i[0], i[1]});
  const BoxTest test(state.zero, directions, CircularResidual(directions));
  pairs = refined(state, std::move(pairs), directions, test);
  if (pairs.empty()) return true;
  own.assign(1, static_cast<std::uint32_t>(inner.size()));
  own.insert(own.end(), inner.begin(), inner.end());
  for (const NodePair& pair : pairs) own.insert(own.end(), {pair.a, pair.b});
  return false;
}

}  // namespace
}  // namespace composite

Certified CompositePair::classify(const DirectionCell& cell, const Frontier& parent, Frontier& own) const {
  using namespace composite;
  const composite::State& state = *state_;
  own = parent;
  if (!state.relation) return Certified::undecided;
  if (*state.relation != Relation::disjoint) return Certified::in;
  const DirectionCell turned = in_obstacle_frame(state, cell);
  const Directions directions(state.zero, {turned[0], turned[1], turned[2]});
  if (directions.spread_too_far()) return Certified::undecided;

  require_pairs(state, parent);
  const Frontier inner_parent(parent.begin() + 1, pairs_of(parent));
  Frontier inner;
  if (state.within && !inner_parent.empty()) {
    if (state.within->classify(turned, inner_parent, inner) == Certified::in) return Certified::in;
  }
  if (no_pair_is_left(state, directions, parent, inner, own)) return Certified::out;
  return pairs_meet(state, turned, state.cells ? 0 : 3) ? Certified::in : Certified::undecided;
}

bool CompositePair::misses(const DirectionCell& cell, const Frontier& parent, Frontier& own) const {
  using namespace composite;
  const composite::State& state = *state_;
  own = parent;
  if (state.relation != Relation::disjoint) return false;
  const DirectionCell turned = in_obstacle_frame(state, cell);
  const Directions directions(state.zero, {turned[0], turned[1], turned[2]});
  if (directions.spread_too_far()) return false;
  require_pairs(state, parent);
  return no_pair_is_left(state, directions, parent, Frontier(parent.begin() + 1, pairs_of(parent)), own);
}

}  // namespace vericone
