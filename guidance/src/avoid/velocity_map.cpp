// SPDX-License-Identifier: BSD-3-Clause
//
// Boxes of velocities, halved. Of one convex part the velocities that hit are a convex set: a plane with all
// of a box on one side proves it safe, its corners prove it hit. Parts are asked about in the order in which
// they can be met, down a tree only as far as a box is small enough to tell them apart.
#include <vericone/guidance/velocity_map.h>

#include <vericone/cones/pair.h>
#include <vericone/geometry/error.h>
#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <numeric>
#include <optional>
#include <queue>
#include <string>
#include <vector>

#include "bands/at_once.h"
#include "bands/delimited.h"
#include "bands/threats.h"

namespace vericone::guidance {

using namespace banding;

namespace {

using Piece = Threats::Piece;

/// Velocities of the agent through the air.
struct Box3 {
  Vector3d low, high;

  Vector3d center() const { return low + 0.5 * (high - low); }
  /// Half of each side, at least.
  Vector3d half() const { return 0.5 * (1 + 0x1p-50) * (high - low); }
  bool touches(const Box3& other) const {
    return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
  }
  int longest() const {
    int axis = 0;
    (high - low).maxCoeff(&axis);
    return axis;
  }
  /// Each once: of a section there are four.
  std::vector<Vector3d> corners() const {
    std::vector<Vector3d> all{low};
    for (int axis = 0; axis < 3; ++axis) {
      if (!(high(axis) > low(axis))) continue;
      const std::size_t before = all.size();
      for (std::size_t i = 0; i < before; ++i) {
        all.push_back(all[i]);
        all.back()(axis) = high(axis);
      }
    }
    return all;
  }
};

/// A piece, and the normal of the plane that was last found beside it; zero: none yet.
struct Asked {
  Piece piece;
  Vector3d normal = Vector3d::Zero();
};

/// And a time before which no velocity of a box meets it.
struct Met {
  double from;
  Asked asked;
  bool operator<(const Met& other) const { return from > other.from; }  // the soonest on top
};

/// What is known of a box; `pieces`: all that its velocities may meet.
struct Known {
  Certified label = Certified::undecided;
  double earliest = 0, latest = 0;
  std::size_t obstacle = VelocityCell::kNone;
  bool first = false;
  std::vector<Asked> pieces;
};

class Classifier {
 public:
  Classifier(Threats& threats, const VelocityMapOptions& options)
      : threats_(threats), options_(options), horizon_{0, options.until} {}

  Known classify(const Box3& box, const std::vector<Asked>& parent) {
    Known known;
    std::priority_queue<Met> ahead;
    std::vector<Met> seen;
    std::optional<std::size_t> by;  // among `seen`: what is met with every velocity, for sure first
    known.latest = kInfinity;
    for (const Asked& asked : parent) add(ahead, box, asked);
    while (!ahead.empty() && !(ahead.top().from >= known.latest)) {
      Met met = ahead.top();
      const Piece& piece = met.asked.piece;
      ahead.pop();
      if (piece.is_node) {
        if (tells_apart(box, piece)) {
          threats_.open(piece, [&](const Piece& one) { add(ahead, box, {one}); });
        } else {
          seen.push_back(met);
        }
        continue;
      }
      const Part& part = threats_.part_of(piece);
      if (!is_met(part, box.center()) && keeps_clear(part, box, met.asked.normal)) continue;
      const std::optional<double> until = all_met(part, box);
      if (until && *until < known.latest) {
        known.latest = *until;
        by = seen.size();
      }
      seen.push_back(met);
    }
    for (; !ahead.empty(); ahead.pop()) seen.push_back(ahead.top());
    for (const Met& met : seen) known.pieces.push_back(met.asked);
    if (seen.empty()) known.label = Certified::out;
    if (by) tell_times(box, seen, seen[*by].asked.piece.intruder, known);
    return known;
  }

 private:
  /// Of a box whose velocities all have met an obstacle at `known.latest`; only what may be met before that
  /// is looked at.
  void tell_times(const Box3& box, const std::vector<Met>& seen, std::size_t obstacle, Known& known) {
    known.label = Certified::in;
    known.obstacle = obstacle;
    known.earliest = known.latest;
    known.first = true;
    for (const Met& met : seen) {
      const Piece& piece = met.asked.piece;
      double from = met.from;
      if (!piece.is_node && from < known.latest)
        from = std::max(from, not_before(threats_.part_of(piece), box));
      known.earliest = std::min(known.earliest, from);
      known.first = known.first && (piece.intruder == obstacle || from > known.latest);
    }
  }

  /// Whether one velocity surely meets a part, or what counts as that.
  bool is_met(const Part& part, const Vector3d& velocity) const {
    return part.exact() && is_met(part.swollen(), velocity + options_.wind, part.velocity, horizon_);
  }

  /// The most of n.w in a box, w relative to another's velocity, rounded upwards.
  double most_along(const Vector3d& n, const Box3& box, const Vector3d& other) const {
    const Vector3d half = box.half(), middle = box.center() + options_.wind;
    const double size = n.norm() * (middle.norm() + options_.wind.norm() + other.norm() + half.norm());
    return n.dot(middle - other) + n.cwiseAbs().dot(half) + kRoundings * size;
  }
  /// With a plane that has `room` m: the time before which it is not reached.
  static double reached(double room, double along) {
    if (!(room > 0)) return 0;
    return along > 0 ? room / along * (1 - 0x1p-48) : kInfinity;
  }

  /// Unless a plane says that it is met too late or never.
  void add(std::priority_queue<Met>& ahead, const Box3& box, const Asked& asked) const {
    const Threats::Apart ball = threats_.apart(asked.piece);
    const Vector3d &c = ball.center, &u = threats_.velocity_of(asked.piece);
    const Vector3d w = box.center() + options_.wind - u;
    const double across = box.half().norm(), speed = w.norm();
    double from = 0;
    const auto plane = [&](const Vector3d& n) {
      const double rounded = kRoundings * (c.norm() * n.norm() + ball.radius);
      from = std::max(from, reached(n.dot(c) - ball.radius * n.norm() - rounded, most_along(n, box, u)));
    };
    plane(c);
    // Where a ball about w, swept, comes nearest.
    const double along = speed > 0 ? c.dot(w) / speed : 0,
                 beside = std::sqrt(std::max(0.0, c.squaredNorm() - along * along));
    double time = options_.until;
    if (speed > across) {
      const double back = beside * across / std::sqrt(speed * speed - across * across);
      time = std::clamp((along + back) / speed, 0.0, options_.until);
    }
    if (const Vector3d n = c - time * w; n.norm() > 0) plane(n.normalized());
    if (from <= options_.until) ahead.push({from, asked});
  }

  /// Whether what is below a node may be told apart with velocities of one box; as they are when they arrive.
  bool tells_apart(const Box3& box, const Piece& node) const {
    const Threats::Apart ball = threats_.apart(node);
    const double speed = (box.center() + options_.wind - threats_.velocity_of(node)).norm(),
                 time = std::min(options_.until, (ball.center.norm() + ball.radius) / speed);
    return ball.radius > time * box.half().norm();
  }

  /// A time before which no velocity of a box reaches a part with the margin, by a plane.
  double reached_by(const Part& part, const Box3& box, const Vector3d& n) const {
    return reached(part.pair.gap(n) - options_.margin * n.norm() * (1 + 0x1p-48),
                   most_along(n, box, part.velocity));
  }

  /// Proved, by a plane for all, from the corner that is met most; or of bodies with delimiters as they are.
  /// `normal`: of a plane that is tried first; becomes that of the last one.
  bool keeps_clear(const Part& part, const Box3& box, Vector3d& normal) const {
    if (!normal.isZero(0) && reached_by(part, box, normal) > options_.until) return true;
    Vector3d v = box.center();
    for (int step = 0; step < 4; ++step) {
      const auto half = safe(part, v + options_.wind, horizon_, options_.margin);
      if (!half) break;
      normal = half->normal;
      const double along = most_along(half->normal, box, part.velocity);
      if (reached(half->room, along) > options_.until) return true;
      Vector3d next;
      for (int i = 0; i < 3; ++i) next(i) = half->normal(i) > 0 ? box.high(i) : box.low(i);
      if (next == v) break;
      v = next;
    }
    return part.truth && spread(box) < part.reach &&
           AsTheyAre(*part.truth)
               .apart(box.center() + options_.wind, part.velocity, horizon_, options_.margin + spread(box));
  }
  /// m by which flights of a box are apart at the end, at most, from that of its middle.
  double spread(const Box3& box) const {
    return options_.until * (box.half().norm() + kRoundings * (box.center().norm() + options_.wind.norm()));
  }

  /// Of a velocity that meets a pair: a time by which it has, and the normal of a plane that it does not
  /// reach much before. The first contact of two hulls may be the optimum of a linear programme in whole
  /// numbers, tens of microseconds; verdicts bracket it in a few.
  struct Meeting {
    double by;
    std::optional<Vector3d> normal;
  };
  Meeting meeting(const Pair& pair, const Vector3d& ground, const Vector3d& other) const {
    const bool hulls = pair.agent().body.hull() && pair.obstacle().body.hull();
    if (!hulls || std::isinf(options_.until)) {
      const auto contact = pair.contact(ground, other);
      return contact ? Meeting{contact->latest, contact->normal} : Meeting{kInfinity, {}};
    }
    double before = 0, by = options_.until;
    for (int step = 0; step < 20; ++step) {
      const double between = 0.5 * (before + by);
      (is_met(pair, ground, other, {0, between}) ? by : before) = between;
    }
    const auto half = pair.safe_half_space(ground, other, {0, before});
    return {by, half ? std::optional(half->normal) : std::nullopt};
  }
  static bool is_met(const Pair& pair, const Vector3d& ground, const Vector3d& other, const Horizon& within) {
    const Verdict verdict = pair.verdict(ground, other, within);
    return verdict == Verdict::in || verdict == Verdict::overlapping;
  }

  /// A time before which no velocity of the box brings a part nearer than the margin: the plane where the
  /// middle one does.
  double not_before(const Part& part, const Box3& box) const {
    const auto normal = meeting(part.swollen(), box.center() + options_.wind, part.velocity).normal;
    return normal ? reached_by(part, box, *normal) : 0;
  }

  /// A time until which every velocity of the box has brought a part nearer than the margin; nothing where
  /// that is not proved of all.
  std::optional<double> all_met(const Part& part, const Box3& box) const {
    const Pair* convex = part.exact() ? &part.swollen() : part.core ? &*part.core : nullptr;
    const auto hit = [&](const Vector3d& ground) {
      if (part.exact()) return comes_nearer(part, ground, horizon_, options_.margin);
      return is_met(*convex, ground, part.velocity, horizon_);
    };
    if (convex && hit(box.center() + options_.wind)) {
      const std::vector<Vector3d> corners = box.corners();
      for (const Vector3d& corner : corners)
        if (!hit(corner + options_.wind)) return std::nullopt;
      double latest = 0;
      for (const Vector3d& corner : corners)
        latest = std::max(latest, meeting(*convex, corner + options_.wind, part.velocity).by);
      latest = std::min(latest, options_.until);
      return latest;
    }
    if (part.exact() || !(spread(box) < part.reach)) return std::nullopt;
    const bool all =
        AsTheyAre(*part.truth).meets(box.center() + options_.wind, part.velocity, horizon_, spread(box));
    return all ? std::optional(options_.until) : std::nullopt;
  }

  Threats& threats_;
  const VelocityMapOptions& options_;
  Horizon horizon_;
};

/// The tree of boxes; the two halves of a divided one follow each other.
class Boxes {
 public:
  Boxes(Threats& threats, const VelocityMapOptions& options)
      : threats_(threats), options_(options), classifier_(threats, options) {}

  VelocityMap run() {
    VelocityMap map;
    nodes_.push_back(
        {{options_.low, options_.high}, 0, classify({options_.low, options_.high}, all_pieces())});
    std::deque<std::size_t> open{0};  // the larger ones first
    while (!open.empty() && map.complete) {
      const std::size_t at = open.front();
      open.pop_front();
      if (!to_divide(nodes_[at])) continue;
      map.complete = nodes_.size() + 2 <= options_.most_cells;
      if (!map.complete) break;
      checkpoint();
      nodes_[at].halves = nodes_.size();
      const Box3 box = nodes_[at].box;
      const std::vector<Asked> pieces = std::move(nodes_[at].known.pieces);
      const int axis = box.longest();
      Box3 lower = box, upper = box;
      lower.high(axis) = upper.low(axis) = box.center()(axis);
      for (const Box3& half : {lower, upper}) {
        open.push_back(nodes_.size());
        nodes_.push_back({half, 0, classify(half, pieces)});
      }
    }
    map.asked = nodes_.size();
    for (Node& node : nodes_) std::vector<Asked>().swap(node.known.pieces);
    merge();
    write(map);
    return map;
  }

 private:
  struct Node {
    Box3 box;
    std::size_t halves = 0;  // index of the first; 0: not divided
    Known known;
    std::size_t cell = 0;
  };

  std::vector<Asked> all_pieces() const {
    std::vector<Asked> all;
    for (const Piece& piece : threats_.all()) all.push_back({piece});
    return all;
  }
  Known classify(const Box3& box, const std::vector<Asked>& pieces) {
    Known known = classifier_.classify(box, pieces);
    if (known.label == Certified::out) known.pieces.clear();
    return known;
  }

  bool to_divide(const Node& node) const {
    const int axis = node.box.longest();
    const double side = node.box.high(axis) - node.box.low(axis), middle = node.box.center()(axis);
    if (!(side > options_.resolution && middle > node.box.low(axis) && middle < node.box.high(axis)))
      return false;
    if (node.known.label != Certified::in) return node.known.label == Certified::undecided;
    return std::isfinite(options_.time) &&
           !(node.known.first && node.known.latest - node.known.earliest <= options_.time);
  }

  /// Two safe halves are one cell.
  void merge() {
    for (std::size_t i = nodes_.size(); i-- > 0;) {  // halves come after their whole
      Node& node = nodes_[i];
      if (node.halves == 0) continue;
      const auto safe = [&](const Node& half) {
        return half.halves == 0 && half.known.label == Certified::out;
      };
      if (!safe(nodes_[node.halves]) || !safe(nodes_[node.halves + 1])) continue;
      node.known.label = Certified::out;
      node.halves = 0;
    }
  }

  void write(VelocityMap& map) {
    double all = 0;
    std::array<double, 3> shares{};
    add(map, 0, [&](const Node& node) {
      double size = 1;
      for (int i = 0; i < 3; ++i)
        if (options_.high(i) > options_.low(i))
          size *= (node.box.high(i) - node.box.low(i)) / (options_.high(i) - options_.low(i));
      all += size;
      shares[static_cast<std::size_t>(node.known.label)] += size;
      sizes_.push_back(size);
    });
    map.colliding = shares[static_cast<std::size_t>(Certified::in)] / all;
    map.safe = shares[static_cast<std::size_t>(Certified::out)] / all;
    map.undecided = shares[static_cast<std::size_t>(Certified::undecided)] / all;
    number_regions(map);
  }

  template <typename Use>
  void add(VelocityMap& map, std::size_t at, const Use& use) {
    Node& node = nodes_[at];
    if (node.halves != 0) {
      add(map, node.halves, use);
      add(map, node.halves + 1, use);
      return;
    }
    node.cell = map.cells.size();
    const Known& known = node.known;
    const bool in = known.label == Certified::in;
    map.cells.push_back({node.box.low, node.box.high, known.label, 0, in ? known.earliest : 0,
                         in ? known.latest : 0, known.obstacle, in && known.first});
    use(node);
  }

  /// By cells that touch, found down the tree.
  void number_regions(VelocityMap& map) const {
    std::vector<std::size_t> parent(map.cells.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](std::size_t i) {
      while (parent[i] != i) i = parent[i] = parent[parent[i]];
      return i;
    };
    for (std::size_t i = 0; i < map.cells.size(); ++i) {
      const VelocityCell& cell = map.cells[i];
      if (cell.label == Certified::undecided) continue;
      const Box3 box{cell.low, cell.high};
      std::vector<std::size_t> open{0};
      while (!open.empty()) {
        const Node& node = nodes_[open.back()];
        open.pop_back();
        if (!node.box.touches(box)) continue;
        if (node.halves != 0) {
          open.push_back(node.halves);
          open.push_back(node.halves + 1);
        } else if (node.known.label == cell.label) {
          parent[root(node.cell)] = root(i);
        }
      }
    }
    for (const Certified label : {Certified::out, Certified::in}) {
      std::map<std::size_t, double> size;
      for (std::size_t i = 0; i < map.cells.size(); ++i)
        if (map.cells[i].label == label) size[root(i)] += sizes_[i];
      std::vector<std::size_t> order;
      for (const auto& one : size) order.push_back(one.first);
      std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return size[a] > size[b]; });
      std::map<std::size_t, std::uint32_t> number;
      for (std::uint32_t k = 0; k < order.size(); ++k) number[order[k]] = k;
      for (std::size_t i = 0; i < map.cells.size(); ++i)
        if (map.cells[i].label == label) map.cells[i].region = number[root(i)];
      if (label == Certified::out) map.safe_regions = static_cast<std::uint32_t>(order.size());
    }
  }

  Threats& threats_;
  const VelocityMapOptions& options_;
  Classifier classifier_;
  std::vector<Node> nodes_;
  std::vector<double> sizes_;  // of cells
};

void require(std::span<const Intruder> intruders, const VelocityMapOptions& options) {
  const auto finite = [](const Vector3d& x, const std::string& field) {
    for (int i = 0; i < 3; ++i)
      if (!std::isfinite(x(i)))
        throw InputError(field + "[" + std::to_string(i) + "]", to_text(x(i)), "a finite number (m/s)");
  };
  finite(options.low, "low");
  finite(options.high, "high");
  finite(options.wind, "wind");
  for (std::size_t i = 0; i < intruders.size(); ++i)
    finite(intruders[i].velocity, "intruders[" + std::to_string(i) + "].velocity");
  for (int i = 0; i < 3; ++i)
    if (!(options.high(i) >= options.low(i)))
      throw InputError("high[" + std::to_string(i) + "]", to_text(options.high(i)),
                       "at least that of `low`, " + to_text(options.low(i)) + " (m/s)");
  const auto positive = [](double x, const char* field, const char* right) {
    if (!(x > 0 && std::isfinite(x))) throw InputError(field, to_text(x), right);
  };
  positive(options.resolution, "resolution", "positive (m/s)");
  positive(options.until, "until", "positive and finite (seconds)");
  if (!(options.margin >= 0 && std::isfinite(options.margin)))
    throw InputError("margin", to_text(options.margin), "0 or more (metres)");
  if (!(options.time > 0)) throw InputError("time", to_text(options.time), "positive (seconds)");
  if (options.most_cells < 1) throw InputError("most_cells", "0", "1 or more");
}

}  // namespace

VelocityMap velocity_map(const Placed& agent, std::span<const Intruder> intruders,
                         const VelocityMapOptions& options) {
  require(intruders, options);
  Threats threats(agent, intruders, options.margin);
  return Boxes(threats, options).run();
}

}  // namespace vericone::guidance
