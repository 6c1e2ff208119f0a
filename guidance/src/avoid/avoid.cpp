// SPDX-License-Identifier: BSD-3-Clause
//
// Rays and triangles of rays from the wanted velocity. Along a ray each convex part blocks one interval;
// where the first gap is, there is a candidate. Between three rays all that the hull of six points of one
// part holds is blocked; where the chain of those ends, nothing safe is nearer. Best first on that bound.
// Parts are looked for where a chain or a ray has come to, and only those there are asked for their ends.
#include <vericone/guidance/avoid.h>

#include <vericone/cones/pair.h>
#include <vericone/geometry/error.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <map>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "avoid/flown.h"
#include "avoid/longest.h"
#include "bands/at_once.h"
#include "bands/delimited.h"
#include "bands/threats.h"

namespace vericone::guidance {

using namespace banding;
using namespace avoiding;

namespace {

/// What a part does to a ray: proved to be hit, and not known to be free.
struct Blocked {
  std::optional<Range> hit;
  std::vector<Range> not_free;
};

/// From the wanted velocity. `slow`: too slow to be flown; `limits`: all that cannot be flown.
struct Ray {
  Vector3d direction;
  std::optional<Range> slow;
  std::vector<Range> limits;
  std::unordered_map<const Part*, Blocked> parts = {};  // those asked about
};

struct Triangle {
  double bound;             // no safe velocity in it is nearer
  std::array<int, 3> rays;  // counter-clockwise
  std::size_t known;        // parts when that was found
  bool operator<(const Triangle& other) const { return bound > other.bound; }  // the nearest on top
};

/// Of some parts alone, those that were in the way of candidates: what they leave is nearer than what all
/// leave, so its bound is one. A candidate is asked of all, and some of those in its way are added.
class Search3 {
 public:
  Search3(const Vector3d& velocity, const Vector3d& wanted, Threats& threats, const AvoidOptions& options,
          double until)
      : flown_(velocity, options),
        wanted_(wanted),
        threats_(threats),
        options_(options),
        horizon_{0, until},
        gap_(options.gap),
        most_(options.most) {}

  Avoidance run() {
    if (flown_.can_fly(wanted_) && !add_those_in_the_way(wanted_)) {
      best_ = wanted_;
      upper_ = 0;
      return found(0);
    }
    // As far as can be flown; without a limit, as far as one would look.
    const double fastest = std::max(wanted_.norm(), threats_.fastest());
    reach_ =
        1.01 * (wanted_.norm() + (std::isfinite(options_.speed.to) ? options_.speed.to : 4 * fastest)) + 1e-3;
    static constexpr int kFaces[8][3] = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                         {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    for (int k = 0; k < 6; ++k) ray(Vector3d::Unit(k / 2) * (k % 2 == 0 ? 1 : -1));
    for (const auto& face : kFaces) open({face[0], face[1], face[2]});
    refine();
    if (std::isfinite(upper_)) return found(open_.empty() ? upper_ / (1 + gap_) : open_.front().bound);
    Avoidance none;
    if (open_.empty()) none.status = AvoidStatus::nothing_safe;
    none.lower = open_.empty() ? kInfinity : open_.front().bound;
    return none;
  }

 private:
  const Vector3d& direction(int ray) const { return rays_[static_cast<std::size_t>(ray)].direction; }

  /// Until the nearest candidate is nearly as near as the bound, or as many rays were looked along as may be.
  void refine() {
    while (!open_.empty() && !(upper_ <= open_.front().bound * (1 + gap_)) && rays_.size() < most_) {
      const Triangle nearest = open_.front();
      std::pop_heap(open_.begin(), open_.end());
      open_.pop_back();
      if (nearest.known < parts_.size()) {  // more may be known to be blocked by now
        open(nearest.rays);
        continue;
      }
      const std::array<int, 3>& t = nearest.rays;
      // Halve the longest side.
      const auto side = [&](int i) {
        return (direction(t[(i + 1) % 3]) - direction(t[(i + 2) % 3])).squaredNorm();
      };
      int longest = 0;
      for (int i = 1; i < 3; ++i)
        if (side(i) > side(longest)) longest = i;
      if (side(longest) < kTiny * kTiny) {  // where parts only touch: no more is proved
        open_.push_back(nearest);
        std::push_heap(open_.begin(), open_.end());
        return;
      }
      const int apex = t[longest], from = t[(longest + 1) % 3], to = t[(longest + 2) % 3],
                half = between(from, to);
      open({apex, from, half});
      open({apex, half, to});
    }
  }

  void open(const std::array<int, 3>& rays) {
    const std::size_t known = parts_.size();
    const double bound = bound_of(rays);
    if (std::isinf(bound)) return;
    open_.push_back({bound, rays, known});
    std::push_heap(open_.begin(), open_.end());
  }

  /// Adds some of the parts that do not let a velocity pass, none of which is known. False: there are none.
  bool add_those_in_the_way(const Vector3d& v) {
    const std::size_t before = parts_.size();
    const double duration = flown_.ramp(v);
    threats_.near_until(v + options_.wind, horizon_.until, flown_.beside(v), [&](std::size_t i) {
      const Part& part = threats_[i];
      if (flown_.lets_pass(part, v, duration, horizon_.until)) return false;
      add(part);
      return parts_.size() >= before + kAtOnce;
    });
    return parts_.size() > before;
  }

  /// Adds some of the parts that block two velocities.
  void add_across(const Vector3d& v, const Vector3d& other) {
    const std::size_t before = parts_.size();
    threats_.near_until(v + options_.wind, horizon_.until, 0, [&](std::size_t i) {
      const Part& part = threats_[i];
      const auto hit = [&](const Vector3d& one) {
        return comes_nearer(part, one + options_.wind, horizon_, options_.margin);
      };
      if (part.exact() && !known_.contains(&part) && hit(other) && hit(v)) add(part);
      return parts_.size() >= before + kAtOnce;
    });
  }

  void add(const Part& part) {
    parts_.push_back(&part);
    known_.insert(&part);
    if (!part.exact()) most_ = std::min(most_, options_.most / 10);
    any_delimited_ = any_delimited_ || !part.exact();
  }

  Avoidance found(double lower) const {
    Avoidance answer;
    answer.lower = lower;
    if (!std::isfinite(upper_)) return answer;
    answer.status = AvoidStatus::free;
    answer.velocity = best_;
    answer.distance = upper_;
    answer.lower = std::min(lower, upper_);
    return answer;
  }

  /// Whether a part that is known does not let a velocity pass.
  bool is_known_to_be_blocked(const Vector3d& v) const {
    const double duration = flown_.ramp(v), beside = flown_.beside(v);
    return std::any_of(parts_.begin(), parts_.end(), [&](const Part* part) {
      return may_meet(part->apart, part->reach + beside, v + options_.wind - part->velocity,
                      horizon_.until) &&
             !flown_.lets_pass(*part, v, duration, horizon_.until);
    });
  }

  /// Proved: it can be flown and keeps the margin from all parts until the horizon, and so does the change to
  /// it. Parts in its way are known from then on.
  bool is_free(const Vector3d& v) {
    return flown_.can_fly(v) && !is_known_to_be_blocked(v) && !add_those_in_the_way(v);
  }

  int ray(const Vector3d& given) {
    Ray ray{given.normalized(), {}, {}};
    limit(ray);
    rays_.push_back(std::move(ray));
    look_along(rays_.back());
    return static_cast<int>(rays_.size()) - 1;
  }

  Vector3d at(const Ray& ray, double s) const { return wanted_ + s * ray.direction; }
  bool may_meet_at(const Part& part, const Vector3d& v) const {
    return may_meet(part.apart, part.reach, v + options_.wind - part.velocity, horizon_.until);
  }

  /// What a part blocks of a ray.
  const Blocked& blocked(Ray& ray, const Part& part) const {
    const auto [found, is_new] = ray.parts.try_emplace(&part);
    if (is_new) found->second = ask(ray, part);
    return found->second;
  }

  Blocked ask(const Ray& ray, const Part& part) const {
    // All velocities of the ray lead through one plane: of many small parts most are beside it.
    const Vector3d w = wanted_ + options_.wind - part.velocity, n = w.cross(ray.direction);
    const double rounded = 0x1p-40 * (part.apart.norm() + part.reach) * w.norm();
    if (std::abs(n.dot(part.apart)) > part.reach * n.norm() + rounded) return {};
    const Line line(wanted_ + options_.wind, ray.direction, {0, reach_});
    const OfVelocity question(part, horizon_, options_.margin, line);
    if (part.exact())
      if (const auto interval = interval_of(question)) return *interval;
    Search search(question, {0, reach_});
    search.run();
    const std::vector<Range> rest = not_free(search, {0, reach_});
    if (part.exact()) return {hull_of(search.hit), rest};
    Blocked result{hit_core(part, line), {}};
    const OfDelimited as_it_is(part, horizon_, options_.margin, line, 1e-4 * reach_);
    for (const Range& range : rest) {
      Search one(as_it_is, {range.from, range.to});
      one.run();
      const std::vector<Range> still = not_free(one, range);
      result.not_free.insert(result.not_free.end(), still.begin(), still.end());
    }
    return result;
  }

  /// The one interval of a convex part, from outside by Newton's method, its ends as near as the gap asks.
  /// Nothing where that does not end soon, as where they only touch.
  std::optional<Blocked> interval_of(const OfVelocity& question) const {
    const auto from = end_towards(question, 0, reach_);
    if (!from) return std::nullopt;
    if (from->free >= reach_) return Blocked{};
    const auto to = end_towards(question, reach_, 0);
    if (!to || !(to->hit >= from->hit)) return std::nullopt;
    return Blocked{Range{from->hit, to->hit}, {Range{from->free, to->free}}};
  }
  struct End {
    double free, hit;  // up to where it is free, and where it is hit
  };
  std::optional<End> end_towards(const OfVelocity& question, double start, double end) const {
    const double side = end > start ? 1 : -1;
    if (question.is_hit(start)) return End{start, start};
    double q = start, beyond = 0;
    for (int step = 0; step < 40; ++step) {
      const double next = q + side * beyond;
      if (side * (end - next) <= 0) return End{end, end};
      if (beyond > 0 && question.is_hit(next)) return End{q, next};
      const auto free = question.free_about(next);
      if (free && side * ((side > 0 ? free->from : free->to) - q) > 0) return std::nullopt;  // not joined
      const double reached = !free ? q : side > 0 ? free->to : free->from;
      if (side * (end - reached) <= 0) return End{end, end};
      const double least = kEnds * options_.gap * std::abs(reached) + 1e-13 * reach_;
      beyond = side * (reached - q) > least ? least : 4 * std::max(beyond, 0.5 * least);
      if (beyond > 1e3 * least) return std::nullopt;
      if (side * (reached - q) > 0) q = reached;
    }
    return std::nullopt;
  }

  /// All between the first and the last: of a convex set.
  static std::optional<Range> hull_of(const std::vector<Range>& hits) {
    std::optional<Range> hit;
    for (const Range& one : hits)
      hit = hit ? Range{std::min(hit->from, one.from), std::max(hit->to, one.to)} : one;
    return hit;
  }

  static std::vector<Range> not_free(Search& search, const Range& all) {
    std::vector<Range> result;
    double from = all.from;
    std::sort(search.free.begin(), search.free.end(),
              [](const Range& a, const Range& b) { return a.from < b.from; });
    for (const Range& free : search.free) {
      if (free.from > from) result.push_back({from, free.from});
      from = std::max(from, free.to);
    }
    if (from < all.to) result.push_back({from, all.to});
    return result;
  }

  /// Of bodies with delimiters: what meets the ellipsoids within them.
  std::optional<Range> hit_core(const Part& part, const Line& line) const {
    if (!part.core) return std::nullopt;
    const Part core{*part.core, {}, {}, {}, part.velocity, part.intruder, part.apart, part.reach};
    const OfVelocity question(core, horizon_, 0, line);
    Search search(question, {0, reach_});
    search.run();
    return hull_of(search.hit);
  }

  /// What of it cannot be flown.
  void limit(Ray& ray) const {
    const Vector3d& d = ray.direction;
    const double along = wanted_.dot(d);
    const auto crossing = [&](double speed) -> std::optional<Range> {
      const double root = along * along - wanted_.squaredNorm() + speed * speed;
      if (!(root > 0)) return std::nullopt;
      return Range{-along - std::sqrt(root), -along + std::sqrt(root)};
    };
    if (const auto slow = crossing(options_.speed.from); slow && slow->to > 0) {
      ray.slow = {std::max(slow->from, 0.0), slow->to};
      ray.limits.push_back(*ray.slow);
    }
    if (std::isfinite(options_.speed.to)) {
      const auto fast = crossing(options_.speed.to);
      if (!fast || fast->to <= 0) {
        ray.limits.push_back({0, reach_});
      } else {
        if (fast->from > 0) ray.limits.push_back({0, fast->from});
        ray.limits.push_back({fast->to, reach_});
      }
    }
    for (const double side : {-1.0, 1.0}) {
      const double most = side > 0 ? options_.climb.to : -options_.climb.from;
      if (std::isinf(most)) continue;
      const double here = side * wanted_.z() - most, slope = side * d.z();  // positive: too much
      if (here > 0) ray.limits.push_back({0, slope < 0 ? -here / slope : reach_});
      if (here <= 0 && slope > 0) ray.limits.push_back({-here / slope, reach_});
    }
  }

  /// For a candidate: past all that is known to block, then asked of everything.
  void look_along(Ray& ray) {
    double s = 0;
    bool tried = false;  // a gap of one value here
    for (int step = 0; step < kMostSteps && s < std::min(reach_, upper_); ++step) {
      const double here = s;
      const auto past = [&](const Range& range) {
        const bool inside = range.from <= s * (tried ? 1 + 1e-6 : 1 - kOneValue) && s < range.to;
        if (inside) s = range.to;
      };
      for (const Range& range : ray.limits) past(range);
      for (const Part* part : parts_)
        if (may_meet_at(*part, at(ray, s)))
          for (const Range& range : blocked(ray, *part).not_free) past(range);
      if (s > here) {
        tried = false;
        continue;
      }
      const std::size_t known = parts_.size();
      if (look_from(ray.direction, s)) return;
      if (parts_.size() > known) continue;
      if (tried) return;
      tried = true;
    }
  }

  /// Whether a velocity of the ray is a candidate; then it is the one to beat.
  bool take(const Vector3d& d, double s) {
    const Vector3d v = wanted_ + s * d;
    const double distance = (v - wanted_).norm();
    if (!(distance < upper_) || !is_free(v)) return false;
    upper_ = distance;
    best_ = v;
    return true;
  }

  /// Of values that nothing known blocks at once: the first, a little beyond the end, where rounding cannot
  /// bring it back; where the way to it is blocked, farther ones.
  bool look_from(const Vector3d& d, double from) {
    const std::size_t known = parts_.size();
    const double most = any_delimited_ ? 1e-2 : 1e-6;  // those are undecided for a while
    for (double beyond = 0; beyond < most; beyond = std::max(30 * beyond, 1e-13)) {
      if (take(d, from * (1 + beyond))) return true;
      if (parts_.size() > known || from == 0) break;
    }
    if (parts_.size() > known || (options_.lateral == 0 && options_.longitudinal == 0)) return false;
    double refused = from;
    for (const double part : {1.0 / 256, 1.0 / 64, 1.0 / 16, 0.25, 0.5, 0.75}) {
      double taken = from + part * (reach_ - from);
      if (!(taken < upper_)) return false;
      if (!take(d, taken)) {
        refused = taken;
        continue;
      }
      for (int step = 0; step < 8; ++step) {
        const double between = 0.5 * (refused + taken);
        (take(d, between) ? taken : refused) = between;
      }
      return true;
    }
    return false;
  }

  int between(int from, int to) {
    const auto key = std::minmax(from, to);
    const auto known = middles_.find(key);
    if (known != middles_.end()) return known->second;
    return middles_[key] = ray(direction(from) + direction(to));
  }

  /// Below which no safe velocity is in a triangle of rays; infinite where none is.
  double bound_of(const std::array<int, 3>& t) {
    const Vector3d &a = direction(t[0]), &b = direction(t[1]), &c = direction(t[2]);
    const Vector3d across = (b - a).cross(c - a);
    // Of a point between the tips |p|^2 = 1 - sum of l_i l_j d_ij^2, which is at most a third of the longest
    // d^2; or of their plane.
    const double widest = std::max({(b - a).squaredNorm(), (c - a).squaredNorm(), (c - b).squaredNorm()});
    double height = std::sqrt(std::max(0.0, 1 - widest / 3));
    if (widest > kTiny * kTiny) height = std::max(height, std::abs(across.dot(a)) / across.norm());
    height *= 1 - 1e-12;
    double end = too_much_before(t);
    const auto extend = [&](const std::array<std::optional<Range>, 3>& hits) {
      Range all{0, kInfinity};
      for (const auto& hit : hits) {
        if (!hit) return false;
        all = {std::max(all.from, hit->from), std::min(all.to, hit->to)};
      }
      if (!(all.from <= end && all.to > end)) return false;
      end = all.to;
      return true;
    };
    const auto of = [&](int i) -> Ray& {
      return rays_[static_cast<std::size_t>(t[static_cast<std::size_t>(i)])];
    };
    for (int step = 0; step < kMostSteps; ++step) {
      if (all_beyond(t, end)) return kInfinity;
      if (extend({of(0).slow, of(1).slow, of(2).slow})) continue;
      // What blocks all between the rays here blocks the middle too.
      const Vector3d v = wanted_ + (end * (1 + 1e-9) + 1e-13 * reach_) / 3 * (a + b + c);
      bool any = false;
      for (const Part* part : parts_) {
        if (!may_meet_at(*part, v)) continue;
        std::array<std::optional<Range>, 3> hits;
        for (int i = 0; i < 3; ++i)
          if (hits[static_cast<std::size_t>(i)] = blocked(of(i), *part).hit;
              !hits[static_cast<std::size_t>(i)])
            break;
        any = extend(hits) || any;
      }
      if (any) continue;
      // Nothing known: of everything, where it may be the answer, or else what reaches well across the end.
      if (!((v - wanted_).norm() < upper_)) break;
      const std::size_t known = parts_.size();
      if (take(v - wanted_, 1)) break;
      if (parts_.size() == known && threats_.any_trees())
        add_across(v, wanted_ + end * (1 - 0.25 * std::sqrt(widest)) / 3 * (a + b + c));
      if (parts_.size() == known) break;
    }
    return end * height;
  }

  /// Where the wanted velocity itself is beyond a limit: how far that holds between the rays.
  double too_much_before(const std::array<int, 3>& t) const {
    double most = 0;
    const auto half_space = [&](const Vector3d& n, double limit) {
      const double here = n.dot(wanted_) - limit;
      if (!(here > 0)) return;
      double end = kInfinity;
      for (const int r : t)
        if (const double slope = n.dot(direction(r)); slope < 0) end = std::min(end, -here / slope);
      most = std::max(most, end * (1 - 1e-12));
    };
    half_space(Vector3d::UnitZ(), options_.climb.to);
    half_space(-Vector3d::UnitZ(), -options_.climb.from);
    if (wanted_.norm() > options_.speed.to) half_space(wanted_.normalized(), options_.speed.to);
    return most;
  }

  /// Whether all at least `end` along the rays is beyond what can be flown: a plane that says so of the three
  /// places, and that no ray comes back through.
  bool all_beyond(const std::array<int, 3>& t, double end) const {
    const auto beyond = [&](const Vector3d& n, double limit) {
      for (const int r : t)
        if (!(n.dot(wanted_ + end * direction(r)) > limit * (1 + 1e-12) && n.dot(direction(r)) >= 0))
          return false;
      return true;
    };
    if (std::isfinite(options_.climb.to) && beyond(Vector3d::UnitZ(), options_.climb.to)) return true;
    if (std::isfinite(options_.climb.from) && beyond(-Vector3d::UnitZ(), -options_.climb.from)) return true;
    if (!std::isfinite(options_.speed.to)) return false;
    Vector3d middle = Vector3d::Zero();
    for (const int r : t) middle += direction(r) / 3;
    const Vector3d at = wanted_ + end * middle,
                   plane = (direction(t[1]) - direction(t[0])).cross(direction(t[2]) - direction(t[0]));
    const Vector3d facing = plane.dot(middle) > 0 ? plane : Vector3d(-plane);
    return (at.norm() > 0 && beyond(at.normalized(), options_.speed.to)) ||
           beyond(facing.normalized(), options_.speed.to);
  }

  static constexpr double kTiny = 1e-5;       // rad, a triangle that is not divided
  static constexpr double kOneValue = 1e-13;  // a gap between what cannot be flown may be one value
  static constexpr double kEnds = 1e-4;       // of the gap, how near to each other the sides of an end are
  static constexpr std::size_t kAtOnce = 4;   // parts that are added
  static constexpr int kMostSteps = 500;      // of a chain or along a ray

  Flown flown_;
  Vector3d wanted_;
  Threats& threats_;
  const AvoidOptions& options_;
  Horizon horizon_;
  double gap_;        // at which it ends
  std::size_t most_;  // rays
  bool any_delimited_ = false;
  std::vector<const Part*> parts_;  // those known
  std::unordered_set<const Part*> known_;
  double reach_ = 0, upper_ = kInfinity;
  Vector3d best_ = Vector3d::Zero();
  std::deque<Ray> rays_;
  std::vector<Triangle> open_;  // a heap
  std::map<std::pair<int, int>, int> middles_;
};

void require(const Vector3d& x, const char* field) {
  for (int i = 0; i < 3; ++i)
    if (!std::isfinite(x(i)))
      throw InputError(std::string(field) + "[" + std::to_string(i) + "]", to_text(x(i)),
                       "a finite number (m/s)");
}

void require(const Vector3d& velocity, const Vector3d& wanted, const AvoidOptions& options) {
  require(velocity, "velocity");
  require(wanted, "wanted");
  require(options.wind, "wind");
  const auto positive = [](double x, const char* field, const char* right) {
    if (!(x > 0 && std::isfinite(x))) throw InputError(field, to_text(x), right);
  };
  const auto not_negative = [](double x, const char* field, const char* right) {
    if (!(x >= 0 && std::isfinite(x))) throw InputError(field, to_text(x), right);
  };
  positive(options.until, "until", "positive and finite (seconds)");
  positive(options.gap, "gap", "positive");
  not_negative(options.margin, "margin", "0 or more (metres)");
  not_negative(options.lateral, "lateral", "0 or more (m/s^2)");
  not_negative(options.longitudinal, "longitudinal", "0 or more (m/s^2)");
  if ((options.lateral > 0) != (options.longitudinal > 0))
    throw InputError(options.lateral > 0 ? "longitudinal" : "lateral", "0",
                     "positive, as the other is (m/s^2)");
  if (!(options.speed.from >= 0 && options.speed.to >= options.speed.from))
    throw InputError("speed", "[" + to_text(options.speed.from) + ", " + to_text(options.speed.to) + "]",
                     "two numbers >= 0, the smaller one first (m/s)");
  if (!(options.climb.to >= options.climb.from))
    throw InputError("climb", "[" + to_text(options.climb.from) + ", " + to_text(options.climb.to) + "]",
                     "two numbers, the smaller one first (m/s)");
}

/// A velocity that can be flown, near the one that is wanted.
Vector3d nearly(const Vector3d& wanted, const AvoidOptions& options) {
  const double speed = std::clamp(wanted.norm(), options.speed.from, options.speed.to);
  const double least = std::max(options.climb.from, -speed),
               most = std::max(least, std::min(options.climb.to, speed));
  const double climb = std::clamp(wanted.z(), least, most);
  const double across = std::hypot(wanted.x(), wanted.y()),
               level = std::sqrt(std::max(0.0, speed * speed - climb * climb));
  return across > 0 ? Vector3d(wanted.x() * level / across, wanted.y() * level / across, climb)
                    : Vector3d(level, 0, climb);
}

}  // namespace

const char* to_string(AvoidStatus status) {
  switch (status) {
    case AvoidStatus::free:
      return "free";
    case AvoidStatus::nothing_safe:
      return "nothing_safe";
    case AvoidStatus::not_found:
      break;
  }
  return "not_found";
}

Avoidance avoid(const Placed& agent, const Vector3d& velocity, const Vector3d& wanted,
                std::span<const Intruder> intruders, const AvoidOptions& options) {
  require(velocity, wanted, options);
  for (std::size_t i = 0; i < intruders.size(); ++i)
    require(intruders[i].velocity, ("intruders[" + std::to_string(i) + "].velocity").c_str());
  Threats threats(agent, intruders, options.margin);
  Avoidance answer = Search3(velocity, wanted, threats, options, options.until).run();
  answer.safe_until = options.until;
  if (answer.status == AvoidStatus::free) return answer;
  answer.safe_until = 0;
  answer.velocity = nearly(wanted, options);
  answer.distance = (answer.velocity - wanted).norm();
  Longest(velocity, wanted, threats, options).look(answer);
  if (answer.status != AvoidStatus::free) answer.first = first_met(threats, answer.velocity + options.wind);
  return answer;
}

}  // namespace vericone::guidance
