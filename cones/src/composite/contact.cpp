// SPDX-License-Identifier: BSD-3-Clause
//
// When, where and how near.
#include <vericone/geometry/error.h>

#include "answers/velocity_ladder.h"
#include "composite/measure.h"

namespace vericone::composite {
using namespace assembly;

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// The least over all pairs of pieces, of piece(frame, core, agent slot, slot, limit).
template <class Measure, class Piece>
Found least_of_pieces(const State& state, const Measure& measure, Piece&& piece_found) {
  Found best;
  double least = kNever;
  const auto enter = [&](const Box& box) {
    const double at = measure.of_box(box);
    return at < best.most ? at : kNever;
  };
  for_each_pair(state, enter, [&](std::uint32_t i, std::uint32_t j) {
    const PieceFrame piece(state, i);
    const Core core = piece.core(j);
    const Found found = piece_found(piece.frame(), core, i, j, best.most);
    least = std::min(least, found.least);
    if (found.most < best.most || (std::isinf(best.most) && found.least < best.least)) {
      best = found;
      best.agent_slot = i;
      best.slot = j;
    }
    return true;
  });
  best.least = std::min(least, best.most);
  return best;
}

Found contact_of_pieces(const State& state, const ContactMeasure& measure, const Eigen::Vector3d& w) {
  const Directions ray(state.zero, {w});
  const auto meets = [&](const Core& core, std::uint32_t i, std::uint32_t j) {
    const Gap found = gap(core, ray, first_normal(core, ray));
    if (found.answer != Gap::Answer::close) return found.answer == Gap::Answer::met;
    return with_exact_oracle(state, i, j, [&](const auto& oracle) {
      return oracle.relation() != Relation::disjoint ||
             known_membership(oracle, w, Eigen::Vector3d::Zero()) != Membership::out;
    });
  };
  return least_of_pieces(
      state, measure,
      [&](const Frame& frame, const Core& core, std::uint32_t i, std::uint32_t j, double limit) {
        if (!meets(core, i, j)) return Found{};
        return measure.of_piece(frame, core, limit, [&] {
          return with_exact_oracle(state, i, j, [&](const auto& oracle) {
            const HullScene* hulls = exact::two_hulls(oracle);
            return hulls != nullptr ? exact::first_time(*hulls, w) : std::nullopt;
          });
        });
      });
}

Found miss_of_pieces(const State& state, const MissMeasure& measure) {
  return least_of_pieces(
      state, measure, [&](const Frame& frame, const Core& core, std::uint32_t, std::uint32_t, double limit) {
        return measure.of_piece(frame, core, limit);
      });
}

/// What the body inside says, in the obstacle's frame and the units of the search.
Found known_contact(const State& state, const Eigen::Vector3d& w, double scale) {
  Found known;
  if (!state.within || state.within->relation() != Relation::disjoint) return known;
  if (const auto contact = state.within->first_contact(w); contact && std::isfinite(contact->latest)) {
    known.most = contact->latest * scale;
    known.best = contact->time * scale;
    known.point = contact->point - state.place.obstacle;
    known.other = contact->normal;
    const auto order = state.obstacle.hierarchy().order();
    known.slot =
        static_cast<std::uint32_t>(std::find(order.begin(), order.end(), contact->piece) - order.begin());
  }
  return known;
}

Found contact_of_cells(const State& state, const ContactMeasure& measure, const Eigen::Vector3d& w) {
  if (state.around->relation() == Relation::disjoint && state.around->membership(w) == Membership::out)
    return {};
  const double width = std::ldexp(state.cells->extent(), 1 - static_cast<int>(state.cells->most_levels())) *
                       measure.scale() / w.norm();
  return CellDescent(state, measure, width, known_contact(state, w, measure.scale())).run();
}

}  // namespace

Found ContactMeasure::of_piece(const Frame& frame, const Core& core, double limit,
                               const std::function<Seconds()>& exact_time) const {
  Found found;
  const double radius = core.own_radius() - (state_.agent ? state_.agent->radius() : 0);
  auto contact = piece_contact(frame, core, radius, d_, limit);
  if (!contact) return found;
  if (exact_time && contact->is_wide()) contact->refine(exact_time(), slabs_.scale());
  found.least = contact->earliest;
  found.most = contact->latest;
  found.best = contact->time;
  found.point = contact->point;
  found.other = found.normal = contact->normal;
  return found;
}

MissMeasure::MissMeasure(const State& state, const Eigen::Vector3d& w, double tolerance)
    : state_(state),
      speed_(w.norm()),
      tolerance_(tolerance),
      directions_(w.isZero(0) ? Directions() : Directions(state.zero, {w})),
      test_(state.zero, directions_,
            RayResidual{w.isZero(0) ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : directions_.ray[0]}) {}

Found MissMeasure::of_piece(const Frame& frame, const Core& core, double limit) const {
  Found found;
  const double radius = core.outer_rounding();
  const Gap near =
      gap(core, directions_, first_normal(core, directions_), GapGoal::measure, tolerance_, limit + radius);
  const double far = near.v.norm() + core.error() + 64 * kUlp * (core.reach() + near.along[0]);
  found.most = found.best = std::max(0.0, far - core.inner_rounding());
  found.least = std::max(0.0, near.least - radius);
  const Eigen::Vector3d n = near.v.isZero(0) ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : near.v.normalized();
  if (!n.isZero(0)) found.normal = n;
  // What rounds the agent's balls is part of the core's radius, what rounds its other pieces of the frame.
  const double ball = state_.agent ? state_.agent->radius() : 0;
  found.point = frame.to_space(near.on_piece) - (core.own_radius() - ball) * n;
  found.other = frame.to_space(near.on_piece - near.k) + (ball + frame.outer()) * n;
  if (speed_ > 0) found.time = near.along[0] / speed_;
  return found;
}

}  // namespace vericone::composite

namespace vericone {
using namespace composite;

namespace {

/// Indices in the order in which the pieces were given.
template <class Answer>
void name_pieces(const composite::State& state, const Found& found, Answer& answer) {
  answer.piece = state.obstacle.hierarchy().order()[found.slot];
  if (state.agent) answer.agent_piece = state.agent->hierarchy().order()[found.agent_slot];
}

Found find_miss(const composite::State& state, const Eigen::Vector3d& w, double tolerance) {
  const MissMeasure measure(state, w, tolerance);
  if (state.agent) return miss_of_pieces(state, measure);
  const double width = std::max(tolerance, std::ldexp(1.0, -static_cast<int>(state.cells->most_levels()))) *
                       2 * state.cells->extent();
  return CellDescent(state, measure, width, Found{}).run();
}

}  // namespace

std::optional<CompositeContact> CompositePair::first_contact(const Eigen::Vector3d& w) const {
  require_finite_velocity(w, "agent_velocity");
  const composite::State& state = *state_;
  CompositeContact answer;
  if (state.relation && *state.relation != Relation::disjoint) {
    const Found now = find_miss(state, Eigen::Vector3d::Zero(), 1e-3);
    answer.point = state.point_to_world(now.point);
    name_pieces(state, now, answer);
    return answer;
  }
  if (w.isZero(0)) return std::nullopt;
  const Eigen::Vector3d along = state.to_obstacle(w);
  const ContactMeasure measure(state, along);
  const Found found =
      state.agent ? contact_of_pieces(state, measure, along) : contact_of_cells(state, measure, along);
  if (std::isinf(found.least)) return std::nullopt;
  // What the search for the time leaves open, that for the answer alone may decide.
  if (std::isinf(found.most) && membership(w, Eigen::Vector3d::Zero()) == Membership::out)
    return std::nullopt;
  answer.earliest = found.least / measure.scale() * (1 - 2 * assembly::kUlp);
  answer.latest = found.most / measure.scale() * (1 + 2 * assembly::kUlp);
  answer.time = std::clamp(found.best / measure.scale(), answer.earliest, answer.latest);
  answer.point = state.point_to_world(found.point);
  answer.normal = state.to_world(found.other);
  name_pieces(state, found, answer);
  return answer;
}

CompositeMiss CompositePair::miss_distance(const Eigen::Vector3d& w, double tolerance) const {
  require_finite_velocity(w, "agent_velocity");
  if (!(tolerance >= 1e-9 && tolerance <= 1))
    throw InputError("tolerance", to_text(tolerance), "a number between 1e-9 and 1");
  const composite::State& state = *state_;
  CompositeMiss answer;
  if (state.relation == Relation::disjoint &&
      membership(w, Eigen::Vector3d::Zero()).value_or(Membership::out) != Membership::out)
    if (const std::optional<CompositeContact> contact = first_contact(w)) {
      answer.point = contact->point;
      answer.time = contact->time;
      answer.agent_point = contact->point - contact->time * w;
      answer.piece = contact->piece;
      answer.agent_piece = contact->agent_piece;
      return answer;
    }
  const Found found = find_miss(state, state.to_obstacle(w), tolerance);
  answer.least = found.least;
  answer.most = found.most;
  if (state.relation && *state.relation != Relation::disjoint) answer.least = answer.most = 0;
  answer.point = state.point_to_world(found.point);
  answer.agent_point = state.point_to_world(found.other);
  answer.time = found.time;
  name_pieces(state, found, answer);
  return answer;
}

}  // namespace vericone
