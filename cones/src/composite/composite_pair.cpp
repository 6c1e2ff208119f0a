// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/internal/cones/composite/composite_pair.h>
#include <vericone/internal/geometry/rotation.h>

#include <vericone/geometry/error.h>
#include <string>

#include "answers/velocity_ladder.h"
#include "combined/frame.h"
#include "composite/state.h"

namespace vericone {
using composite::CellTree;

namespace {

CombinedEllipsoid in_obstacle_frame(const CombinedEllipsoid& body, const Eigen::Vector3d& at,
                                    const Pose& pose) {
  std::vector<Delimiter<3>> delimiters = body.delimiters();
  if (!is_upright(pose))
    for (Delimiter<3>& d : delimiters) {
      const Eigen::Matrix3d turned = pose.rotation.transpose() * d.matrix * pose.rotation;
      d.matrix = 0.5 * (turned + turned.transpose());
    }
  return CombinedEllipsoid::trusted(assembly::in_obstacle_frame(body.ellipsoid(), at, pose), delimiters);
}

/// The assembly with every point taken from one frame to another.
Assembly moved(const Assembly& body, const Pose& from, const Pose& to) {
  if (from.position == to.position && from.rotation == to.rotation) return body;
  std::vector<Eigen::Vector3d> points;
  std::vector<Assembly::Triangle> triangles;
  std::vector<HullBody> hulls;
  if (body.kind() == PieceKind::convex) {
    std::vector<Convex> convexes;
    const Pose across = composed(inverse(to), from);
    for (std::size_t i = 0; i < body.size(); ++i) convexes.push_back(in_world(body.convex_piece(i), across));
    return Assembly::convexes(std::move(convexes));
  }
  for (std::size_t i = 0; i < body.size(); ++i) {
    std::vector<Eigen::Vector3d> piece = body.piece(i).points();
    for (Eigen::Vector3d& x : piece) x = to.to_body(from.to_world(x));
    if (body.kind() == PieceKind::triangle) {
      const auto first = static_cast<std::uint32_t>(points.size());
      triangles.push_back({first, first + 1, first + 2});
    }
    if (body.kind() == PieceKind::triangle || body.kind() == PieceKind::ball) {
      points.insert(points.end(), piece.begin(), piece.end());
    } else {
      hulls.emplace_back(std::move(piece));
    }
  }
  if (body.kind() == PieceKind::triangle) return Assembly::mesh(std::move(points), std::move(triangles));
  if (body.kind() == PieceKind::ball) return Assembly::cloud(std::move(points), body.radius());
  return Assembly::polyhedra(std::move(hulls));
}

double largest_coordinate(const Box& box) { return box.low.cwiseAbs().sum() + box.high.cwiseAbs().sum(); }

}  // namespace

CompositePair::State::State(const Assembly& body, const Pose& at)
    : obstacle(body), pose(at), upright(is_upright(at)), zero(HullBody()) {}

void CompositePair::State::check_range() {
  const double own = largest_coordinate(obstacle.bounds()) + largest_coordinate(agent_bounds());
  largest = own + (place.obstacle - place.agent).cwiseAbs().sum();
  zero = assembly::Frame(HullBody(), place);
  zero.check_range(largest);
  if (place.agent.isZero(0) && place.obstacle.isZero(0)) return;
  // Differences of boxes are rounded before the place is added.
  zero.widen(4 * assembly::kUlp * own);
  apex_slack_ = 8 * assembly::kUlp * largest;
}

CompositePair::CompositePair(const CombinedEllipsoid& agent, const Assembly& obstacle, const Pose& pose,
                             double tolerance, const Eigen::Vector3d& agent_at) {
  if (!(tolerance >= 1e-6 && tolerance <= 0.5))
    throw InputError("tolerance", to_text(tolerance), "a number between 1e-6 and 0.5");
  auto state = std::make_unique<State>(obstacle, pose);
  const CombinedEllipsoid body = in_obstacle_frame(agent, agent_at, pose);
  state->place = assembly::place_of(agent_at, pose);
  const Pose beside{state->place.obstacle, Eigen::Matrix3d::Identity()};
  state->cells.emplace(body, tolerance);
  state->around.emplace(body.ellipsoid(), obstacle, beside, state->place.agent);
  if (const std::optional<Ellipsoid> inscribed = body.inscribed_ellipsoid()) {
    const Ellipsoid within = Ellipsoid::from_shape(body.center(), inscribed->shape() * (1 - 1e-4));
    if (surely_contains(body, within)) state->within.emplace(within, obstacle, beside, state->place.agent);
  }
  state->check_range();
  state->relation = composite::delimited_relation(*state);
  state_ = std::move(state);
}

CompositePair::CompositePair(const Assembly& agent, const Pose& agent_pose, const Assembly& obstacle,
                             const Pose& obstacle_pose) {
  auto state = std::make_unique<State>(obstacle, obstacle_pose);
  if (is_upright(agent_pose) && state->upright) {
    state->agent = agent;
    state->place = {agent_pose.position, obstacle_pose.position};
  } else {
    state->agent = moved(agent, agent_pose, obstacle_pose);
  }
  state->check_range();
  if (state->agent->kind() == PieceKind::hull) {
    state->frames.reserve(state->agent->size());
    for (const HullBody& hull : state->agent->by_slot().hulls) state->frames.push_back(state->frame(hull));
  }
  if (state->agent->kind() == PieceKind::convex)
    for (const Convex& body : state->agent->by_slot().convexes) state->frames.push_back(state->frame(body));
  state->relation = composite::pieces_relation(*state);
  state_ = std::move(state);
}

CompositePair::~CompositePair() = default;
CompositePair::CompositePair(CompositePair&&) noexcept = default;
CompositePair& CompositePair::operator=(CompositePair&&) noexcept = default;

bool CompositePair::exact() const { return state_->agent.has_value(); }
const Assembly& CompositePair::obstacle() const { return state_->obstacle; }
std::optional<Relation> CompositePair::relation() const { return state_->relation; }

std::optional<Membership> CompositePair::membership(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b,
                                                    Effort* effort) const {
  require_finite_velocity(v_a, "agent_velocity");
  require_finite_velocity(v_b, "obstacle_velocity");
  const State& state = *state_;
  // Differences of doubles vanish only where they are equal.
  if (v_a == v_b) return Membership::out;
  if (state.relation && *state.relation != Relation::disjoint) return Membership::in;
  const Eigen::Vector3d w = composite::relative_velocity(v_a, v_b);
  const Eigen::Vector3d a = state.upright ? v_a : state.to_obstacle(w);
  const Eigen::Vector3d b = state.upright ? v_b : Eigen::Vector3d(Eigen::Vector3d::Zero());
  if (state.cells) return composite::delimited_membership(state, a, b);
  Effort unused;
  return composite::pieces_membership(state, a, b, effort != nullptr ? *effort : unused);
}

Verdict CompositePair::verdict(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b) const {
  if (!state_->relation) return Verdict::undecided;
  if (*state_->relation != Relation::disjoint)
    return *state_->relation == Relation::touching ? Verdict::touching : Verdict::overlapping;
  const std::optional<Membership> answer = membership(v_a, v_b);
  return answer ? verdict_of(Relation::disjoint, [&] { return *answer; }) : Verdict::undecided;
}

Verdict CompositePair::verdict(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b,
                               const Horizon& horizon) const {
  return verdict_within(state_->relation, v_a, v_b, horizon, [&](Stretch stretch) {
    if (!state_->upright)
      stretch = {state_->to_obstacle(v_a - v_b), Eigen::Vector3d::Zero(), stretch.from, stretch.until};
    const auto answer = state_->cells ? composite::delimited_within(*state_, stretch)
                                      : composite::pieces_within(*state_, stretch);
    return answer ? to_verdict(*answer) : Verdict::undecided;
  });
}

}  // namespace vericone
