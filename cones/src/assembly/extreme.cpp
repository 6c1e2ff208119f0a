// SPDX-License-Identifier: BSD-3-Clause
//
// The extreme direction of a body on a half-plane.
#include <vericone/cones/cone_geometry.h>
#include <vericone/geometry/error.h>
#include <algorithm>
#include <numbers>
#include <optional>
#include <string>

#include "assembly/gap.h"
#include "assembly/state.h"

namespace vericone {
using namespace assembly;

namespace {

/// Of the plane sector between two rays.
struct SectorResidual {
  Eigen::Vector3d first, last;
  // Of their plane, unit; and in it, perpendicular to the two rays and inwards. Zero where the rays are one.
  Eigen::Vector3d normal, from_first, from_last;

  explicit SectorResidual(const Directions& sector)
      : first(sector.ray[0]), last(sector.ray[1]), normal(sector.ray[0].cross(sector.ray[1])) {
    const double length = normal.norm();
    if (length > 1e-12) {
      normal /= length;
    } else {
      normal.setZero();
    }
    from_first = normal.cross(first);
    from_last = last.cross(normal);
  }
  Eigen::Vector3d operator()(const Eigen::Vector3d& y) const {
    if (y.dot(from_first) >= 0 && y.dot(from_last) >= 0 && !normal.isZero(0)) return y.dot(normal) * normal;
    const double a = y.dot(first), b = y.dot(last);
    return a > b ? Eigen::Vector3d(y - std::max(0.0, a) * first)
                 : Eigen::Vector3d(y - std::max(0.0, b) * last);
  }
};

/// The half-plane, in the obstacle's frame.
struct HalfPlane {
  Eigen::Vector3d axis, side;
  Eigen::Vector3d at(double angle) const { return std::cos(angle) * axis + std::sin(angle) * side; }
};

/// The directions of the half-plane between two angles.
struct PlaneAngle {
  Eigen::Vector3d first, last;  // in space
  Directions directions;
  PlaneAngle(const Frame& frame, const Eigen::Vector3d& from, const Eigen::Vector3d& to)
      : first(from), last(to), directions(frame, {from, to}) {}
};

/// The largest angle between `from` and `to` at which a piece is met, so far.
class ExtremeSearch {
 public:
  ExtremeSearch(const Scene& scene, const HalfPlane& plane, double from, double to, double tolerance,
                Effort& effort)
      : scene_(scene),
        plane_(plane),
        to_(to),
        tolerance_(tolerance),
        effort_(effort),
        last_(plane.at(to)),
        sector_(scene.frame(), plane.at(from), last_),
        low_(from),
        high_(from) {
    look_beyond(from);
  }

  /// Descends the whole hierarchy.
  void run() {
    const auto nodes = scene_.nodes();
    struct Item {
      std::uint32_t node;
      int version;  // of the sector that it was compared with
      double order;
    };
    Item stack[128];
    int size = 0;
    ++effort_.nodes;
    if (!apart(nodes[0])) stack[size++] = {0, version_, 0};
    while (size > 0 && !at_end()) {
      const Item item = stack[--size];
      const Hierarchy::Node& node = nodes[item.node];
      // The sector may have shrunk since the node was put aside.
      if (item.version != version_ && apart(node)) continue;
      if (node.is_leaf()) {
        for (std::uint32_t slot = node.first; slot < node.first + node.count; ++slot) raise(slot);
        continue;
      }
      effort_.nodes += 2;
      Item children[2];
      int count = 0;
      for (std::uint32_t child = node.first; child < node.first + 2; ++child) {
        const double above = edge_ ? edge_->above(nodes[child]) : 0;
        if (above > 0 || apart_by_box(nodes[child])) continue;
        children[count++] = {child, version_, edge_ ? -above : height(nodes[child])};
      }
      // What reaches farthest beyond is looked at first: it leaves the least to the others.
      if (count == 2 && children[0].order > children[1].order) std::swap(children[0], children[1]);
      for (int i = 0; i < count; ++i) stack[size++] = children[i];
    }
  }

  /// Before run(): a piece that may be met far out.
  void try_slot(std::uint32_t slot) { raise(slot); }

  /// Nothing more can be found.
  bool at_end() const { return found_ && low_ + tolerance_ >= to_; }

  bool found() const { return found_; }
  double low() const { return low_; }
  double high() const { return at_end() ? to_ : std::max(high_, beyond_); }
  const Eigen::Vector3d& direction() const { return direction_; }
  std::uint32_t slot() const { return slot_; }

 private:
  /// `normal`: of a plane, in the frame, that a piece which ends there has proved apart. Where the body
  /// bulges there the plane is apart from its neighbours too, and a fixed plane is compared with a box in no
  /// time.
  void look_beyond(double angle, const Eigen::Vector3d& normal) {
    look_beyond(angle);
    const double length = normal.norm();
    edge_.reset();
    if (!(length > 0)) return;
    edge_.emplace(scene_.frame(), sector_.directions, normal / length);
    edge_normal_ = normal;
  }
  void look_beyond(double angle) {
    beyond_ = std::min(angle, to_);
    sector_ = sector(beyond_);
    test_.emplace(scene_.frame(), sector_.directions, SectorResidual(sector_.directions));
    ++version_;
  }

  bool apart_by_box(const Hierarchy::Node& node) const {
    return !sector_.directions.spread_too_far() && test_->apart(node);
  }
  bool apart(const Hierarchy::Node& node) const {
    return (edge_ && edge_->above(node) > 0) || apart_by_box(node);
  }

  /// How far a node reaches towards the end of the sector, for the order of visits only.
  double height(const Hierarchy::Node& node) const {
    const Box box = node.box();
    const Eigen::Vector3d c = box.center() - scene_.frame().origin();
    const double across = c.dot(plane_.side) + box.half_widths().dot(plane_.side.cwiseAbs());
    const double along = c.dot(plane_.axis), sum = std::abs(across) + std::abs(along);
    return sum > 0 ? (along < 0 ? 2 - across / sum : across / sum) : 0;
  }

  PlaneAngle sector(double from) const { return {scene_.frame(), plane_.at(from), last_}; }

  static Eigen::Vector3d direction_of(const Eigen::Vector3d& v, const Eigen::Vector3d& otherwise) {
    if (!v.isZero(0)) return v;
    return otherwise.isZero(0) ? Eigen::Vector3d::UnitX() : otherwise;
  }

  /// The angle of the direction that a search ended with.
  double angle(const Gap& found, const PlaneAngle& sector, double from) const {
    const double a = found.along[0] / sector.directions.length[0],
                 b = found.along[1] / sector.directions.length[1];
    if (!(a + b > 0)) return from;
    const Eigen::Vector3d d = a * sector.first + b * sector.last;
    return std::clamp(std::atan2(d.dot(plane_.side), d.dot(plane_.axis)), from, to_);
  }

  /// Takes the angle as found where the direction there is proved to meet the piece; `exactly`: by the exact
  /// predicate, where doubles do not tell.
  bool take(std::uint32_t slot, const Core& core, double angle, bool exactly) {
    const Eigen::Vector3d w = plane_.at(angle);
    const Directions ray(scene_.frame(), {w});
    const Eigen::Vector3d away = RayResidual{ray.ray[0]}(core.center());
    const Gap found = gap(core, ray, away.isZero(0) ? core.center() : away);
    if (found.answer == Gap::Answer::apart) return false;
    if (found.answer == Gap::Answer::close) {
      if (!exactly) return false;
      ++effort_.exact;
      if (scene_.exact_membership(slot, w, Eigen::Vector3d::Zero()) == Membership::out) return false;
    }
    if (!found_ || angle > low_) {
      found_ = true;
      low_ = angle;
      direction_ = w;
      slot_ = slot;
    }
    return true;
  }

  /// The same a little before the angle: at the very end of what meets the piece the direction itself,
  /// rounded, may just miss it.
  bool take_near(std::uint32_t slot, const Core& core, double angle) {
    for (const double back : {0.0, 0.01 * tolerance_, 0.25 * tolerance_})
      if (angle - back >= beyond_ && take(slot, core, angle - back, false)) return true;
    return false;
  }

  /// Looks for directions beyond what is known at which the piece is met.
  void raise(std::uint32_t slot) {
    ++effort_.pieces;
    if (edge_ && scene_.body().kind() == PieceKind::triangle &&
        edge_->above(scene_.body().by_slot().triangles[slot]) > 0)
      return;
    const Core core = scene_.core(slot);
    const Gap found =
        gap(core, sector_.directions,
            edge_ ? edge_normal_ : direction_of(test_->residual()(core.center()), core.center()));
    if (found.answer == Gap::Answer::apart) return;
    double low = beyond_, high = to_, met = angle(found, sector_, beyond_);
    Eigen::Vector3d normal = direction_of(found.v, core.center());  // searches begin where the last one ended
    if (take_near(slot, core, met)) low = std::max(low, low_);
    // Mostly little is gained: steps that grow until one is beyond, then bisection. A direction that meets
    // the piece is found on the way wherever there is one to speak of.
    double step = tolerance_;
    Eigen::Vector3d beyond_high = Eigen::Vector3d::Zero();
    while (high - low > 0.5 * tolerance_) {
      const double middle = low + std::min(step, 0.5 * (high - low));
      if (middle <= low || middle >= high) break;
      step *= 4;
      const PlaneAngle beyond = sector(middle);
      const Gap at_middle = gap(core, beyond.directions, normal);
      normal = direction_of(at_middle.v, normal);
      if (at_middle.answer == Gap::Answer::apart) {
        high = middle;
        beyond_high = at_middle.v;
        continue;
      }
      low = middle;
      met = angle(at_middle, beyond, middle);
      if (take_near(slot, core, met)) low = std::max(low, low_);
    }
    // Met by a sliver of directions at most.
    if (!found_ || low_ < high - tolerance_)
      for (const double at : {met, low})
        if (take(slot, core, at, true)) break;
    high_ = std::max(high_, high);
    if (found_ && low_ + 0.5 * tolerance_ > beyond_) look_beyond(low_ + 0.5 * tolerance_, beyond_high);
  }

  const Scene& scene_;
  HalfPlane plane_;
  double to_, tolerance_;
  Effort& effort_;
  Eigen::Vector3d last_;  // direction at to_
  PlaneAngle sector_;
  std::optional<BoxTest<SectorResidual>> test_;  // of sector_
  std::optional<Plane> edge_;                    // apart from the sector, at its beginning
  Eigen::Vector3d edge_normal_ = Eigen::Vector3d::Zero();
  int version_ = 0;  // counts sectors
  bool found_ = false;
  double low_, high_, beyond_ = 0;
  Eigen::Vector3d direction_ = Eigen::Vector3d::Zero();
  std::uint32_t slot_ = 0;
};

/// `guess`: a slot that may be met far out, for a neighbouring half-plane was.
ExtremeDirection find_extreme(const Scene& scene, const HalfPlane& plane, double tolerance, Effort& effort,
                              std::optional<std::uint32_t>& guess) {
  ExtremeDirection result;
  // Rays of a sector must not be opposite to each other, in the frame of a thin agent neither.
  constexpr int kParts = 4;
  for (int part = kParts - 1; part >= 0 && !result.any; --part) {
    const double from = std::numbers::pi * part / kParts, to = std::numbers::pi * (part + 1) / kParts;
    ExtremeSearch search(scene, plane, from, to, tolerance, effort);
    if (guess) search.try_slot(*guess);
    search.run();
    result.any = search.found();
    if (!result.any) {
      // What is neither proved to be met nor to be apart.
      if (search.high() > from) result.high = std::max(result.high, search.high());
      continue;
    }
    result.low = search.low();
    result.high = std::max(result.high, search.high());
    result.direction = scene.to_world(search.direction());
    result.piece = scene.piece(search.slot());
    guess = search.slot();
  }
  return result;
}

void require_tolerance(double tolerance) {
  if (!(tolerance >= 1e-13 && tolerance <= 1))
    throw InputError("tolerance", to_text(tolerance), "radians between 1e-13 and 1");
}

}  // namespace

ExtremeDirection AssemblyOracle::extreme(const Eigen::Vector3d& axis, const Eigen::Vector3d& side,
                                         double tolerance, Effort* effort) const {
  require_tolerance(tolerance);
  Effort unused;
  std::optional<std::uint32_t> guess;
  return find_extreme(*state_, {state_->to_body(axis), state_->to_body(side)}, tolerance,
                      effort != nullptr ? *effort : unused, guess);
}

std::vector<ExtremeDirection> AssemblyOracle::extremes(const Eigen::Vector3d& axis, int half_planes,
                                                       double tolerance, Effort* effort) const {
  require_tolerance(tolerance);
  if (half_planes < 1 || half_planes > 1'000'000)
    throw InputError("half_planes", std::to_string(half_planes), "from 1 to 1000000");
  Effort unused;
  const AxisFrame basis(axis);
  std::optional<std::uint32_t> guess;
  std::vector<ExtremeDirection> result;
  result.reserve(std::size_t(half_planes));
  for (int i = 0; i < half_planes; ++i) {
    checkpoint();
    const double azimuth = 2 * std::numbers::pi * i / half_planes;
    const Eigen::Vector3d side = basis.across(azimuth);
    result.push_back(find_extreme(*state_, {state_->to_body(basis.axis), state_->to_body(side)}, tolerance,
                                  effort != nullptr ? *effort : unused, guess));
  }
  return result;
}

}  // namespace vericone
