// SPDX-License-Identifier: BSD-3-Clause
#include "composite/delimited.h"

namespace vericone::composite {
using namespace assembly;

std::optional<Relation> delimited_relation(const State& state) {
  if (state.around->relation() == Relation::disjoint) return Relation::disjoint;
  if (state.within && state.within->relation() == Relation::overlapping) return Relation::overlapping;
  if (!state.within_range()) return std::nullopt;
  const Directions apex{};
  const auto apart = [&](const Box& box) { return !state.holds_apex(box); };
  switch (CellSearch(state, apex, apart).run()) {
    case Certified::in:
      return Relation::overlapping;
    case Certified::out:
      return Relation::disjoint;
    case Certified::undecided:
      break;
  }
  return std::nullopt;
}

namespace {

std::optional<Membership> decided(Certified answer) {
  if (answer == Certified::undecided) return std::nullopt;
  return answer == Certified::in ? Membership::in : Membership::out;
}

}  // namespace

std::optional<Membership> delimited_membership(const State& state, const Eigen::Vector3d& v_a,
                                               const Eigen::Vector3d& v_b) {
  if (state.around->relation() == Relation::disjoint && state.around->membership(v_a, v_b) == Membership::out)
    return Membership::out;
  if (state.within && state.within->membership(v_a, v_b) == Membership::in) return Membership::in;
  if (!state.within_range()) return std::nullopt;
  const Eigen::Vector3d w = relative_velocity(v_a, v_b);
  const Slabs slabs(state.zero, difference(state.agent_bounds(), state.obstacle.bounds()), w);
  const Directions ray(state.zero, {w});
  const auto apart = [&](const Box& box) { return std::isinf(slabs.enter(box.low.data(), box.high.data())); };
  return decided(CellSearch(state, ray, apart).run());
}

std::optional<Membership> delimited_within(const State& state, const Stretch& stretch) {
  const Horizon horizon{stretch.from, stretch.until};
  const auto is = [&](const AssemblyOracle& oracle, Verdict verdict) {
    return oracle.verdict(stretch.v_a, stretch.v_b, horizon) == verdict;
  };
  if (is(*state.around, Verdict::out)) return Membership::out;
  if (state.within && is(*state.within, Verdict::in)) return Membership::in;
  if (!state.within_range()) return std::nullopt;
  const Slabs slabs(state.zero, difference(state.agent_bounds(), state.obstacle.bounds()),
                    stretch.v_a - stretch.v_b, stretch.from, stretch.until);
  const auto apart = [&](const Box& box) { return std::isinf(slabs.enter(box.low.data(), box.high.data())); };
  return decided(CellSearch(state, apart, stretch, slabs).run());
}

}  // namespace vericone::composite
