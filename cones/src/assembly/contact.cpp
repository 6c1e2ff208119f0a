// SPDX-License-Identifier: BSD-3-Clause
//
// When and where: first contact.
#include <algorithm>
#include <optional>

#include "answers/velocity_ladder.h"
#include "assembly/contact.h"
#include "assembly/gap.h"
#include "assembly/state.h"

namespace vericone::assembly {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kMostNewtonSteps = 60;

/// Whether the apex is proved to be inside. Where polyhedra meet symmetrically, a simplex of their corners
/// may hold it on a face; then the four corners of a tetrahedron of size `around` about it are asked for, in
/// no particular direction. The core is convex.
bool overlaps(const Core& core, const Eigen::Vector3d& normal, double around) {
  const Directions apex{};
  if (gap(core, apex, normal).answer == Gap::Answer::met) return true;
  if (core.inner_rounding() > 0) return false;
  const Eigen::Vector3d corners[] = {
      {0.78, 0.37, 0.51}, {-0.81, 0.53, -0.24}, {-0.19, -0.94, 0.29}, {0.22, 0.04, -0.97}};
  Core moved = core;
  for (const Eigen::Vector3d& corner : corners) {
    moved.offset = core.offset + around * corner;
    if (gap(moved, apex, normal).answer != Gap::Answer::met) return false;
  }
  return true;
}

/// Closed under the whole set of questions: whether the ray meets the piece, by proof or by its exact
/// predicate.
bool meets(const Scene& scene, std::uint32_t slot, const Directions& ray, const Eigen::Vector3d& w,
           Effort& effort) {
  const Core core = scene.core(slot);
  const Eigen::Vector3d away = RayResidual{ray.ray[0]}(core.center());
  const Gap found = gap(core, ray, away.isZero(0) ? core.center() : away);
  if (found.answer != Gap::Answer::close) return found.answer == Gap::Answer::met;
  ++effort.exact;
  return scene.exact_membership(slot, w, Eigen::Vector3d::Zero()) != Membership::out;
}

AssemblyContact in_world(const Scene& scene, const PieceContact& contact, std::uint32_t slot, double scale) {
  AssemblyContact result;
  result.earliest = contact.earliest / scale * (1 - 2 * kUlp);
  result.latest = contact.latest / scale * (1 + 2 * kUlp);
  result.time = std::clamp(contact.time / scale, result.earliest, result.latest);
  result.point = scene.point_to_world(contact.point);
  result.normal = scene.to_world(contact.normal);
  result.piece = scene.piece(slot);
  return result;
}

}  // namespace

std::optional<PieceContact> piece_contact(const Frame& frame, Core core, double radius,
                                          const Eigen::Vector3d& d, double limit) {
  const Directions apex{};
  PieceContact contact;
  Eigen::Vector3d normal = core.center().isZero(0) ? d : core.center();
  Eigen::Vector3d on_piece = core.center();
  double t = 0;
  for (int step = 0; step < kMostNewtonSteps; ++step) {
    core.offset = t * d;
    const Gap found = gap(core, apex, normal, GapGoal::measure);
    const double length = found.v.norm();
    on_piece = found.on_piece;
    if (!(length > 0) || !(found.least > 0)) break;
    normal = found.v / length;
    const double closing = normal.dot(d);
    // Distances known to `slack`, and the planes with them.
    const double slack = 16 * kUlp * (core.reach() + core.offset.norm());
    const double wait = found.least - slack - core.outer_rounding();
    contact.time = std::max(t, t + (length - core.outer_rounding()) / closing);
    if (wait > 0 && closing <= 0) return std::nullopt;
    if (!(wait > 0)) break;
    const double next = t + wait / closing * (1 - 16 * kUlp);
    if (!(next > t * (1 + 4 * kUlp))) break;
    t = next;
    if (t > limit) return std::nullopt;
  }
  contact.earliest = std::max(0.0, t * (1 - 4 * kUlp));
  if (!std::isfinite(contact.time) || contact.time < t) contact.time = t;

  // Some time later the agent surely overlaps, unless it only grazes.
  double step = std::max(8 * kUlp * t, 64 * kUlp * core.reach() / d.norm());
  for (int i = 0; i < 32 && std::isinf(contact.latest); ++i, step *= 4) {
    core.offset = (t + step) * d;
    if (overlaps(core, normal, 0.25 * step * d.norm())) contact.latest = (t + step) * (1 + 4 * kUlp);
  }
  contact.time = std::clamp(contact.time, contact.earliest, contact.latest);
  contact.normal = frame.to_frame().transpose() * normal;
  contact.normal.normalize();
  contact.point = frame.to_space(on_piece);
  if (frame.is_space()) contact.point -= radius * contact.normal;
  return contact;
}

std::optional<AssemblyContact> first_contact(const Scene& scene, const Eigen::Vector3d& w, Effort& effort) {
  const Slabs slabs(scene.frame(), scene.body().bounds(), w);
  const Directions ray(scene.frame(), {w});
  const BoxTest test(scene.frame(), ray, RayResidual{ray.ray[0]});
  const Eigen::Vector3d d = scene.frame().to_frame() * (w / slabs.scale());
  double limit = kInfinity;
  PieceContact first;
  first.earliest = kInfinity;
  double latest = kInfinity;
  std::uint32_t first_slot = 0;
  along_ray(scene, slabs, test, limit, effort, [&](std::uint32_t slot, double) {
    const Box box = scene.slot_box(slot);
    if (!(slabs.enter(box.low.data(), box.high.data()) < limit) || test.apart(box.low, box.high)) return true;
    ++effort.pieces;
    if (!meets(scene, slot, ray, w, effort)) return true;
    const Core core = scene.core(slot);
    std::optional<PieceContact> contact = piece_contact(scene.frame(), core, core.own_radius(), d, limit);
    if (!contact) return true;
    if (contact->is_wide()) contact->refine(scene.exact_time(slot, w), slabs.scale());
    if (contact->earliest < first.earliest) {
      first = *contact;
      first_slot = slot;
    }
    latest = limit = std::min(latest, contact->latest);
    return true;
  });
  if (std::isinf(first.earliest)) return std::nullopt;
  first.latest = latest;
  return in_world(scene, first, first_slot, slabs.scale());
}

}  // namespace vericone::assembly

namespace vericone {

std::optional<AssemblyContact> AssemblyOracle::first_contact(const Eigen::Vector3d& w, Effort* effort) const {
  Effort unused;
  Effort& count = effort != nullptr ? *effort : unused;
  const assembly::Scene& scene = *state_;
  require_finite_velocity(w, "agent_velocity");
  if (state_->relation != Relation::disjoint) {
    AssemblyContact now;
    const AssemblyMiss place = miss_distance(Eigen::Vector3d::Zero());
    now.point = place.point;
    now.piece = place.piece;
    return now;
  }
  if (w.isZero(0)) return std::nullopt;
  return assembly::first_contact(scene, scene.to_body(w), count);
}

}  // namespace vericone
