// SPDX-License-Identifier: BSD-3-Clause
//
// How near: the least distance from now on.
#include <vericone/geometry/error.h>
#include <algorithm>
#include <optional>

#include "answers/velocity_ladder.h"
#include "assembly/gap.h"
#include "assembly/state.h"

namespace vericone::assembly {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Over all pieces, those first whose boxes could be nearest. The plane that proves the least distance found
/// so far is beneath most other pieces near it, as their surface turns away: that is asked before the
/// distance of one is measured.
class MissSearch {
 public:
  /// `space`: the agent in space (Frame::in_space).
  MissSearch(const Scene& scene, const Frame& space, const Eigen::Vector3d& w, double tolerance,
             Effort& effort)
      : scene_(scene),
        space_(space),
        nodes_(scene.nodes()),
        tolerance_(tolerance),
        effort_(effort),
        speed_(w.norm()),
        directions_(w.isZero(0) ? Directions() : Directions(space, {w})),
        residual_{w.isZero(0) ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : directions_.ray[0]},
        test_(space, directions_, residual_) {
    miss_.least = miss_.most = kInfinity;
  }
  MissSearch(const MissSearch&) = delete;  // the test refers to the directions

  AssemblyMiss run() {
    push(0);
    while (size_ > 0) {
      std::pop_heap(heap_, heap_ + size_, farther);
      const Item item = heap_[--size_];
      if (left_out(item.bound)) break;  // and so are all others
      if (left_out(above(item.node))) continue;
      const Hierarchy::Node& node = nodes_[item.node];
      if (node.is_leaf()) {
        measure(node);
      } else if (size_ + 2 <= kMostItems) {
        push(node.first);
        push(node.first + 1);
      } else {
        depth_first(item.node);
      }
    }
    miss_.least = std::min(miss_.least, miss_.most);
    return miss_;
  }

 private:
  struct Item {
    std::uint32_t node;
    double bound;
  };
  static bool farther(const Item& a, const Item& b) { return a.bound > b.bound; }

  /// Whether what keeps this distance need not be looked at; then that is all that is known of it.
  bool left_out(double bound) {
    const bool out = bound >= miss_.most - tolerance_ * (miss_.most + space_.ball());
    if (out) miss_.least = std::min(miss_.least, std::max(bound, 0.0));
    return out;
  }
  double above(std::uint32_t node) const { return plane_ ? plane_->above(nodes_[node]) : 0; }
  double bound(std::uint32_t node) const { return test_.distance(nodes_[node]); }

  void push(std::uint32_t node) {
    ++effort_.nodes;
    const Item item{node, bound(node)};
    if (left_out(item.bound)) return;
    heap_[size_++] = item;
    std::push_heap(heap_, heap_ + size_, farther);
  }

  void depth_first(std::uint32_t root) {
    std::uint32_t stack[128];
    int size = 0;
    stack[size++] = root;
    while (size > 0) {
      const std::uint32_t index = stack[--size];
      ++effort_.nodes;
      if (left_out(std::max(bound(index), above(index)))) continue;
      const Hierarchy::Node& node = nodes_[index];
      if (node.is_leaf()) {
        measure(node);
      } else {
        const bool first_last = bound(node.first) > bound(node.first + 1);
        stack[size++] = node.first + (first_last ? 0 : 1);
        stack[size++] = node.first + (first_last ? 1 : 0);
      }
    }
  }

  void measure(const Hierarchy::Node& node) {
    for (std::uint32_t slot = node.first; slot < node.first + node.count; ++slot) {
      const Box box = scene_.slot_box(slot);
      if (left_out(test_.distance(box.low, box.high))) continue;
      const Core core = scene_.core(space_, slot);
      if (plane_ && left_out(beyond_plane(core, directions_, normal_))) continue;
      measure(slot, core);
    }
  }

  void measure(std::uint32_t slot, const Core& core) {
    ++effort_.pieces;
    const Eigen::Vector3d away = residual_(core.center());
    const double radius = core.outer_rounding();
    const Gap found = gap(core, directions_, away.isZero(0) ? Eigen::Vector3d::UnitX() : away,
                          GapGoal::measure, tolerance_, miss_.most + radius);
    const double far = found.v.norm() + core.error() + 64 * kUlp * (core.reach() + found.along[0]);
    const double most = std::max(0.0, far - core.inner_rounding());
    // Every piece bounds the least distance from below, the nearest one from above.
    miss_.least = std::min(miss_.least, std::max(0.0, found.least - radius));
    if (!(most < miss_.most)) return;
    miss_.most = most;
    const Eigen::Vector3d n =
        found.v.isZero(0) ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : found.v.normalized();
    miss_.point = scene_.point_to_world(space_.to_space(found.on_piece - core.own_radius() * n));
    miss_.normal = scene_.to_world(n);
    miss_.time = speed_ > 0 ? found.along[0] / speed_ : 0;
    miss_.piece = scene_.piece(slot);
    normal_ = facing_away(n);
    if (normal_.isZero(0)) return;
    plane_.emplace(space_, directions_, normal_);
  }

  /// A normal without what rounding left of it along the ray.
  Eigen::Vector3d facing_away(Eigen::Vector3d n) const {
    if (directions_.count > 0)
      for (int i = 0; i < 2; ++i) n -= std::max(0.0, n.dot(directions_.ray[0])) * directions_.ray[0];
    const double length = n.norm();
    return length > 0.5 ? Eigen::Vector3d(n / length) : Eigen::Vector3d::Zero();
  }

  static constexpr int kMostItems = 512;

  const Scene& scene_;
  const Frame& space_;
  std::span<const Hierarchy::Node> nodes_;
  double tolerance_;
  Effort& effort_;
  double speed_;
  Directions directions_;
  RayResidual residual_;
  BoxTest<RayResidual> test_;
  AssemblyMiss miss_;
  std::optional<Plane> plane_;
  Eigen::Vector3d normal_ = Eigen::Vector3d::Zero();
  Item heap_[kMostItems];
  int size_ = 0;
};

}  // namespace
}  // namespace vericone::assembly

namespace vericone {

AssemblyMiss AssemblyOracle::miss_distance(const Eigen::Vector3d& w, double tolerance, Effort* effort) const {
  require_finite_velocity(w, "agent_velocity");
  if (!(tolerance >= 1e-13 && tolerance <= 1))
    throw InputError("tolerance", to_text(tolerance), "a number between 1e-13 and 1");
  Effort unused;
  // Whether they meet is known exactly; then the distance is 0, where they first do.
  if (state_->relation == Relation::disjoint)
    if (const std::optional<AssemblyContact> contact = first_contact(w, effort)) {
      AssemblyMiss met;
      met.point = contact->point;
      met.normal = contact->normal;
      met.time = contact->time;
      met.piece = contact->piece;
      return met;
    }
  AssemblyMiss miss = assembly::MissSearch(*state_, state_->space, state_->to_body(w), tolerance,
                                           effort != nullptr ? *effort : unused)
                          .run();
  if (state_->relation != Relation::disjoint) {
    miss.least = 0;
    if (state_->decided) miss.most = 0;
    miss.normal.setZero();
  }
  return miss;
}

}  // namespace vericone
