// SPDX-License-Identifier: BSD-3-Clause
//
// Rays and triangles of rays from the wanted velocity. Along a ray each convex part blocks one interval;
// where the first gap is, there is a candidate. Between three rays all that the hull of six points of one
// part holds is blocked; where the chain of those ends, nothing safe is nearer. Best first on that bound.
#include <vericone/guidance/avoid.h>

#include <vericone/cones/pair.h>
#include <vericone/geometry/error.h>
#include <array>
#include <cmath>
#include <map>
#include <queue>
#include <string>
#include <vector>

#include "bands/at_once.h"
#include "bands/parts.h"

namespace vericone::guidance {

using namespace banding;

namespace {

/// A convex part of the agent and one of an intruder. `inner`: the agent's with less than the margin around
/// it; what meets that comes nearer than the margin.
struct Part {
  Pair pair;
  std::optional<Pair> inner;
  Vector3d velocity;
  std::size_t intruder;
  bool exact;

  const Pair& swollen() const { return inner ? *inner : pair; }
};

/// A body that the agent and a ball of that radius around each of its points contain.
Placed swollen(const Placed& body, double radius) {
  if (const auto* quadric = body.body.quadric()) {
    const Ellipsoid& e = quadric->ellipsoid();
    Eigen::Matrix3d axes = e.axis_directions();
    if (axes.determinant() < 0) axes.col(0) *= -1;
    const Vector3d longer = e.semi_axes() + Vector3d::Constant(radius * (1 - 1e-12));
    return {Ellipsoid::from_axes(e.center(), longer, axes), body.pose};
  }
  std::vector<Vector3d> points;
  for (const Vector3d& x : body.body.hull()->points())
    for (int k = 0; k < 3; ++k)
      for (const double side : {-1.0, 1.0})
        points.push_back(x + side * radius * (1 - 1e-12) * Vector3d::Unit(k));
  return {HullBody(std::move(points)), body.pose};
}

/// A ray from the wanted velocity against a part.
class OnRay : public Question {
 public:
  OnRay(const Part& part, const Line& ray, const Horizon& horizon, double margin)
      : part_(part), ray_(ray), horizon_(horizon), margin_(margin) {}

  std::optional<Range> free_about(double q) const override {
    const auto half = safe(part_, ray_.velocity(q), horizon_, margin_);
    if (!half) return std::nullopt;
    const double most = half->most(horizon_), along = half->normal.dot(part_.velocity);
    return ray_.about(q, half->normal, most + along,
                      std::abs(most) + half->normal.cwiseAbs().dot(part_.velocity.cwiseAbs()));
  }
  bool is_hit(double q) const override {
    if (!part_.exact) return false;
    const Vector3d v = ray_.velocity(q);
    return meets(part_.swollen().verdict(v, part_.velocity, horizon_)) ||
           (margin_ > 0 && nearest_by(part_, v, horizon_.until).most < margin_);
  }
  bool all_hit(double, double) const override { return part_.exact; }

  /// What one plane proves to keep the margin, with this velocity over ground in it.
  static std::optional<SafeHalfSpace> safe(const Part& part, const Vector3d& velocity, const Horizon& horizon,
                                           double margin) {
    auto half = part.swollen().safe_half_space(velocity, part.velocity, horizon);
    if (!half || margin == 0) return half;
    half->room = part.pair.gap(half->normal) - margin * half->normal.norm() * (1 + 0x1p-48);
    const Vector3d w = velocity - part.velocity;
    if (half->room > 0 && half->normal.dot(w) < half->most(horizon) * (1 - 0x1p-48)) return half;
    // Where the swollen body is less than the margin, the plane where they are nearest leaves more.
    const Miss nearest = nearest_by(part, velocity, horizon.until);
    if (!(nearest.least > margin)) return std::nullopt;
    const Vector3d& n = nearest.normal;
    *half = {n, part.pair.gap(n) - margin * n.norm() * (1 + 0x1p-48)};
    const double slack = 0x1p-48 * n.norm() * w.norm();
    return half->room > 0 && n.dot(w) + slack < half->most(horizon) ? half : std::nullopt;
  }

  /// How near they come by then.
  static Miss nearest_by(const Part& part, const Vector3d& velocity, double until) {
    Miss miss = part.pair.miss(velocity, part.velocity);
    if (miss.time <= until) return miss;
    Placed then = part.pair.agent();
    then.pose.position += until * (velocity - part.velocity);
    return Pair(then, part.pair.obstacle()).miss(Vector3d::Zero(), Vector3d::Zero());
  }

 private:
  const Part& part_;
  const Line& ray_;
  Horizon horizon_;
  double margin_;
};

/// Along one ray, by part, what is blocked, proved; none where a part leaves it alone. Last: what is too
/// slow.
struct Ray {
  Vector3d direction;
  std::vector<std::optional<Range>> hit;
};

struct Triangle {
  double bound;             // no safe velocity in it is nearer
  std::array<int, 3> rays;  // counter-clockwise
};
struct Farther {
  bool operator()(const Triangle& a, const Triangle& b) const { return a.bound > b.bound; }
};

class Search3 {
 public:
  Search3(const Vector3d& velocity, const Vector3d& wanted, const std::vector<Part>& parts,
          const AvoidOptions& options, double until)
      : velocity_(velocity), wanted_(wanted), parts_(parts), options_(options), horizon_{0, until} {}

  Avoidance run() {
    if (is_free(wanted_)) {
      best_ = wanted_;
      upper_ = 0;
      return found(0);
    }
    // As far as can be flown; without a limit, as far as one would look.
    double fastest = wanted_.norm();
    for (const Part& part : parts_) fastest = std::max(fastest, part.velocity.norm());
    reach_ =
        1.01 * (wanted_.norm() + (std::isfinite(options_.speed.to) ? options_.speed.to : 4 * fastest)) + 1e-3;
    for (const Part& part : parts_) {
      const auto half = OnRay::safe(part, wanted_ + options_.wind, horizon_, options_.margin);
      away_.push_back(
          !half ? 0
                : (half->most(horizon_) - half->normal.dot(wanted_ + options_.wind - part.velocity)) /
                      half->normal.norm() * (1 - 1e-9));
    }
    static constexpr int kFaces[8][3] = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                         {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    for (int k = 0; k < 6; ++k) ray(Vector3d::Unit(k / 2) * (k % 2 == 0 ? 1 : -1));
    std::priority_queue<Triangle, std::vector<Triangle>, Farther> open;
    const auto add = [&](const std::array<int, 3>& rays) {
      const double bound = bound_of(rays);
      if (std::isfinite(bound)) open.push({bound, rays});
    };
    for (const auto& face : kFaces) add({face[0], face[1], face[2]});
    while (!open.empty()) {
      const Triangle nearest = open.top();
      if (upper_ <= nearest.bound * (1 + options_.gap)) return found(nearest.bound);
      if (rays_.size() >= options_.most) return found(nearest.bound);
      open.pop();
      // Halve the longest side.
      std::array<int, 3> t = nearest.rays;
      const auto side = [&](int i) {
        return (direction(t[(i + 1) % 3]) - direction(t[(i + 2) % 3])).squaredNorm();
      };
      int longest = 0;
      for (int i = 1; i < 3; ++i)
        if (side(i) > side(longest)) longest = i;
      const int apex = t[longest], from = t[(longest + 1) % 3], to = t[(longest + 2) % 3],
                half = between(from, to);
      add({apex, from, half});
      add({apex, half, to});
    }
    if (std::isfinite(upper_)) return found(upper_ / (1 + options_.gap));
    Avoidance none;
    none.status = AvoidStatus::nothing_safe;
    none.lower = kInfinity;
    return none;
  }

 private:
  const Vector3d& direction(int ray) const { return rays_[ray].direction; }

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

  /// Proved: it keeps the margin from all until the horizon, and so does the change to it.
  bool is_free(const Vector3d& v) const {
    if (!can_fly(v)) return false;
    const Vector3d ground = v + options_.wind;
    const double duration = ramp(v);
    for (const Part& part : parts_) {
      auto half = OnRay::safe(part, ground, horizon_, options_.margin);
      if (!half) return false;
      if (duration == 0) continue;
      // The ramp is behind the straight flight by at most half its duration, along the change.
      if (!(duration <= horizon_.until)) return false;
      const double behind = 0.5 * duration * std::max(0.0, -half->normal.dot(v - velocity_)),
                   along = std::max(0.0, horizon_.until * half->normal.dot(ground - part.velocity));
      const double slack =
          0x1p-46 * half->normal.norm() *
          (horizon_.until * (ground - part.velocity).norm() + duration * (v - velocity_).norm());
      if (along + behind + slack < half->room) continue;
      const Vector3d late = -0.5 * duration * (v - velocity_);
      // Another plane, of both straight ways.
      bool held = false;
      for (const Vector3d& shift : {Vector3d(0.5 * late), late}) {
        const auto n = part.pair.normal_along(shift, horizon_.until * (ground - part.velocity) + shift);
        if (!n) break;
        const double room = part.pair.gap(*n) - options_.margin * n->norm() * (1 + 0x1p-48);
        held = std::max(0.0, n->dot(late)) + std::max(0.0, horizon_.until * n->dot(ground - part.velocity)) +
                   slack <
               room;
        if (held) break;
      }
      if (!held) return false;
    }
    return true;
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
    const Vector3d d = given.normalized();
    Ray ray{d, {}};
    const Line line(wanted_ + options_.wind, d, {0, reach_});
    // What is farther than a candidate does not matter.
    const double far = std::min(reach_, 2 * upper_);
    const Domain domain{0, far};
    std::vector<Range> not_free;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const Part& part = parts_[i];
      if (away_[i] >= upper_) {
        ray.hit.push_back(std::nullopt);
        continue;
      }
      const OnRay question(part, line, horizon_, options_.margin);
      Search search(question, domain);
      search.run();
      std::optional<Range> hit;  // all between the first and the last: a convex set
      for (const Range& one : search.hit)
        hit = hit ? Range{std::min(hit->from, one.from), std::max(hit->to, one.to)} : one;
      ray.hit.push_back(hit);
      double from = 0;
      std::sort(search.free.begin(), search.free.end(),
                [](const Range& a, const Range& b) { return a.from < b.from; });
      for (const Range& free : search.free) {
        if (free.from > from) not_free.push_back({from, free.from});
        from = std::max(from, free.to);
      }
      if (from < far) not_free.push_back({from, reach_});
    }
    // What cannot be flown, along the ray.
    const double along = wanted_.dot(d);
    const auto crossing = [&](double speed) -> std::optional<Range> {
      const double root = along * along - wanted_.squaredNorm() + speed * speed;
      if (!(root > 0)) return std::nullopt;
      return Range{-along - std::sqrt(root), -along + std::sqrt(root)};
    };
    std::optional<Range> slow = crossing(options_.speed.from);
    if (slow && slow->to > 0) {
      not_free.push_back({std::max(slow->from, 0.0), slow->to});
      ray.hit.push_back(Range{std::max(slow->from, 0.0), slow->to});
    } else {
      ray.hit.push_back(std::nullopt);
    }
    if (std::isfinite(options_.speed.to)) {
      const auto fast = crossing(options_.speed.to);
      if (!fast || fast->to <= 0) {
        not_free.push_back({0, reach_});
      } else {
        if (fast->from > 0) not_free.push_back({0, fast->from});
        not_free.push_back({fast->to, reach_});
      }
    }
    for (const double side : {-1.0, 1.0}) {
      const double limit = side > 0 ? options_.climb.to : -options_.climb.from;
      if (std::isinf(limit)) continue;
      const double here = side * wanted_.z() - limit, slope = side * d.z();  // positive: too much
      if (here > 0) not_free.push_back({0, slope < 0 ? -here / slope : reach_});
      if (here <= 0 && slope > 0) not_free.push_back({-here / slope, reach_});
    }
    std::sort(not_free.begin(), not_free.end(),
              [](const Range& a, const Range& b) { return a.from < b.from; });
    double s = 0;
    for (const Range& range : not_free) {
      if (range.from >= s * (1 - kOneValue)) look_between(d, s, range.from);
      s = std::max(s, range.to);
    }
    if (s < far) look_between(d, s, far);
    rays_.push_back(std::move(ray));
    return static_cast<int>(rays_.size()) - 1;
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
    for (double beyond = 0; beyond < 1e-6; beyond = std::max(30 * beyond, 1e-13))
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
    const double height =
        std::abs(across.dot(a)) / across.norm() * (1 - 1e-12);  // of the plane through their tips
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

  static constexpr double kOneValue = 1e-13;  // a gap between what cannot be flown may be one value

  Vector3d velocity_, wanted_;
  const std::vector<Part>& parts_;
  const AvoidOptions& options_;
  Horizon horizon_;
  double reach_ = 0, upper_ = kInfinity;
  std::vector<double> away_;  // m/s, at least, from the wanted velocity to those that a part blocks
  Vector3d best_ = Vector3d::Zero();
  std::vector<Ray> rays_;
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
  std::vector<Part> parts;
  for (std::size_t i = 0; i < intruders.size(); ++i) {
    require(intruders[i].velocity, ("intruders[" + std::to_string(i) + "].velocity").c_str());
    for_each_part(agent, [&](const Placed& own, bool own_exact) {
      for_each_part(intruders[i].body, [&](const Placed& other, bool other_exact) {
        Part part{Pair(own, other), {}, intruders[i].velocity, i, own_exact && other_exact};
        if (options.margin > 0) part.inner.emplace(swollen(own, options.margin), other);
        parts.push_back(std::move(part));
      });
    });
  }
  Avoidance answer = Search3(velocity, wanted, parts, options, options.until).run();
  if (answer.status == AvoidStatus::free) return answer;
  answer.velocity = nearly(wanted, options);
  answer.distance = (answer.velocity - wanted).norm();
  // Nothing is safe for so long: what is for half as long, and so on.
  for (double until = 0.5 * options.until; until > 1e-3 * options.until; until *= 0.5) {
    const Avoidance shorter = Search3(velocity, wanted, parts, options, until).run();
    if (shorter.status != AvoidStatus::free) continue;
    answer.velocity = shorter.velocity;
    answer.distance = shorter.distance;
    break;
  }
  double first = kInfinity;
  for (const Part& part : parts)
    if (const auto contact = part.pair.contact(answer.velocity + options.wind, part.velocity);
        contact && contact->earliest < first) {
      first = contact->earliest;
      answer.first = {part.intruder, first};
    }
  return answer;
}

}  // namespace vericone::guidance
