// SPDX-License-Identifier: BSD-3-Clause
#include "composite/pieces.h"

namespace vericone::composite {
using namespace assembly;

PieceFrame::PieceFrame(const State& state, std::uint32_t slot) : state_(&state) {
  if (!state.frames.empty()) {
    frame_ = &state.frames[slot];
    return;
  }
  const Assembly& body = *state.agent;
  const Assembly::Storage& storage = body.by_slot();
  switch (body.kind()) {
    case PieceKind::triangle:
      own_ = state.frame(HullBody({storage.triangles[slot].begin(), storage.triangles[slot].end()}));
      break;
    case PieceKind::ball:
      own_ = state.frame(HullBody({storage.balls[slot]}));
      break;
    case PieceKind::box:
      own_ = state.frame(HullBody::box(storage.boxes[slot].low, storage.boxes[slot].high));
      break;
    case PieceKind::hull:
      own_ = state.frame(storage.hulls[slot]);
      break;
  }
  frame_ = &*own_;
}

Relation pieces_relation(const State& state) {
  const Directions apex{};
  Relation relation = Relation::disjoint;
  const auto enter = [&](const Box& box) {
    return state.holds_apex(box) ? 0 : std::numeric_limits<double>::infinity();
  };
  for_each_pair(state, enter, [&](std::uint32_t i, std::uint32_t j) {
    const PieceFrame piece(state, i);
    const Core core = piece.core(j);
    const Gap found = gap(core, apex, first_normal(core, apex));
    if (found.answer == Gap::Answer::apart) return true;
    const Relation exact =
        found.answer == Gap::Answer::met
            ? Relation::overlapping
            : with_exact_oracle(state, i, j, [](const auto& oracle) { return oracle.relation(); });
    if (exact != Relation::disjoint) relation = exact;
    return exact != Relation::overlapping;
  });
  return relation;
}

Membership pieces_membership(const State& state, const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b) {
  const Eigen::Vector3d w = relative_velocity(v_a, v_b);
  const Slabs slabs(state.zero, difference(state.agent_bounds(), state.obstacle.bounds()), w);
  const Directions ray(state.zero, {w});
  Membership answer = Membership::out;
  const auto enter = [&](const Box& box) { return slabs.enter(box.low.data(), box.high.data()); };
  for_each_pair(state, enter, [&](std::uint32_t i, std::uint32_t j) {
    const PieceFrame piece(state, i);
    const Core core = piece.core(j);
    const Gap found = gap(core, ray, first_normal(core, ray));
    if (found.answer == Gap::Answer::apart) return true;
    const Membership exact =
        found.answer == Gap::Answer::met
            ? Membership::in
            : with_exact_oracle(state, i, j, [&](const auto& oracle) { return oracle.membership(v_a, v_b); });
    if (exact != Membership::out) answer = exact;
    return exact != Membership::in;
  });
  return answer;
}

}  // namespace vericone::composite
