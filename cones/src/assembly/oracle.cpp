// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/internal/cones/assembly/assembly_oracle.h>

#include "answers/velocity_ladder.h"
#include "assembly/gap.h"
#include "assembly/state.h"
#include "round/undecided.h"

namespace vericone {
using namespace assembly;

namespace {

/// y itself: the residual of the apex.
struct ApexResidual {
  Eigen::Vector3d operator()(const Eigen::Vector3d& y) const { return y; }
};

/// Nothing where it hangs on a piece that is not decided.
std::optional<Relation> find_relation(const Scene& scene) {
  const Directions apex{};
  const BoxTest test(scene.frame(), apex, ApexResidual{});
  const auto nodes = scene.nodes();
  std::optional<Relation> relation = Relation::disjoint;
  std::vector<exact::Generators> covered;
  std::vector<std::uint32_t> stack{0};
  while (!stack.empty()) {
    const Hierarchy::Node& node = nodes[stack.back()];
    stack.pop_back();
    if (test.apart(node)) continue;
    if (!node.is_leaf()) {
      stack.push_back(node.first);
      stack.push_back(node.first + 1);
      continue;
    }
    for (std::uint32_t slot = node.first; slot < node.first + node.count; ++slot) {
      const Core core = scene.core(slot);
      const Gap found = gap(core, apex, core.center().isZero(0) ? Eigen::Vector3d::UnitX() : core.center());
      if (found.answer == Gap::Answer::apart) continue;
      if (found.answer == Gap::Answer::met) return Relation::overlapping;
      const std::optional<Relation> exact = scene.exact_relation(slot, &covered);
      if (exact == Relation::overlapping) return exact;
      if (exact != Relation::disjoint && relation) relation = exact;
    }
  }
  return covered.size() > 1 && exact::cover_space(covered) ? Relation::overlapping : relation;
}

/// One piece more: `in` counts for all, then one that is not decided.
void take(const std::optional<Membership>& one, std::optional<Membership>& answer) {
  if (one == Membership::in || (one != Membership::out && answer)) answer = one;
}

std::optional<Membership> find_membership(const Scene& scene, const Eigen::Vector3d& v_a,
                                          const Eigen::Vector3d& v_b, Effort& effort) {
  Eigen::Vector3d w = v_a - v_b;
  if (w.isZero(0)) return Membership::out;  // differences of doubles vanish only where they are equal
  if (!w.allFinite()) w = 0.5 * v_a - 0.5 * v_b;
  const Slabs slabs(scene.frame(), scene.body().bounds(), w);
  const Directions ray(scene.frame(), {w});
  const BoxTest test(scene.frame(), ray, RayResidual{ray.ray[0]});
  std::optional<Membership> answer = Membership::out;
  std::vector<exact::Sector> covered;
  const double limit = std::numeric_limits<double>::infinity();
  along_ray(scene, slabs, test, limit, effort, [&](std::uint32_t slot, double) {
    const Box box = scene.slot_box(slot);
    if (std::isinf(slabs.enter(box.low.data(), box.high.data())) || test.apart(box.low, box.high))
      return true;
    ++effort.pieces;
    const Core core = scene.core(slot);
    const Eigen::Vector3d away = RayResidual{ray.ray[0]}(core.center());
    const Gap found = gap(core, ray, away.isZero(0) ? core.center() : away);
    if (found.answer == Gap::Answer::apart) return true;
    if (found.answer == Gap::Answer::met) {
      answer = Membership::in;
      return false;
    }
    ++effort.exact;
    const std::optional<Membership> exact = scene.exact_membership(slot, v_a, v_b, &covered);
    take(exact, answer);
    return exact != Membership::in;
  });
  return answer == Membership::on && exact::cover_plane(covered) ? std::optional(Membership::in) : answer;
}

/// `stretch`: in the obstacle's frame.
std::optional<Membership> find_within(const Scene& scene, const Stretch& stretch, Effort& effort) {
  const Eigen::Vector3d w = stretch.v_a - stretch.v_b;
  const Slabs slabs(scene.frame(), scene.body().bounds(), w, stretch.from, stretch.until);
  const Directions ray(scene.frame(), {w});
  const BoxTest test(scene.frame(), ray, RayResidual{ray.ray[0]});
  std::optional<Membership> answer = Membership::out;
  std::vector<exact::Generators> covered;
  const double limit = std::numeric_limits<double>::infinity();
  along_ray(scene, slabs, test, limit, effort, [&](std::uint32_t slot, double) {
    const Box box = scene.slot_box(slot);
    if (std::isinf(slabs.enter(box.low.data(), box.high.data())) || test.apart(box.low, box.high))
      return true;
    ++effort.pieces;
    const std::optional<Membership> one = met_within(scene.core(slot), slabs.clipped(stretch, box), [&] {
      ++effort.exact;
      return scene.exact_within(slot, stretch, covered);
    });
    take(one, answer);
    return one != Membership::in;
  });
  return covered.size() > 1 && answer == Membership::on && exact::cover_space(covered)
             ? std::optional(Membership::in)
             : answer;
}

}  // namespace

AssemblyOracle::AssemblyOracle(const Ellipsoid& agent, const Assembly& obstacle, const Pose& pose,
                               const Eigen::Vector3d& agent_at)
    : state_(std::make_unique<State>(agent, agent_at, obstacle, pose)) {
  state_->set(find_relation(*state_));
}
AssemblyOracle::AssemblyOracle(const Convex& agent, const Assembly& obstacle, const Pose& pose,
                               const Eigen::Vector3d& agent_at)
    : state_(std::make_unique<State>(agent, agent_at, obstacle, pose)) {
  state_->set(find_relation(*state_));
}
AssemblyOracle::AssemblyOracle(const HullBody& agent, const Assembly& obstacle, const Pose& pose,
                               const Eigen::Vector3d& agent_at)
    : state_(std::make_unique<State>(agent, agent_at, obstacle, pose)) {
  state_->set(find_relation(*state_));
}
AssemblyOracle::~AssemblyOracle() = default;
AssemblyOracle::AssemblyOracle(AssemblyOracle&&) noexcept = default;
AssemblyOracle& AssemblyOracle::operator=(AssemblyOracle&&) noexcept = default;

const Assembly& AssemblyOracle::obstacle() const { return state_->body(); }
Relation AssemblyOracle::relation() const { return state_->relation; }
bool AssemblyOracle::decided() const { return state_->decided; }

namespace {

/// What is not decided is undecided of the whole; verdicts say so.
Membership known(const std::optional<Membership>& answer) {
  if (!answer) throw round::Undecided{};
  return *answer;
}

}  // namespace

Membership AssemblyOracle::membership(const Eigen::Vector3d& w, Effort* effort) const {
  return membership(w, Eigen::Vector3d::Zero(), effort);
}

Membership AssemblyOracle::membership(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b,
                                      Effort* effort) const {
  require_finite_velocity(v_a, "agent_velocity");
  require_finite_velocity(v_b, "obstacle_velocity");
  Effort unused;
  Effort& count = effort != nullptr ? *effort : unused;
  if (state_->relation != Relation::disjoint) return v_a == v_b ? Membership::out : Membership::in;
  if (state_->upright()) return known(find_membership(*state_, v_a, v_b, count));
  return known(find_membership(*state_, state_->to_body(v_a - v_b), Eigen::Vector3d::Zero(), count));
}

Verdict AssemblyOracle::verdict(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b) const {
  if (!state_->decided) return Verdict::undecided;
  try {
    return verdict_of(state_->relation, [&] { return membership(v_a, v_b); });
  } catch (const round::Undecided&) {
    return Verdict::undecided;
  }
}

Verdict AssemblyOracle::verdict(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b,
                                const Horizon& horizon, Effort* effort) const {
  const auto now = state_->decided ? std::optional(state_->relation) : std::nullopt;
  return verdict_within(now, v_a, v_b, horizon, [&](Stretch stretch) {
    if (!state_->upright())
      stretch = {state_->to_body(v_a - v_b), Eigen::Vector3d::Zero(), stretch.from, stretch.until};
    Effort unused;
    const auto answer = find_within(*state_, stretch, effort != nullptr ? *effort : unused);
    return answer ? to_verdict(*answer) : Verdict::undecided;
  });
}

std::optional<NearestPlane> AssemblyOracle::nearest_plane(const Eigen::Vector3d& start,
                                                          const Eigen::Vector3d& end) const {
  const Scene& scene = *state_;
  if (scene.body().size() != 1) return std::nullopt;
  const Eigen::Vector3d first = scene.to_body(start), last = scene.to_body(end);
  Core core = scene.core(0);
  const auto enclosed = [](const Eigen::Vector3d& x) { return std::array<Interval, 3>{x.x(), x.y(), x.z()}; };
  core.stretch(enclosed(first), enclosed(last));
  const Gap found = gap(core, Directions{}, core.away(), GapGoal::measure, 1e-6);
  if (!(found.least > core.outer_rounding())) return std::nullopt;
  // The nearest point is one of the piece less one of the way; of a small piece, the middle.
  const Eigen::Vector3d n = scene.frame().to_frame().transpose() * found.v;
  const Eigen::Vector3d from = scene.frame().to_frame() * first,
                        along = scene.frame().to_frame() * (last - first);
  const double square = along.squaredNorm();
  const double at = square > 0 ? (core.center() - found.v - from).dot(along) / square : 0;
  return NearestPlane{scene.to_world(n), std::clamp(at, 0.0, 1.0)};
}

}  // namespace vericone
