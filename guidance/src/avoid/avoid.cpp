// SPDX-License-Identifier: BSD-3-Clause
//
// Rays and triangles of rays from the wanted velocity. Along a ray each convex part blocks one interval;
// where the first gap is, there is a candidate. Between three rays all that the hull of six points of one
// part holds is blocked; where the chain of those ends, nothing safe is nearer. Best first on that bound.
#include <vericone/guidance/avoid.h>

#include <vericone/cones/pair.h>
#include <vericone/geometry/error.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "bands/at_once.h"
#include "bands/delimited.h"
#include "bands/threats.h"

namespace vericone::guidance {

using namespace banding;

namespace {

/// Along one ray what is blocked: by part, proved, none where a part leaves it alone; first what is too slow.
/// `not_free`: all together, what is not known to be free.
struct Ray {
  Vector3d direction;
  std::vector<std::optional<Range>> hit;
  std::vector<Range> not_free;
};

struct Triangle {
  double bound;             // no safe velocity in it is nearer
  std::array<int, 3> rays;  // counter-clockwise
  bool operator<(const Triangle& other) const { return bound > other.bound; }  // the nearest on top
};

/// Of some parts alone, those that were in the way of an answer: what they leave is nearer than what all
/// leave, so its bound is one. What is found is asked of all, and those in its way are added.
class Search3 {
 public:
  Search3(const Vector3d& velocity, const Vector3d& wanted, Threats& threats, const AvoidOptions& options,
          double until, bool any = false)
      : velocity_(velocity),
        wanted_(wanted),
        threats_(threats),
        options_(options),
        horizon_{0, until},
        gap_(any ? 1e9 : options.gap),
        most_(any ? options.most / 4 : options.most) {}

  Avoidance run() {
    add_those_in_the_way(wanted_);
    if (parts_.empty() && can_fly(wanted_)) {
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
    while (true) {
      refine();
      if (std::isinf(upper_)) break;
      const double lower = open_.empty() ? upper_ / (1 + gap_) : open_.front().bound;
      if (!add_those_in_the_way(best_)) return found(lower);
    }
    Avoidance none;
    if (open_.empty()) none.status = AvoidStatus::nothing_safe;
    none.lower = open_.empty() ? kInfinity : open_.front().bound;
    return none;
  }

 private:
  const Vector3d& direction(int ray) const { return rays_[ray].direction; }

  /// Until the nearest candidate is nearly as near as the bound, or as many rays were looked along as may be.
  void refine() {
    while (!open_.empty() && !(upper_ <= open_.front().bound * (1 + gap_)) && rays_.size() < most_) {
      const std::array<int, 3> t = open_.front().rays;
      // Halve the longest side.
      const auto side = [&](int i) {
        return (direction(t[(i + 1) % 3]) - direction(t[(i + 2) % 3])).squaredNorm();
      };
      int longest = 0;
      for (int i = 1; i < 3; ++i)
        if (side(i) > side(longest)) longest = i;
      if (side(longest) < kTiny * kTiny) return;  // where parts only touch: no more is proved
      std::pop_heap(open_.begin(), open_.end());
      open_.pop_back();
      const int apex = t[longest], from = t[(longest + 1) % 3], to = t[(longest + 2) % 3],
                half = between(from, to);
      open({apex, from, half});
      open({apex, half, to});
    }
  }

  void open(const std::array<int, 3>& rays) {
    const double bound = bound_of(rays);
    if (std::isinf(bound)) return;
    open_.push_back({bound, rays});
    std::push_heap(open_.begin(), open_.end());
  }

  /// Adds the parts that do not let a velocity pass; what was found without them counts no more. False: there
  /// are none.
  bool add_those_in_the_way(const Vector3d& v) {
    const std::size_t before = parts_.size();
    const double duration = ramp(v);
    threats_.near(v + options_.wind, horizon_.until, 0.5 * duration * (v - velocity_).norm(),
                  [&](std::size_t i) {
                    const Part* part = &threats_[i];
                    if (!lets_pass(*part, v, duration)) parts_.push_back(part);
                  });
    if (parts_.size() == before) return false;
    any_delimited_ =
        std::any_of(parts_.begin(), parts_.end(), [](const Part* part) { return !part->exact(); });
    if (any_delimited_) most_ = std::min(most_, options_.most / 10);
    upper_ = kInfinity;
    for (Ray& ray : rays_) {
      for (std::size_t i = before; i < parts_.size(); ++i) block(ray, *parts_[i]);
      look_along(ray);
    }
    std::vector<Triangle> again;
    std::swap(again, open_);
    for (const Triangle& triangle : again) open(triangle.rays);
    return true;
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

  /// To rounding: a range may be one value.
  bool can_fly(const Vector3d& v) const {
    constexpr double kRounded = 1e-12;
    const double speed = v.norm(), slack = kRounded * speed;
    return speed >= options_.speed.from - slack && speed <= options_.speed.to + slack &&
           v.z() >= options_.climb.from - slack && v.z() <= options_.climb.to + slack;
  }

  /// Proved: it keeps the margin from all parts so far until the horizon, and so does the change to it.
  bool is_free(const Vector3d& v) const {
    const double duration = ramp(v);
    return can_fly(v) && std::all_of(parts_.begin(), parts_.end(),
                                     [&](const Part* part) { return lets_pass(*part, v, duration); });
  }

  /// `duration`: s, of the change of velocity.
  bool lets_pass(const Part& part, const Vector3d& v, double duration) const {
    const Vector3d ground = v + options_.wind;
    auto half = safe(part, ground, horizon_, options_.margin);
    if (!half) {
      const double beside = options_.margin + 0.5 * duration * (v - velocity_).norm() * (1 + 1e-12);
      return part.truth && duration <= horizon_.until &&
             AsTheyAre(*part.truth).apart(ground, part.velocity, horizon_, beside);
    }
    if (duration == 0) return true;
    // The ramp is behind the straight flight by at most half its duration, along the change.
    if (!(duration <= horizon_.until)) return false;
    const double behind = 0.5 * duration * std::max(0.0, -half->normal.dot(v - velocity_)),
                 along = std::max(0.0, horizon_.until * half->normal.dot(ground - part.velocity));
    const double slack =
        0x1p-46 * half->normal.norm() *
        (horizon_.until * (ground - part.velocity).norm() + duration * (v - velocity_).norm());
    if (along + behind + slack < half->room) return true;
    const Vector3d late = -0.5 * duration * (v - velocity_);
    // Another plane, of both straight ways.
    for (const Vector3d& shift : {Vector3d(0.5 * late), late}) {
      const auto n = part.pair.normal_along(shift, horizon_.until * (ground - part.velocity) + shift);
      if (!n) return false;
      const double room = part.pair.gap(*n) - options_.margin * n->norm() * (1 + 0x1p-48);
      if (std::max(0.0, n->dot(late)) + std::max(0.0, horizon_.until * n->dot(ground - part.velocity)) +
              slack <
          room)
        return true;
    }
    return false;
  }
  double ramp(const Vector3d& v) const {
    if (options_.lateral == 0 && options_.longitudinal == 0) return 0;
    const Vector3d change = v - velocity_;
    const double speed = velocity_.norm();
    const double along = speed > 0 ? std::abs(change.dot(velocity_)) / speed : change.norm();
    const double across = std::sqrt(std::max(0.0, change.squaredNorm() - along * along));
    const auto duration = [](double of, double by) { return of <= 1e-12 ? 0 : by > 0 ? of / by : 0; };
    return std::max(duration(along, options_.longitudinal), duration(across, options_.lateral));
  }

  int ray(const Vector3d& given) {
    Ray ray{given.normalized(), {}, {}};
    limit(ray);
    for (const Part* part : parts_) block(ray, *part);
    look_along(ray);
    rays_.push_back(std::move(ray));
    return static_cast<int>(rays_.size()) - 1;
  }

  /// What a part blocks of it.
  void block(Ray& ray, const Part& part) const {
    // All velocities of the ray lead through one plane: of many small parts most are beside it.
    const Vector3d w = wanted_ + options_.wind - part.velocity, n = w.cross(ray.direction);
    const double rounded = 0x1p-40 * (part.apart.norm() + part.reach) * w.norm();
    if (std::abs(n.dot(part.apart)) > part.reach * n.norm() + rounded) {
      ray.hit.push_back(std::nullopt);
      return;
    }
    const Line line(wanted_ + options_.wind, ray.direction, {0, reach_});
    const OfVelocity question(part, horizon_, options_.margin, line);
    Search search(question, {0, reach_});
    search.run();
    const std::vector<Range> blocked = not_free(search, {0, reach_});
    if (part.exact()) {
      ray.hit.push_back(hull_of(search.hit));
      ray.not_free.insert(ray.not_free.end(), blocked.begin(), blocked.end());
      return;
    }
    ray.hit.push_back(hit_core(part, line));
    const OfDelimited as_it_is(part, horizon_, options_.margin, line, 1e-4 * reach_);
    for (const Range& range : blocked) {
      Search one(as_it_is, {range.from, range.to});
      one.run();
      const std::vector<Range> still = not_free(one, range);
      ray.not_free.insert(ray.not_free.end(), still.begin(), still.end());
    }
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
    std::optional<Range> slow = crossing(options_.speed.from);
    if (slow && slow->to > 0) {
      ray.not_free.push_back({std::max(slow->from, 0.0), slow->to});
      ray.hit.push_back(ray.not_free.back());
    } else {
      ray.hit.push_back(std::nullopt);
    }
    if (std::isfinite(options_.speed.to)) {
      const auto fast = crossing(options_.speed.to);
      if (!fast || fast->to <= 0) {
        ray.not_free.push_back({0, reach_});
      } else {
        if (fast->from > 0) ray.not_free.push_back({0, fast->from});
        ray.not_free.push_back({fast->to, reach_});
      }
    }
    for (const double side : {-1.0, 1.0}) {
      const double most = side > 0 ? options_.climb.to : -options_.climb.from;
      if (std::isinf(most)) continue;
      const double here = side * wanted_.z() - most, slope = side * d.z();  // positive: too much
      if (here > 0) ray.not_free.push_back({0, slope < 0 ? -here / slope : reach_});
      if (here <= 0 && slope > 0) ray.not_free.push_back({-here / slope, reach_});
    }
  }

  /// For a candidate.
  void look_along(Ray& ray) {
    std::sort(ray.not_free.begin(), ray.not_free.end(),
              [](const Range& a, const Range& b) { return a.from < b.from; });
    double s = 0;
    for (const Range& range : ray.not_free) {
      if (range.from >= s * (1 - kOneValue)) look_between(ray.direction, s, range.from);
      s = std::max(s, range.to);
    }
    if (s < reach_) look_between(ray.direction, s, reach_);
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

  /// Of values that nothing blocks at once: the first, a little beyond the end, where rounding cannot bring
  /// it back; where the way to it is blocked, farther ones.
  void look_between(const Vector3d& d, double from, double to) {
    const double most = any_delimited_ ? 1e-2 : 1e-6;  // those are undecided for a while
    for (double beyond = 0; beyond < most; beyond = std::max(30 * beyond, 1e-13))
      if (const double s = from * (1 + beyond); s < std::max(to, from * (1 + kOneValue)) && take(d, s))
        return;
    if (options_.lateral == 0 && options_.longitudinal == 0) return;
    double refused = from;
    for (const double part : {1.0 / 64, 1.0 / 16, 0.25, 0.5, 0.75}) {
      double taken = from + part * (to - from);
      if (!(taken < upper_)) return;
      if (!take(d, taken)) {
        refused = taken;
        continue;
      }
      for (int step = 0; step < 8; ++step) {
        const double between = 0.5 * (refused + taken);
        (take(d, between) ? taken : refused) = between;
      }
      return;
    }
  }

  int between(int from, int to) {
    const auto key = std::minmax(from, to);
    const auto known = middles_.find(key);
    if (known != middles_.end()) return known->second;
    return middles_[key] = ray(direction(from) + direction(to));
  }

  /// Below which no safe velocity is in a triangle of rays; infinite where none is.
  double bound_of(const std::array<int, 3>& t) const {
    const Vector3d &a = direction(t[0]), &b = direction(t[1]), &c = direction(t[2]);
    const Vector3d across = (b - a).cross(c - a);
    // Of a point between the tips |p|^2 = 1 - sum of l_i l_j d_ij^2, which is at most a third of the longest
    // d^2; or of their plane.
    const double widest = std::max({(b - a).squaredNorm(), (c - a).squaredNorm(), (c - b).squaredNorm()});
    double height = std::sqrt(std::max(0.0, 1 - widest / 3));
    if (widest > kTiny * kTiny) height = std::max(height, std::abs(across.dot(a)) / across.norm());
    height *= 1 - 1e-12;
    std::vector<Range> chain;
    for (std::size_t i = 0; i < rays_[t[0]].hit.size(); ++i) {
      Range all{0, kInfinity};
      for (const int r : t) {
        const auto& hit = rays_[r].hit[i];
        if (!hit) all = {1, 0};
        if (hit) all = {std::max(all.from, hit->from), std::min(all.to, hit->to)};
      }
      if (all.from < all.to) chain.push_back(all);
    }
    std::sort(chain.begin(), chain.end(), [](const Range& x, const Range& y) { return x.from < y.from; });
    double end = too_much_before(t);
    for (const Range& range : chain)
      if (range.from <= end) end = std::max(end, range.to);
    if (all_beyond(t, end)) return kInfinity;
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

  Vector3d velocity_, wanted_;
  Threats& threats_;
  const AvoidOptions& options_;
  Horizon horizon_;
  double gap_;        // at which it ends
  std::size_t most_;  // rays
  bool any_delimited_ = false;
  std::vector<const Part*> parts_;  // those that are looked at
  double reach_ = 0, upper_ = kInfinity;
  Vector3d best_ = Vector3d::Zero();
  std::vector<Ray> rays_;
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

/// What is met first with a velocity over ground.
std::optional<Avoidance::First> first_met(Threats& threats, const Vector3d& ground) {
  std::optional<Avoidance::First> first;
  threats.near(ground, kInfinity, 0, [&](std::size_t i) {
    const auto contact = threats[i].as_it_is().contact(ground, threats[i].velocity);
    if (contact && !(first && first->time <= contact->earliest))
      first = {threats[i].intruder, contact->earliest};
  });
  return first;
}

/// Where nothing is safe for as long as was asked: for how long something is. What blocks until a time blocks
/// until every later one, so halving brings together a time until which a velocity is safe and one until
/// which none is.
class Shorter {
 public:
  Shorter(const Vector3d& velocity, const Vector3d& wanted, Threats& threats, const AvoidOptions& options)
      : velocity_(velocity), wanted_(wanted), threats_(threats), options_(options) {}

  /// `answer`: of the whole time, not free.
  void look(Avoidance& answer) {
    note(options_.until, answer);
    if (none_now()) {
      latest_ = 0;
    } else {
      // Half as long, and so on, until one is safe.
      for (double until = 0.5 * options_.until; safe_ == 0 && until > 1e-3 * options_.until; until *= 0.5)
        ask(until, answer);
      for (int step = 0; safe_ > 0 && step < 12; ++step) {
        // Between what is safe and what was not shown to be either; between that and where none is.
        const double low = (tried_ ? tried_->from : latest_) - safe_,
                     high = tried_ && std::isfinite(latest_) ? latest_ - tried_->to : 0;
        if (!(std::max(low, high) > options_.gap * safe_)) break;
        ask(low >= high ? safe_ + 0.5 * low : tried_->to + 0.5 * high, answer);
      }
    }
    answer.safe_until = safe_;
    if (safe_ == options_.until) {  // found for less, and good for all
      answer.status = AvoidStatus::free;
      return;
    }
    answer.latest = latest_;
    if (std::isinf(latest_)) return;
    answer.status = AvoidStatus::nothing_safe;
    answer.lower = kInfinity;
  }

 private:
  /// Whether some body is too near already.
  bool none_now() {
    bool none = false;
    threats_.near(Vector3d::Zero(), 0, 0, [&](std::size_t i) {
      const Part& part = threats_[i];
      none = none || (part.exact() && part.swollen().relation() == Relation::overlapping);
    });
    return none;
  }

  void ask(double until, Avoidance& answer) {
    const Avoidance found = Search3(velocity_, wanted_, threats_, options_, until, true).run();
    note(until, found);
    if (found.status != AvoidStatus::free) return;
    answer.velocity = found.velocity;
    answer.distance = found.distance;
  }

  void note(double until, const Avoidance& found) {
    if (found.status == AvoidStatus::free) {
      safe_ = until;
      // Without a margin and a way there, until its first contact.
      if (options_.margin == 0 && options_.lateral == 0) {
        const auto first = first_met(threats_, found.velocity + options_.wind);
        safe_ = std::max(safe_, std::min(first ? first->time : kInfinity, options_.until));
      }
    } else if (found.status == AvoidStatus::nothing_safe) {
      latest_ = until;
    } else {
      tried_ =
          tried_ ? Range{std::min(tried_->from, until), std::max(tried_->to, until)} : Range{until, until};
    }
    if (!tried_) return;
    *tried_ = {std::max(tried_->from, safe_), std::min(tried_->to, latest_)};
    if (tried_->from >= latest_ || tried_->to <= safe_) tried_.reset();
  }

  Vector3d velocity_, wanted_;
  Threats& threats_;
  const AvoidOptions& options_;
  double safe_ = 0, latest_ = kInfinity;  // s: until when one is, and none is
  std::optional<Range> tried_;            // s: asked in vain
};

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
  Shorter(velocity, wanted, threats, options).look(answer);
  if (answer.status != AvoidStatus::free) answer.first = first_met(threats, answer.velocity + options.wind);
  return answer;
}

}  // namespace vericone::guidance
