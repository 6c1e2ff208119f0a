// SPDX-License-Identifier: BSD-3-Clause
//
// The search for the first contact of two bodies in motion (docs/explanation/motion.md).
#include <vericone/cones/motion.h>

#include <vericone/cones/pair.h>
#include <vericone/geometry/error.h>
#include <algorithm>
#include <cmath>
#include <queue>
#include <vector>

#include "motion/look.h"
#include "motion/meet.h"
#include "motion/path.h"

namespace vericone {
namespace motion {
namespace {

using Eigen::Vector3d;

constexpr double kEver = std::numeric_limits<double>::infinity();

/// A stretch of time ends where this part of the distance is left.
constexpr double kKept = 0.1;

/// How near the bound of the distance is to come to it, and in how many halvings.
constexpr double kSharp = 0.99;
constexpr int kHalvings = 400;

double ulp(double t) { return std::nextafter(t, kEver) - t; }

/// A stretch of time that is proved.
struct Stretch {
  double from, to, bound;                                                     // s, s, m
  bool operator<(const Stretch& other) const { return bound > other.bound; }  // the least on top
};

/// From `t` on, a time after which the bodies are farther from each other than at t and only part; infinite
/// where they turn beside each other for ever. `t` is not before a body that brakes stands.
double parted(const Path& a, const Path& b, double t) {
  const Course x = a.course(t), y = b.course(t);
  const double v = (y.velocity - x.velocity).norm(), w = (y.acceleration - x.acceleration).norm();
  const double c = (y.center - x.center).norm();
  // |c + v s + w s^2 / 2| is at least what is needed, for ever; the distance at t is at most c + R.
  const double needed = 2 * (c + a.reach() + b.reach());
  if (w > 0) return t + 1.001 * (v + std::sqrt(v * v + 2 * w * needed)) / w;
  if (v > 0) return t + 1.001 * needed / v;
  return a.rate() == 0 && b.rate() == 0 ? t : kEver;
}

class Search {
 public:
  Search(const Path& a, const Path& b, const MotionOptions& options)
      : a_(a), b_(b), most_steps_(options.most_steps) {
    for (const double stop : {a.stop(), b.stop()})
      if (std::isfinite(stop)) stops_.push_back(stop);
    std::sort(stops_.begin(), stops_.end());
  }

  /// True: a contact in [found().from, found().to]. False: apart to the end, or not from open().
  bool march(double from, double to) {
    double t = from, step = to - from;
    while (t < to) {
      if (steps_ >= most_steps_) return leave(t, to), false;
      const Look look = at(t);
      const double end = next_end(t, to);
      step = stretch(look, end - t, step);
      if (step > 0) {
        const double next = t + step < end ? t + step : end;
        done_.push({t, next, look.bound(0, next - t)});
        t = next;
        continue;
      }
      const double met = meeting_after(look, to);
      if (met < kEver) {
        found_ = {open_ ? open_->from : t, met, 0};
        return true;
      }
      t = passed_;
      step = to - t;
    }
    return false;
  }

  /// Raises the least bound until it is near a distance that they come to.
  void sharpen() {
    for (int i = 0; i < kHalvings && !done_.empty(); ++i) {
      const Stretch least = done_.top();
      const double middle = 0.5 * (least.from + least.to);
      if (least.bound >= kSharp * nearest_ || !(middle > least.from && middle < least.to)) return;
      done_.pop();
      done_.push(halved(least.from, middle, least.bound));
      done_.push(halved(middle, least.to, least.bound));
    }
  }

  [[nodiscard]] const Stretch& found() const { return found_; }
  [[nodiscard]] const std::optional<Stretch>& open() const { return open_; }
  [[nodiscard]] double least() const { return done_.empty() ? nearest_ : done_.top().bound; }
  [[nodiscard]] double nearest() const { return nearest_; }
  [[nodiscard]] double nearest_time() const { return nearest_time_; }
  [[nodiscard]] std::size_t steps() const { return steps_; }

  Look at(double t) {
    ++steps_;
    Look look(a_, b_, t, before_ ? &*before_ : nullptr);
    if (look.least() > 0) before_.emplace(look);
    if (const double most = look.most() + look.rounding(t); most < nearest_) {
      nearest_ = most;
      nearest_time_ = t;
    }
    return look;
  }

 private:
  double next_end(double t, double to) const {
    for (const double stop : stops_)
      if (stop > t) return std::min(stop, to);
    return to;
  }

  /// How long, at most, the bodies stay apart from the look on, with some distance left; 0: less than doubles
  /// tell. `guess`: how long the last one was.
  double stretch(const Look& look, double most, double guess) const {
    const double kept = std::max(kKept * look.least(), 4 * look.rounding(look.t()));
    if (!(look.least() > 2 * kept)) return 0;
    const auto holds = [&](double s) { return look.bound(0, s) >= kept; };
    const double least = 2 * ulp(look.t());
    double s = std::min(most, std::isfinite(guess) && guess > least ? guess : 1.0);
    if (holds(s)) {
      while (s < most && holds(std::min(2 * s, most))) s = std::min(2 * s, most);
    } else {
      do s *= 0.5;
      while (s > least && !holds(s));
      if (!(s > least)) return 0;
    }
    return s < most && holds(std::min(1.5 * s, most)) ? std::min(1.5 * s, most) : s;
  }

  /// Where nothing was proved from t on: a time at which they meet, proved; or infinite, and passed_ is where
  /// they are apart again.
  double meeting_after(const Look& before, double to) {
    const double t = before.t(), closing = before.closing();
    double ahead = std::max(4 * ulp(t), 0x1p-52 * (to - t));
    // Sooner they cannot overlap by what is needed.
    if (closing > 0) ahead = std::max(ahead, (before.least() + 2 * before.rounding(t)) / closing);
    for (; t + ahead < to; ahead *= 2) {
      const double then = t + ahead;
      if (steps_ >= most_steps_) return leave(t, to), kEver;
      if (meet(a_, b_, then)) return sooner(t, then);
      const Look look = at(then);
      // What comes after is proved; what lies between is not.
      if (look.bound(0, ahead) > 0.5 * look.least() && look.least() > 16 * look.rounding(then))
        return leave(t, then), kEver;
    }
    if (meet(a_, b_, to)) return sooner(t, to);
    return leave(t, to), kEver;
  }

  /// They meet at `late`; an earlier time, if there is one.
  double sooner(double early, double late) const {
    for (int i = 0; i < 3; ++i) {
      const double middle = early + 0.5 * (late - early);
      if (!(middle > early && middle < late) || !meet(a_, b_, middle)) break;
      late = middle;
    }
    return late;
  }

  void leave(double from, double to) {
    if (!open_) open_ = Stretch{from, to, 0};
    passed_ = to;
  }

  Stretch halved(double from, double to, double bound) {
    const double middle = 0.5 * (from + to);
    return {from, to, std::max(bound, at(middle).bound(middle - from, to - middle))};
  }

  const Path &a_, &b_;
  std::size_t most_steps_, steps_ = 0;
  std::vector<double> stops_;
  std::priority_queue<Stretch> done_;
  std::optional<Stretch> open_;
  Stretch found_{};
  std::optional<Look> before_;  // the last one
  double passed_ = 0, nearest_ = kEver, nearest_time_ = 0;
};

void require(const Horizon& horizon, const MotionOptions& options) {
  if (!(horizon.from >= 0) || !std::isfinite(horizon.from) || !(horizon.until >= horizon.from))
    throw InputError("horizon", "[" + to_text(horizon.from) + ", " + to_text(horizon.until) + "]",
                     "two times, 0 <= from <= until (s)");
  if (options.most_steps == 0) throw InputError("most_steps", "0", "at least 1");
}

/// A body that all but keeps its speed comes to stand farther away than squared lengths can tell.
void require_near(const Path& path, double to, double braking, const std::string& name) {
  constexpr double kFarthest = 1e150;  // m
  if (!std::isfinite(path.stop())) return;
  const Vector3d way = path.course(to).center - path.course(0).center;
  if (!(way.stableNorm() < kFarthest))
    throw InputError(name + ".braking", to_text(braking),
                     "0, or enough to stand within 1e150 m (m/s^2); or within a horizon, [from, until]");
}

/// What is proved of the bodies at one instant: what they are as placed, nothing being rounded at 0.
std::optional<Verdict> standing_verdict(const Path& a, const Path& b, double t) {
  if (t > 0) return meet(a, b, t) ? std::optional(Verdict::overlapping) : std::nullopt;
  std::optional<Verdict> found;
  const auto all_b = b.parts(0);
  for (const Placed& one : a.parts(0))
    for (const Placed& other : all_b) {
      const auto relation = Pair(one, other).relation();
      if (relation == Relation::overlapping) return Verdict::overlapping;
      if (relation == Relation::touching) found = Verdict::touching;
    }
  return found;
}

/// Where an agent that goes straight for the obstacle meets it: the points next to each other.
void add_place(MotionAnswer& answer, const Path& a, const Path& b, const Look& look) {
  const Vector3d n = look.normal();
  if (n.isZero(0) || !(look.least() > 0)) return;
  answer.normal = n;
  double nearest = kEver;
  const auto all_b = b.parts(look.t());
  for (const Placed& one : a.parts(look.t()))
    for (const Placed& other : all_b) {
      const auto contact = Pair(one, other).contact(n, Vector3d::Zero());
      if (!contact || !contact->point || !(contact->time < nearest)) continue;
      nearest = contact->time;
      answer.point = contact->point;
    }
}

}  // namespace
}  // namespace motion

MotionAnswer motion_answer(const Placed& agent, const BodyMotion& agent_motion, const Placed& obstacle,
                           const BodyMotion& obstacle_motion, const Horizon& horizon,
                           const MotionOptions& options) {
  motion::require(horizon, options);
  const motion::Path a(agent, agent_motion, "agent"), b(obstacle, obstacle_motion, "obstacle");
  motion::Search search(a, b, options);
  double stands = horizon.from;
  for (const double stop : {a.stop(), b.stop()})
    if (std::isfinite(stop)) stands = std::max(stands, stop);
  const double to = std::min(horizon.until, motion::parted(a, b, stands));
  motion::require_near(a, to, agent_motion.braking, "agent");
  motion::require_near(b, to, obstacle_motion.braking, "obstacle");
  if (!std::isfinite(to))
    throw InputError("horizon", "no end", "one with an end: these bodies turn beside each other for ever");

  MotionAnswer answer;
  answer.earliest = answer.latest = answer.time = horizon.from;
  if (const auto standing = motion::standing_verdict(a, b, horizon.from)) {
    answer.verdict = *standing;
    return answer;
  }
  if (search.march(horizon.from, to)) {
    answer.verdict = Verdict::in;
    answer.earliest = search.found().from;
    answer.latest = search.found().to;
    answer.time = answer.earliest + 0.5 * (answer.latest - answer.earliest);
    motion::add_place(answer, a, b, search.at(answer.earliest));
  } else if (search.open()) {
    answer.verdict = Verdict::undecided;
    answer.earliest = search.open()->from;
    answer.latest = search.open()->to;
    answer.time = search.nearest_time();
    motion::add_place(answer, a, b, search.at(answer.earliest));
  } else {
    const motion::Look end = search.at(to);
    // An instant: nothing was marched over.
    if (to == horizon.from && !(end.bound(0, 0) > 0)) return answer;
    search.sharpen();
    answer.verdict = Verdict::out;
    answer.earliest = answer.latest = horizon.until;
    answer.least = std::min(search.least(), search.nearest());
    answer.most = search.nearest();
    answer.time = search.nearest_time();
    if (to == horizon.from) answer.least = end.bound(0, 0);
  }
  answer.steps = search.steps();
  return answer;
}

}  // namespace vericone
