// SPDX-License-Identifier: BSD-3-Clause
//
// Pieces of an agent against pieces of an obstacle.
#pragma once

#include <vericone/internal/cones/hulls/hull_oracle.h>
#include <vericone/internal/cones/round/round_oracle.h>
#include <optional>
#include <vector>

#include "composite/state.h"
#include "ellipsoids/apart.h"
#include "round/seam.h"

namespace vericone::composite {

/// A piece of the agent as a frame: the points that it is the hull of. A ball is its centre, and the pieces
/// it is compared with are rounded by its radius.
class PieceFrame {
 public:
  PieceFrame(const State& state, std::uint32_t slot);

  const assembly::Frame& frame() const { return *frame_; }
  assembly::Core core(std::uint32_t obstacle_slot) const {
    return assembly::piece_core(*frame_, state_->obstacle, obstacle_slot, state_->agent->radius());
  }

 private:
  const State* state_;
  std::optional<assembly::Frame> own_;
  const assembly::Frame* frame_;
};

/// Calls ask() with the exact oracle of two pieces.
template <class Ask>
auto with_exact_oracle(const State& state, std::uint32_t agent_slot, std::uint32_t obstacle_slot, Ask&& ask) {
  const auto points = [](const Assembly& body, std::uint32_t slot) {
    return body.piece(body.hierarchy().order()[slot]);
  };
  const auto ball = [&](const Assembly& body, std::uint32_t slot) {
    return Ellipsoid::from_axes(body.by_slot().balls[slot], Eigen::Vector3d::Constant(body.radius()));
  };
  const Assembly &a = *state.agent, &b = state.obstacle;
  const Eigen::Vector3d &a_at = state.place.agent, &b_at = state.place.obstacle;
  if (a.kind() == PieceKind::convex || b.kind() == PieceKind::convex)
    return ask(RoundOracle(a.convex_piece(a.hierarchy().order()[agent_slot]),
                           b.convex_piece(b.hierarchy().order()[obstacle_slot]), a_at, b_at));
  if (a.radius() > 0 && b.radius() > 0) {
    const auto pair = apart(ball(a, agent_slot), a_at, ball(b, obstacle_slot), b_at);
    return ask(ConeOracle(pair.a, pair.b));
  }
  if (a.radius() > 0) return ask(HullOracle(ball(a, agent_slot), points(b, obstacle_slot), a_at, b_at));
  if (b.radius() > 0) return ask(HullOracle(points(a, agent_slot), ball(b, obstacle_slot), a_at, b_at));
  return ask(HullOracle(points(a, agent_slot), points(b, obstacle_slot), a_at, b_at));
}

/// Whether other pieces may make an overlap of a touch, and it is not known whether they do.
template <class Oracle>
bool may_join(const State& state, const Oracle& oracle) {
  return (state.agent->size() > 1 || state.obstacle.size() > 1) && vericone::may_join(oracle);
}

/// Adds what two pieces that touch cover, see covered_together(); unless both are solid.
template <class Part>
void touch(const State& state, std::uint32_t agent_slot, std::uint32_t obstacle_slot, Part part,
           std::vector<exact::Touched<Part>>& touched) {
  const auto flat = [](const Assembly& body, std::uint32_t slot) {
    return body.kind() == PieceKind::triangle ||
           exact::is_flat(body.piece(body.hierarchy().order()[slot]).points());
  };
  const bool agent = flat(*state.agent, agent_slot), obstacle = flat(state.obstacle, obstacle_slot);
  if (agent || obstacle) touched.push_back({agent_slot, obstacle_slot, agent, obstacle, std::move(part)});
}

/// Calls leaf(agent slot, obstacle slot) for the pairs of pieces whose difference of boxes `enter` does not
/// rule out (infinity), pairs of nodes that are entered earlier first. leaf returns false to stop.
template <class Enter, class Leaf>
void for_each_pair(const State& state, Enter&& enter, Leaf&& leaf) {
  struct Item {
    std::uint32_t a, b;
  };
  const auto a_nodes = state.agent->hierarchy().nodes(), b_nodes = state.obstacle.hierarchy().nodes();
  const auto at = [&](const Item& item) {
    return enter(difference(a_nodes[item.a].box(), b_nodes[item.b].box()));
  };
  std::vector<Item> stack;
  stack.reserve(128);
  if (std::isfinite(at({0, 0}))) stack.push_back({0, 0});
  std::vector<Box> boxes;
  while (!stack.empty()) {
    const Item item = stack.back();
    stack.pop_back();
    const Hierarchy::Node &a = a_nodes[item.a], &b = b_nodes[item.b];
    if (a.is_leaf() && b.is_leaf()) {
      boxes.clear();
      for (std::uint32_t j = 0; j < b.count; ++j)
        boxes.push_back(assembly::piece_box(state.obstacle, b.first + j));
      for (std::uint32_t i = a.first; i < a.first + a.count; ++i) {
        const Box own = assembly::piece_box(*state.agent, i);
        for (std::uint32_t j = 0; j < b.count; ++j)
          if (std::isfinite(enter(difference(own, boxes[j]))) && !leaf(i, b.first + j)) return;
      }
      continue;
    }
    const bool divide_a = b.is_leaf() || (!a.is_leaf() && size(a.box()) > size(b.box()));
    const Item one = divide_a ? Item{a.first, item.b} : Item{item.a, b.first};
    const Item two = divide_a ? Item{a.first + 1, item.b} : Item{item.a, b.first + 1};
    const double first = at(one), second = at(two);
    const bool one_last = first < second;
    if (!one_last && std::isfinite(first)) stack.push_back(one);
    if (std::isfinite(second)) stack.push_back(two);
    if (one_last && std::isfinite(first)) stack.push_back(one);
  }
}

}  // namespace vericone::composite
