// SPDX-License-Identifier: BSD-3-Clause
//
// h = max over unit n of gap(n) - max(0, until n.w): any one normal proves a lower bound, the best one gives
// h and, by the envelope theorem, its derivatives. Of many parts the least counts; they are looked at best
// first on such bounds of their boxes.
#include <vericone/guidance/barrier.h>

#include <vericone/geometry/error.h>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <queue>
#include <string>

#include "barrier/parts_tree.h"
#include "barrier/witness.h"

namespace vericone::guidance {
namespace barriers {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity(), kRoundings = 0x1p-48;

struct Motion {
  Vector3d w;    // m/s, the agent's seen from the obstacle
  double until;  // s
};

/// What one normal, of length 1 to rounding, proves, m.
struct Proof {
  Vector3d n = Vector3d::Zero();
  double least = -kInfinity;
};

/// A point of the body less its position is no farther away.
double size_of(const Placed& body) {
  const Box bounds = body.body.bounds();
  return bounds.low.cwiseAbs().cwiseMax(bounds.high.cwiseAbs()).norm();
}

/// Two convex bodies.
class Convex {
 public:
  Convex(const Pair& pair, const Motion& motion) : pair_(pair), motion_(motion) {
    // Nearest on the line they are no later than this, and no nearer afterwards.
    const double far = (pair.obstacle().pose.position - pair.agent().pose.position).norm() +
                       size_of(pair.agent()) + size_of(pair.obstacle());
    speed_ = motion.w.norm();
    look_ = speed_ > 0 ? std::min(motion.until, 2 * far / speed_) : 0;
  }

  Barrier run() {
    if (pair_.verdict(motion_.w, Vector3d::Zero(), {0, motion_.until}) == Verdict::out) apart();
    if (!(best_.least > 0)) climb();
    Barrier result;
    result.least = best_.least;
    result.h = std::max(best_.least, value(best_.n));
    Vector3d on_agent = Vector3d::Zero();
    for (const Corner& x : corners(best_.n, kTight)) {
      result.time += x.weight * x.time;
      on_agent += x.weight * x.on_agent;
    }
    result.by_position = -best_.n;
    result.by_velocity = -result.time * best_.n;
    result.by_rotation = best_.n.cross(on_agent);
    return result;
  }

 private:
  double value(const Vector3d& n) const { return pair_.gap(n) - look_ * std::max(0.0, n.dot(motion_.w)); }

  double proved(const Vector3d& n) const {
    const double along = n.dot(motion_.w) + kRoundings * n.norm() * speed_;
    const double least = pair_.gap(n) - (along > 0 ? motion_.until * along : 0);
    return (least - kRoundings * std::abs(least)) / n.norm();
  }

  /// This normal, and where they pass the one without what rounding left of it along their way.
  void take(const Vector3d& n) {
    if (n.isZero(0)) return;
    const auto better = [&](const Vector3d& x) {
      if (const double least = proved(x); least > best_.least) best_ = {x, least};
    };
    better(n);
    if (!(speed_ > 0)) return;
    const Vector3d back = motion_.w / speed_;
    better((n - (std::max(n.dot(back), 0.0) + 2 * kRoundings) * back).normalized());
  }

  /// The distance is a convex function of time: it is least where they pass, or when time is up.
  void apart() {
    if (pair_.verdict(motion_.w, Vector3d::Zero()) == Verdict::out)
      if (const Miss miss = pair_.miss(motion_.w, Vector3d::Zero()); miss.time <= motion_.until)
        return near(miss);
    Placed then = pair_.agent();
    then.pose.position += look_ * motion_.w;
    near(Pair(then, pair_.obstacle()).miss(Vector3d::Zero(), Vector3d::Zero()));
  }

  /// A normal as the search for the least distance leaves it.
  void near(const Miss& miss) {
    if (!(miss.least > 0)) return;
    take(miss.normal);
    constexpr double kExact = 1e-12;
    if (miss.most - miss.least < kExact * miss.most) return;
    polish(miss.normal, kLoose);
    polish(best_.n, kCloser);
  }

  /// The corners of both bodies and of time that are extreme along n.
  std::vector<Corner> corners(const Vector3d& n, double slack) const {
    const double along = n.dot(motion_.w);
    const double earliest = along > kPassing * speed_ ? look_ : 0,
                 latest = along < -kPassing * speed_ ? 0 : look_;
    return witnesses(pair_.agent(), pair_.obstacle(), n, slack, motion_.w, earliest, latest);
  }

  /// Nearly the best normal, to within `slack`. It is perpendicular to all that is between the corners it
  /// belongs to, where the value has creases; along a crease it is smooth.
  void polish(const Vector3d& n, double slack) {
    const auto some = corners(n, slack);
    if (some.size() == 1) return take(top(n, {}, slack));
    const Vector3d first = (some[1].between - some[0].between).normalized();
    if (some.size() == 2) return take(top((n - n.dot(first) * first).normalized(), first, slack));
    const Vector3d across = first.cross(some[2].between - some[0].between).normalized();
    take(across.dot(n) < 0 ? -across : across);
  }

  /// From the best three of normals all around, in case they meet: there may be several tops.
  void climb() {
    std::vector<std::pair<double, Vector3d>> starts;
    const auto start = [&](const Vector3d& n) {
      if (n.norm() > 0) starts.emplace_back(value(n.normalized()), n.normalized());
    };
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z) start({double(x), double(y), double(z)});
    start(best_.n);
    const Vector3d c = pair_.obstacle().middle() - pair_.agent().middle();
    start(c);
    if (speed_ > 0) {
      const Vector3d w = motion_.w / speed_, e = w.unitOrthogonal(), f = w.cross(e);
      start(c - c.dot(w) * w);
      for (int k = 0; k < 12; ++k) start(std::cos(k * kTwelfth) * e + std::sin(k * kTwelfth) * f);
    }
    const auto higher = [](const auto& a, const auto& b) { return a.first > b.first; };
    std::partial_sort(starts.begin(), starts.begin() + kClimbs, starts.end(), higher);
    for (int i = 0; i < kClimbs; ++i) {
      const Vector3d n = top(starts[i].second, {}, 0.3);
      take(n);
      polish(n, kLoose);
    }
  }

  /// Up the sphere by steps that shrink; perpendicular to `crease` where there is one. Where the bodies pass
  /// the value has a crease too; one of the two directions of steps is along it.
  Vector3d top(Vector3d n, const std::optional<Vector3d>& crease, double step) const {
    double at = value(n);
    Vector3d last = Vector3d::Zero();  // a step that helped is tried again
    int values = 0;
    while (step > 1e-9 && values < kMostValues) {
      Vector3d e = crease ? Vector3d(n.cross(*crease)) : Vector3d(motion_.w - n.dot(motion_.w) * n);
      if (!(e.norm() > 1e-9 * (crease ? 1 : speed_))) e = n.unitOrthogonal();
      e.normalize();
      const Vector3d f = crease ? Vector3d(Vector3d::Zero()) : Vector3d(n.cross(e));
      bool moved = false;
      const auto attempt = [&](const Vector3d& by) {
        const Vector3d there = (n + by).normalized();
        const double value_there = value(there);
        if (++values; !(value_there > at)) return false;
        last = there - n;
        n = there;
        at = value_there;
        return moved = true;
      };
      while (last.norm() > 0 && attempt(2 * last)) {
      }
      const std::array<Vector3d, 8> ways{e, -e, f, -f, e + f, e - f, f - e, -e - f};
      for (std::size_t i = 0; i < (crease ? 2 : ways.size()); ++i)
        if (attempt(step * ways[i])) break;
      if (!moved) {
        step *= 0.5;
        last.setZero();
      }
    }
    return n;
  }

  static constexpr int kClimbs = 3, kMostValues = 500;
  static constexpr double kTwelfth = 0.52359877559829887, kPassing = 1e-6, kTight = 1e-9, kLoose = 1e-3,
                          kCloser = 1e-5;

  const Pair& pair_;
  Motion motion_;
  double speed_ = 0, look_ = 0;  // m/s; s, `until` as far as it matters
  Proof best_;
};

/// The convex parts of both bodies, pair by pair, those first whose boxes could be nearest.
class Parts {
 public:
  Parts(const Pair& pair, const Motion& motion)
      : agent_(pair.agent()), obstacle_(pair.obstacle()), motion_(motion) {
    c_ = obstacle_.pose().position - agent_.pose().position;
    size_ = c_.norm() + size_of(pair.agent()) + size_of(pair.obstacle());
  }

  Barrier run() {
    Barrier nearest;
    nearest.least = kInfinity;
    push({-kInfinity, PartsTree::root(), PartsTree::root()});
    while (!open_.empty() && open_.top().bound < nearest.least) {
      const Item item = open_.top();
      open_.pop();
      const bool a_ends = agent_.is_part(item.a), b_ends = obstacle_.is_part(item.b);
      if (a_ends && b_ends) {
        const Barrier own = Convex(Pair(agent_.part(item.a), obstacle_.part(item.b)), motion_).run();
        if (own.least < nearest.least) {
          nearest = own;
          normal_ = -own.by_position;
        }
        continue;
      }
      const auto larger = [&] {
        const Box a = agent_.box(item.a), b = obstacle_.box(item.b);
        return (a.high - a.low).norm() > (b.high - b.low).norm();
      };
      const auto push_if = [&](PartsTree::Node a, PartsTree::Node b) {
        const double least = bound(agent_.box(a), obstacle_.box(b));
        if (least < nearest.least) push({least, a, b});
      };
      if (!a_ends && (b_ends || larger()))
        agent_.for_each_child(item.a, [&](PartsTree::Node child) { push_if(child, item.b); });
      else
        obstacle_.for_each_child(item.b, [&](PartsTree::Node child) { push_if(item.a, child); });
    }
    return nearest;
  }

 private:
  struct Item {
    double bound;
    PartsTree::Node a, b;
    bool operator<(const Item& other) const { return bound > other.bound; }
  };
  void push(const Item& item) { open_.push(item); }

  /// At most h of all that two boxes hold, each in its body's frame.
  double bound(const Box& a, const Box& b) const {
    const Eigen::Matrix3d &ra = agent_.pose().rotation, &rb = obstacle_.pose().rotation;
    const Vector3d middle_a = 0.5 * (a.low + a.high), half_a = 0.5 * (a.high - a.low);
    const Vector3d middle_b = 0.5 * (b.low + b.high), half_b = 0.5 * (b.high - b.low);
    const Vector3d off = c_ + rb * middle_b - ra * middle_a;
    double best = -kInfinity;
    const auto attempt = [&](const Vector3d& any) {
      const double length = any.norm();
      if (!(length > 0)) return;
      const Vector3d n = any / length;
      const double speed = motion_.w.norm(), along = n.dot(motion_.w) + kRoundings * speed;
      const double room = n.dot(off) - (ra.transpose() * n).cwiseAbs().dot(half_a) -
                          (rb.transpose() * n).cwiseAbs().dot(half_b) - kRoundings * size_;
      best = std::max(best, (room - (along > 0 ? motion_.until * along : 0)) * (1 - kRoundings));
    };
    const double squared = motion_.w.squaredNorm();
    const double time = squared > 0 ? std::clamp(off.dot(motion_.w) / squared, 0.0, motion_.until) : 0;
    const Vector3d then = off - time * motion_.w;
    // From the middle of one to the nearest point of the other, and on to the first box.
    const Vector3d on_b = then + rb * (rb.transpose() * -then).cwiseMax(-half_b).cwiseMin(half_b);
    const Vector3d on_a = ra * (ra.transpose() * on_b).cwiseMax(-half_a).cwiseMin(half_a);
    for (const Vector3d& n : {normal_, on_b, Vector3d(on_b - on_a)}) {
      attempt(n);
      if (squared > 0) attempt(n - (n.dot(motion_.w) / squared * (1 + 1e-12)) * motion_.w);
    }
    for (int k = 0; k < 3; ++k)
      for (const auto& axis : {ra.col(k), rb.col(k)}) attempt(axis.dot(then) < 0 ? -axis : Vector3d(axis));
    return best;
  }

  PartsTree agent_, obstacle_;
  Motion motion_;
  Vector3d c_, normal_ = Vector3d::Zero();
  double size_ = 0;
  std::priority_queue<Item> open_;
};

}  // namespace
}  // namespace barriers

Barrier barrier(const Pair& pair, const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b, double until) {
  using namespace barriers;
  if (!(until >= 0)) throw InputError("until", to_text(until), "0 or more (seconds)");
  for (const auto& [v, name] : {std::pair(v_a, "agent_velocity"), std::pair(v_b, "obstacle_velocity")})
    for (int i = 0; i < 3; ++i)
      if (!std::isfinite(v(i)))
        throw InputError(std::string(name) + "[" + std::to_string(i) + "]", to_text(v(i)),
                         "a finite number (m/s)");
  const Motion motion{v_a - v_b, until};
  const auto is_convex = [](const Placed& body) {
    const auto* one = body.body.quadric();
    return one ? one->is_ellipsoid() : body.body.hull() || body.body.convex();
  };
  if (is_convex(pair.agent()) && is_convex(pair.obstacle())) return Convex(pair, motion).run();
  return Parts(pair, motion).run();
}

}  // namespace vericone::guidance
