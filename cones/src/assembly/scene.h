// SPDX-License-Identifier: BSD-3-Clause
//
// What an oracle of assemblies reads, and how it descends the hierarchy.
#pragma once

#include <vericone/internal/cones/assembly/assembly_oracle.h>
#include <array>
#include <cmath>
#include <limits>

#include "answers/stretch.h"
#include "assembly/core.h"
#include "assembly/frame.h"
#include "assembly/gap.h"
#include "hulls/seam.h"

namespace vericone::assembly {

/// The piece in a slot, in the coordinates of a frame; `radius`: by which it is rounded besides its own.
Core piece_core(const Frame& frame, const Assembly& body, std::uint32_t slot, double radius = 0);
Box piece_box(const Assembly& body, std::uint32_t slot);

/// A body whose own origin stands at `at` beside an obstacle in `pose`, along the obstacle's axes: as it is
/// where the pose does not turn, otherwise in the obstacle's frame, rounded. Throws InputError naming "pose".
Ellipsoid in_obstacle_frame(const Ellipsoid& agent, const Eigen::Vector3d& at, const Pose& pose);
/// And where its own origin then stands.
Place place_of(const Eigen::Vector3d& at, const Pose& pose);

/// An agent along the obstacle's axes, and the obstacle.
class Scene {
 public:
  Scene(const Ellipsoid& agent, const Eigen::Vector3d& at, const Assembly& body, const Pose& pose);
  Scene(const HullBody& agent, const Eigen::Vector3d& at, const Assembly& body, const Pose& pose);
  Scene(const Convex& agent, const Eigen::Vector3d& at, const Assembly& body, const Pose& pose);

  const Frame& frame() const { return frame_; }
  const Assembly& body() const { return body_; }
  const Pose& pose() const { return pose_; }
  const Place& place() const { return place_; }
  /// The pose moves the body only, or not at all.
  bool upright() const { return upright_; }
  std::span<const Hierarchy::Node> nodes() const { return body_.hierarchy().nodes(); }
  std::uint32_t piece(std::uint32_t slot) const { return body_.hierarchy().order()[slot]; }

  /// Of the obstacle's frame.
  Eigen::Vector3d to_body(const Eigen::Vector3d& direction) const {
    return upright_ ? direction : Eigen::Vector3d(pose_.rotation.transpose() * direction);
  }
  Eigen::Vector3d to_world(const Eigen::Vector3d& direction) const {
    return upright_ ? direction : Eigen::Vector3d(pose_.rotation * direction);
  }

  Eigen::Vector3d point_to_world(const Eigen::Vector3d& x) const {
    return upright_ ? Eigen::Vector3d(x + pose_.position) : pose_.to_world(x);
  }

  Core core(std::uint32_t slot) const { return core(frame_, slot); }
  /// The same for another frame of the same agent or a point.
  Core core(const Frame& frame, std::uint32_t slot) const { return piece_core(frame, body_, slot); }
  Box slot_box(std::uint32_t slot) const { return piece_box(body_, slot); }

  /// The piece's own exact predicates. `w` = v_a - v_b in the obstacle's frame. `covered`: where a flat agent
  /// touches the piece, what that covers is added. Nothing where the last rung has no answer.
  std::optional<Membership> exact_membership(std::uint32_t slot, const Eigen::Vector3d& v_a,
                                             const Eigen::Vector3d& v_b,
                                             std::vector<exact::Sector>* covered = nullptr) const;
  std::optional<Relation> exact_relation(std::uint32_t slot,
                                         std::vector<exact::Generators>* covered = nullptr) const;
  /// On a stretch in the obstacle's frame.
  std::optional<Membership> exact_within(std::uint32_t slot, const Stretch& stretch,
                                         std::vector<exact::Generators>& covered) const;
  /// When it is first touched along w, which meets it: s, rounded down and up; nothing where that is not
  /// known.
  std::optional<std::pair<double, double>> exact_time(std::uint32_t slot, const Eigen::Vector3d& w) const;

  /// At least |x - p| for the agent's centre p and every point x of the body.
  double largest() const;

  /// Of the agent; the one that there is.
  const Ellipsoid* ellipsoid() const { return ellipsoid_ ? &*ellipsoid_ : nullptr; }
  const HullBody* hull() const { return hull_ ? &*hull_ : nullptr; }
  const Convex* convex() const { return convex_ ? &*convex_ : nullptr; }

 private:
  void check_range();
  bool is_flat_agent() const { return hull_ && exact::is_flat(hull_->points()); }

  Assembly body_;
  Pose pose_;
  bool upright_ = true;
  Place place_;
  std::optional<Ellipsoid> ellipsoid_;
  std::optional<HullBody> hull_;
  std::optional<Convex> convex_;
  Frame frame_;
};

/// How far a core stays from the apex along n, unit, and from all that is asked about, at least; not positive
/// where the plane tells nothing. `room`: by how much the agent's part is farther away than the core knows.
inline double beyond_plane(const Core& core, const Directions& directions, const Eigen::Vector3d& n,
                           double room = 0) {
  Eigen::Vector3d on_piece;
  const double reach = core.reach(), slack = 64 * kUlp * (reach + room);
  return n.dot(core.support(n, on_piece)) + room -
         (core.error() + slack + directions.slant(n) * reach + core.outer_rounding());
}

/// A plane through the apex as a proof that boxes, widened by the agent, are apart from directions.
class Plane {
 public:
  /// `normal`: in the frame, unit.
  Plane(const Frame& frame, const Directions& directions, const Eigen::Vector3d& normal)
      : frame_(&frame),
        back_(frame.to_frame().transpose() * normal),
        extent_(frame.least_extent(normal, 1)),
        relative_slack_(128 * kUlp + directions.slant(normal)) {}

  /// How far above the plane the widened box surely is; not positive where it may reach through.
  double above(const Hierarchy::Node& node) const {
    const Box box = node.box();
    const Eigen::Vector3d l = box.low - frame_->origin(), h = box.high - frame_->origin();
    const Eigen::Vector3d middle = 0.5 * (l + h), half = 0.5 * (h - l);
    return above(back_.dot(middle) - back_.cwiseAbs().dot(half), middle.cwiseAbs().sum() + half.sum());
  }
  /// The same of the widened convex hull of three points.
  double above(const std::array<Eigen::Vector3d, 3>& corners) const {
    const Eigen::Vector3d a = corners[0] - frame_->origin(), b = corners[1] - frame_->origin(),
                          c = corners[2] - frame_->origin();
    return above(std::min({back_.dot(a), back_.dot(b), back_.dot(c)}),
                 a.cwiseAbs().cwiseMax(b.cwiseAbs()).cwiseMax(c.cwiseAbs()).sum());
  }

 private:
  /// `least`: of what lies at most `size` from p.
  double above(double least, double size) const {
    const double reach = frame_->norm() * size + frame_->ball() + frame_->outer();
    return least - extent_ - (relative_slack_ * reach + frame_->off_origin());
  }

  const Frame* frame_;
  Eigen::Vector3d back_;
  double extent_, relative_slack_;
};

/// Proofs that a box of the hierarchy, widened by the agent, is apart from all directions asked about: a
/// plane through the apex whose normal is the part of the box's middle that points away from the directions.
///
/// `Residual`: y -> y minus the point of the directions (or of a cone that contains them) nearest to y, or 0.
template <class Residual>
class BoxTest {
 public:
  BoxTest(const Frame& frame, const Directions& directions, Residual residual)
      : frame_(frame), directions_(directions), residual_(std::move(residual)) {}

  /// A distance, in the frame, that the widened box keeps from all directions; not positive where no such
  /// plane is found.
  double distance(const Eigen::Vector3d& low, const Eigen::Vector3d& high) const {
    const Eigen::Vector3d l = low - frame_.origin(), h = high - frame_.origin();
    const Eigen::Vector3d middle = 0.5 * (l + h), half = 0.5 * (h - l);
    const Eigen::Vector3d y = frame_.to_frame() * middle;
    const Eigen::Vector3d n = residual_(y);
    const double length = n.norm();
    if (!(length > 0)) return 0;
    const Eigen::Vector3d back = frame_.to_frame().transpose() * n;
    const double above = n.dot(y) - back.cwiseAbs().dot(half) - frame_.extent(n, length);
    if (!(above > 0)) return 0;
    const double size = frame_.norm() * (middle.cwiseAbs().sum() + half.sum()) + frame_.ball();
    const double slack =
        128 * kUlp * size + frame_.off_origin() + directions_.slant(n / length) * (size + frame_.outer());
    return above / length - slack;
  }
  double distance(const Hierarchy::Node& node) const {
    return distance({node.low[0], node.low[1], node.low[2]}, {node.high[0], node.high[1], node.high[2]});
  }
  const Residual& residual() const { return residual_; }

  bool apart(const Eigen::Vector3d& low, const Eigen::Vector3d& high) const {
    return distance(low, high) > 0;
  }
  bool apart(const Hierarchy::Node& node) const { return distance(node) > 0; }

 private:
  const Frame& frame_;
  const Directions& directions_;
  Residual residual_;
};

/// Residual of one ray.
struct RayResidual {
  Eigen::Vector3d ray;
  Eigen::Vector3d operator()(const Eigen::Vector3d& y) const { return y - std::max(0.0, y.dot(ray)) * ray; }
};

/// Of the circular cone around the rays.
struct CircularResidual {
  Eigen::Vector3d axis;
  double cosine, sine;

  explicit CircularResidual(const Directions& directions)
      : axis(directions.middle),
        cosine(directions.least_cosine * (1 - 4 * kUlp)),
        sine(std::sqrt(std::max(0.0, 1 - cosine * cosine))) {}

  Eigen::Vector3d operator()(const Eigen::Vector3d& y) const {
    const double along = y.dot(axis);
    const Eigen::Vector3d across = y - along * axis;
    const double radius = across.norm();
    if (radius * cosine <= along * sine) return Eigen::Vector3d::Zero();
    if (along * cosine + radius * sine <= 0) return y;  // nearest to the apex
    return across * (cosine / radius) - sine * axis;
  }
};

/// Whether one piece is met in all three directions, and so in all between them: its cone is convex.
bool meets_all(const Core& core, const Directions (&rays)[3]);

/// A ray from the apex, or a stretch of it, against boxes, each widened by the box around the agent.
/// Conservative: no widened piece that is met is missed.
class Slabs {
 public:
  /// `w`: in space, finite, not zero. `from`, `until`: seconds.
  Slabs(const Frame& frame, const Box& bounds, const Eigen::Vector3d& w, double from = 0,
        double until = std::numeric_limits<double>::infinity()) {
    scale_ = w.cwiseAbs().maxCoeff();
    from_ = from * scale_ * (1 - 8 * kUlp);
    until_ = until * scale_ * (1 + 8 * kUlp);
    for (int k = 0; k < 3; ++k) {
      const double component = w(k) / scale_;
      const bool crosses = std::abs(component) < 1e-290;  // slower than the inverse says
      inverse_[k] = crosses ? std::copysign(1e290, component) : 1 / component;
      later_[k] = crosses ? std::numeric_limits<double>::infinity() : 1;
      const double largest = std::max(std::abs(bounds.low(k)), std::abs(bounds.high(k))) +
                             std::abs(frame.origin()(k)) + frame.reach()(k);
      const double slack = 16 * kUlp * largest + 1e-280;
      low_[k] = -frame.origin()(k) - frame.reach()(k) - slack;
      high_[k] = -frame.origin()(k) + frame.reach()(k) + slack;
    }
  }

  /// When the ray enters the box, in multiples of w / max|w_k|; infinity where it misses.
  double enter(const double* low, const double* high) const { return enter_any(low, high); }
  double enter(const Hierarchy::Node& node) const { return enter_any(node.low, node.high); }

  /// The part of a stretch on which a box that is entered can be met.
  Stretch clipped(Stretch stretch, const Box& box) const {
    double last;
    const double first = enter_any(box.low.data(), box.high.data(), &last);
    const double from = first / scale_ * (1 - 8 * kUlp), until = last / scale_ * (1 + 8 * kUlp);
    if (from > stretch.from) stretch.from = std::min(from, stretch.until);
    if (until < stretch.until) stretch.until = std::max(until, stretch.from);
    return stretch;
  }

  /// Largest |w_k|: what to divide by for times in seconds.
  double scale() const { return scale_; }

 private:
  template <class Number>
  double enter_any(const Number* low, const Number* high, double* exit = nullptr) const {
    double first = from_, last = until_;
    for (int k = 0; k < 3; ++k) {
      const double a = (low[k] + low_[k]) * inverse_[k], b = (high[k] + high_[k]) * inverse_[k];
      first = std::max(first, std::min(a, b));
      last = std::min(last, std::max(a, b) * later_[k]);  // not a number: no bound
    }
    if (exit != nullptr) *exit = last * (1 + 8 * kUlp);
    return first * (1 - 8 * kUlp) <= last * (1 + 8 * kUlp) ? first * (1 - 8 * kUlp)
                                                           : std::numeric_limits<double>::infinity();
  }

  double inverse_[3], later_[3], low_[3], high_[3], scale_ = 1, from_ = 0, until_;
};

/// What comes of asking one pair of pieces about a stretch: proved by doubles, or by asking `exact()`.
template <class Exact>
std::optional<Membership> met_within(Core core, const Stretch& stretch, const Exact& exact) {
  core.stretch(stretch.way(stretch.from), stretch.way(stretch.until));
  switch (gap(core, Directions{}, core.away()).answer) {
    case Gap::Answer::apart:
      return Membership::out;
    case Gap::Answer::met:
      return Membership::in;
    case Gap::Answer::close:
      break;
  }
  return exact();
}

/// Calls leaf(slot, enter) for the slots whose boxes the ray enters before `limit`, nearer nodes first;
/// `limit` may shrink meanwhile. leaf returns false to stop. Boxes that look small beside the agent are
/// compared with it as it is, not only with the box around it: between the two there is room for thousands of
/// points of a dense cloud.
template <class Residual, class Leaf>
void along_ray(const Scene& scene, const Slabs& slabs, const BoxTest<Residual>& test, const double& limit,
               Effort& effort, Leaf&& leaf) {
  const auto nodes = scene.nodes();
  const float small = static_cast<float>(scene.frame().reach().maxCoeff());
  const auto enter = [&](const Hierarchy::Node& node) {
    const double at = slabs.enter(node);
    if (!(at < limit)) return std::numeric_limits<double>::infinity();
    const bool is_small = node.high[0] - node.low[0] < small && node.high[1] - node.low[1] < small &&
                          node.high[2] - node.low[2] < small;
    return is_small && test.apart(node) ? std::numeric_limits<double>::infinity() : at;
  };
  struct Item {
    std::uint32_t node;
    double enter;
  };
  Item stack[128];
  int size = 0;
  ++effort.nodes;
  if (const double at = enter(nodes[0]); at < limit) stack[size++] = {0, at};
  while (size > 0) {
    const Item item = stack[--size];
    if (!(item.enter < limit)) continue;
    const Hierarchy::Node& node = nodes[item.node];
    if (node.is_leaf()) {
      for (std::uint32_t slot = node.first; slot < node.first + node.count; ++slot)
        if (!leaf(slot, item.enter)) return;
      continue;
    }
    effort.nodes += 2;
    const double first = enter(nodes[node.first]), second = enter(nodes[node.first + 1]);
    const bool swap = first < second;
    const Item far{node.first + (swap ? 1u : 0u), swap ? second : first};
    const Item near{node.first + (swap ? 0u : 1u), swap ? first : second};
    if (far.enter < limit) stack[size++] = far;
    if (near.enter < limit) stack[size++] = near;
  }
}

}  // namespace vericone::assembly
