// SPDX-License-Identifier: BSD-3-Clause
#include "composite/pieces.h"

#include <bit>

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
    case PieceKind::convex:
      own_ = state.frame(storage.convexes[slot]);
      break;
  }
  frame_ = &*own_;
}

namespace {

exact::Rational dot(const exact::IntegerVector<3>& n, const Eigen::Vector3d& x) {
  exact::Rational sum = 0;
  for (int k = 0; k < 3; ++k) sum += exact::Rational(n[k]) * exact::Rational(x(k));
  return sum;
}

/// The least sign * n.x of the pieces' points, exactly; sought in doubles first, with n over its largest
/// entry in `near`.
exact::Rational least(const Assembly& body, const Eigen::Vector3d& near, const exact::IntegerVector<3>& n,
                      int sign) {
  const Assembly::Storage& storage = body.by_slot();
  const auto each = [&](auto&& call) {
    for (const auto& corners : storage.triangles)
      for (const Eigen::Vector3d& x : corners) call(x);
    for (const Eigen::Vector3d& x : storage.balls) call(x);
    for (const Box& box : storage.boxes) {
      Eigen::Vector3d x;  // its corner with the least
      for (int k = 0; k < 3; ++k) x(k) = sign * n[k].sign() < 0 ? box.high(k) : box.low(k);
      call(x);
    }
    for (const HullBody& hull : storage.hulls)
      for (const Eigen::Vector3d& x : hull.points()) call(x);
  };
  double low = std::numeric_limits<double>::infinity(), slack = 0;
  each([&](const Eigen::Vector3d& x) {
    low = std::min(low, sign * near.dot(x));
    slack = std::max(slack, kUlp * (16 * near.cwiseAbs().dot(x.cwiseAbs()) + x.cwiseAbs().sum()));
  });
  std::optional<exact::Rational> found;
  Eigen::Vector3d last = Eigen::Vector3d::Constant(NAN);
  each([&](const Eigen::Vector3d& x) {
    if (sign * near.dot(x) > low + 2 * slack || x == last) return;
    last = x;
    exact::Rational value = sign * dot(n, x);
    if (!found || value < *found) found = std::move(value);
  });
  return *found;
}

/// Whether a plane that two touching pieces have between them has the whole bodies on its sides: then nothing
/// is overlapped.
bool plane_between(const State& state, const exact::Generators& cone) {
  for (const exact::IntegerVector<3>& n : exact::sides(cone)) {
    Eigen::Vector3d near;
    exact::Integer largest = 1;
    for (const exact::Integer& e : n) largest = std::max(largest, exact::Integer(abs(e)));
    for (int k = 0; k < 3; ++k)
      near(k) = static_cast<double>(exact::Integer((abs(n[k]) << 60) / largest)) * (n[k].sign() * 0x1p-60);
    if (least(state.obstacle, near, n, 1) + dot(n, state.place.obstacle) + least(*state.agent, near, n, -1) -
            dot(n, state.place.agent) >=
        0)
      return true;
  }
  return false;
}

}  // namespace

std::optional<Relation> pieces_relation(const State& state) {
  const Directions apex{};
  Relation relation = Relation::disjoint;
  std::vector<exact::Touched<exact::Generators>> touched;
  std::size_t count = 0;
  bool apart = false, decided = true;
  const auto enter = [&](const Box& box) {
    return state.holds_apex(box) ? 0 : std::numeric_limits<double>::infinity();
  };
  for_each_pair(state, enter, [&](std::uint32_t i, std::uint32_t j) {
    const PieceFrame piece(state, i);
    const Core core = piece.core(j);
    const Gap found = gap(core, apex, first_normal(core, apex));
    if (found.answer == Gap::Answer::apart) return true;
    const auto ask = [&](const auto& oracle) {
      const std::optional<Relation> own = oracle.relation();
      if (!own || (*own == Relation::touching && may_join(state, oracle))) decided = false;
      if (own != Relation::touching) return own.value_or(Relation::touching);
      const HullScene* hulls = exact::two_hulls(oracle);
      if (hulls == nullptr) return Relation::touching;
      const exact::Generators cone = exact::generators(*hulls);
      // Bodies that rest on each other touch in thousands of pieces.
      if (std::has_single_bit(++count)) apart = plane_between(state, cone);
      if (!apart && exact::has_interior(cone)) touch(state, i, j, cone, touched);
      return Relation::touching;
    };
    const Relation exact =
        found.answer == Gap::Answer::met ? Relation::overlapping : with_exact_oracle(state, i, j, ask);
    if (exact != Relation::disjoint) relation = exact;
    return exact != Relation::overlapping && !apart;
  });
  if (apart) return relation;
  if (!decided && relation != Relation::overlapping) return std::nullopt;
  if (relation == Relation::touching && covered_together(std::move(touched), exact::cover_space))
    return Relation::overlapping;
  return relation;
}

std::optional<Membership> pieces_membership(const State& state, const Eigen::Vector3d& v_a,
                                            const Eigen::Vector3d& v_b, Effort& effort) {
  const Eigen::Vector3d w = relative_velocity(v_a, v_b);
  const Slabs slabs(state.zero, difference(state.agent_bounds(), state.obstacle.bounds()), w);
  const Directions ray(state.zero, {w});
  Membership answer = Membership::out;
  bool decided = true;
  std::vector<exact::Touched<exact::Sector>> touched;
  const auto enter = [&](const Box& box) { return slabs.enter(box.low.data(), box.high.data()); };
  for_each_pair(state, enter, [&](std::uint32_t i, std::uint32_t j) {
    const PieceFrame piece(state, i);
    const Core core = piece.core(j);
    ++effort.pieces;
    const Gap found = gap(core, ray, first_normal(core, ray));
    if (found.answer == Gap::Answer::apart) return true;
    if (found.answer == Gap::Answer::close) ++effort.exact;
    const Membership exact = found.answer == Gap::Answer::met
                                 ? Membership::in
                                 : with_exact_oracle(state, i, j, [&](const auto& oracle) {
                                     const auto known = known_membership(oracle, v_a, v_b);
                                     if (!known || (*known == Membership::on && may_join(state, oracle)))
                                       decided = false;
                                     const Membership own = known.value_or(Membership::on);
                                     if (const HullScene* hulls = exact::two_hulls(oracle);
                                         hulls != nullptr && own == Membership::on)
                                       if (const auto sector = exact::image(
                                               exact::generators(*hulls),
                                               exact::shadow_rows(exact::difference_on_grid<3>(v_a, v_b))))
                                         touch(state, i, j, *sector, touched);
                                     return own;
                                   });
    if (exact != Membership::out) answer = exact;
    return exact != Membership::in;
  });
  if (!decided && answer != Membership::in) return std::nullopt;
  if (answer == Membership::on && covered_together(std::move(touched), exact::cover_plane))
    return Membership::in;
  return answer;
}

std::optional<Membership> pieces_within(const State& state, const Stretch& stretch) {
  const Slabs slabs(state.zero, difference(state.agent_bounds(), state.obstacle.bounds()),
                    stretch.v_a - stretch.v_b, stretch.from, stretch.until);
  Membership answer = Membership::out;
  bool decided = true;
  std::vector<exact::Touched<exact::Generators>> touched;
  const auto enter = [&](const Box& box) { return slabs.enter(box.low.data(), box.high.data()); };
  for_each_pair(state, enter, [&](std::uint32_t i, std::uint32_t j) {
    const PieceFrame piece(state, i);
    const Box box = difference(piece_box(*state.agent, i), piece_box(state.obstacle, j));
    const std::optional<Membership> one = met_within(piece.core(j), slabs.clipped(stretch, box), [&] {
      exact::Generators cone;
      const auto exact = with_exact_oracle(state, i, j, [&](const auto& oracle) -> std::optional<Membership> {
        const std::optional<Membership> own = exact::within(oracle, stretch, &cone);
        if (own == Membership::on && may_join(state, oracle)) return std::nullopt;
        return own;
      });
      if (exact::has_interior(cone)) touch(state, i, j, std::move(cone), touched);
      return exact;
    });
    if (!one) decided = false;
    if (one != Membership::out) answer = one.value_or(Membership::on);
    return one != Membership::in;
  });
  if (!decided && answer != Membership::in) return std::nullopt;
  if (answer == Membership::on && covered_together(std::move(touched), exact::cover_space))
    return Membership::in;
  return answer;
}

}  // namespace vericone::composite
