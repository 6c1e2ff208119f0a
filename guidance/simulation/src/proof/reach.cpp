// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/internal/simulation/mesh_track.h>
#include <vericone/internal/simulation/passed.h>
#include <vericone/simulation/reach.h>

#include <vericone/geometry/error.h>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "names.h"
#include "proof/convex.h"
#include "proof/least_point.h"

namespace vericone::simulation {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using std::numbers::pi;

constexpr double kUnlimited = ReachLimits::kNone;

/// The convex hull of an opening at a time, or its centre alone.
class Gate {
 public:
  Gate(const MovingOrifice& orifice, double t, bool center)
      : opening_(orifice.at(t).opening), center_(center) {
    if (!orifice.window || center) return;
    // A way through a window crosses the fan of its rim.
    MovingOrifice mesh = orifice;
    mesh.window.reset();
    const PlacedOpening now = mesh.at(t).opening;
    for (const Vector3d& x : orifice.window->rim())
      rim_.push_back(now.center + now.axes * x.head<2>() + x.z() * now.normal());
  }

  const Vector3d& center() const { return opening_.center; }
  /// The point farthest along n, and how far that is.
  Vector3d farthest(const Vector3d& n) const {
    if (center_) return opening_.center;
    if (!rim_.empty())
      return *std::max_element(rim_.begin(), rim_.end(),
                               [&](const Vector3d& x, const Vector3d& y) { return n.dot(x) < n.dot(y); });
    const Vector2d across = opening_.axes.transpose() * n;
    const Opening& opening = opening_.opening;
    if (opening.polygonal()) {
      const auto& v = opening.vertices();
      return on_plane(*std::max_element(v.begin(), v.end(), [&](const Vector2d& x, const Vector2d& y) {
        return across.dot(x) < across.dot(y);
      }));
    }
    const Vector2d u = opening.semi_axes().cwiseProduct(across);
    if (u.isZero(0)) return opening_.center;
    return on_plane(opening.semi_axes().cwiseProduct(u.normalized()));
  }
  double most(const Vector3d& n) const { return n.dot(farthest(n)); }
  double least(const Vector3d& n) const { return n.dot(farthest(-n)); }

 private:
  Vector3d on_plane(const Vector2d& x) const { return opening_.center + opening_.axes * x; }

  PlacedOpening opening_;
  bool center_;
  std::vector<Vector3d> rim_;  // of a window
};

/// The largest distance of a point that counts from the one that the orifice turns about.
double reach_of(const MovingOrifice& orifice, bool center) {
  double most = center ? 0 : orifice.opening.reach();
  if (orifice.window) {
    most = orifice.flat_center.norm();
    for (const Vector3d& x : orifice.window->rim()) most = std::max(most, x.norm());
  }
  return most * (1 + 1e-12);
}

/// How far a convex set is from another at least: what a plane between them tells.
template <typename From, typename To>
double distance(const From& from, const To& to, Vector3d* normal = nullptr) {
  const auto farthest = [&](const Vector3d& d) -> Vector3d { return to.farthest(d) - from.farthest(-d); };
  const Vector3d gap = least_point(farthest, to.center() - from.center());
  if (gap.isZero(0)) return 0;
  const Vector3d n = gap.normalized();
  if (normal) *normal = n;
  return std::max(0.0, n.dot(to.farthest(-n)) - n.dot(from.farthest(n)));
}

struct Point {
  Vector3d at;
  const Vector3d& center() const { return at; }
  const Vector3d& farthest(const Vector3d&) const { return at; }
};

/// The most that a velocity of length 1 goes along a direction in the time T, which is at the angle `off`
/// from it and turns at a rate of `rate` or less: the integral of cos(max(0, off - rate t)). `forward`: what
/// it goes back does not count.
double gained(double off, double rate, double T, bool forward) {
  if (!(rate > 0)) return forward ? std::max(0.0, std::cos(off)) * T : std::cos(off) * T;
  if (std::isinf(rate)) return T;
  double start = 0;
  if (forward && off > pi / 2) start = std::min(T, (off - pi / 2) / rate);
  const double aimed = std::min(T, off / rate);
  return (std::sin(off - rate * start) - std::sin(off - rate * aimed)) / rate + (T - aimed);
}

double angle(const Vector3d& x, const Vector3d& y) { return std::atan2(x.cross(y).norm(), x.dot(y)); }

/// What is known of the opening before.
struct Left {
  const MovingOrifice* orifice = nullptr;
  ReachTime when;
};

/// Goes forward in time by steps in which the limit that is exceeded by the most cannot cease to be exceeded.
class EarliestTime {
 public:
  EarliestTime(const ReachStart& start, const ReachLimits& limits, const MovingOrifice& orifice,
               const Left& left, bool center)
      : start_(start), limits_(limits), orifice_(orifice), left_(left), center_(center) {
    own_ = orifice.velocity.norm() + orifice.spin.norm() * reach_of(orifice, center);
    if (left.orifice)
      before_ = left.orifice->velocity.norm() + left.orifice->spin.norm() * reach_of(*left.orifice, false);
  }

  ReachTime search(double horizon) {
    constexpr double kShortest = 1e-7;
    constexpr int kMostSteps = 100'000;
    const double ready = left_.orifice ? std::max(start_.t, left_.when.not_before) : start_.t;
    double t = std::max(ready, orifice_.appears);
    ReachTime found{t, left_.orifice ? left_.when.by : ReachLimit::none};
    if (orifice_.appears > ready) found.by = ReachLimit::appearance;
    if (std::isinf(t)) return found;
    for (int i = 0; i < kMostSteps; ++i) {
      look(t);
      if (!(step_ > kShortest)) return found;
      found.by = limit_;
      t += step_ * (1 - 1e-12);
      if (t > horizon) return {kUnlimited, limit_};
      found.not_before = t;
    }
    return found;
  }

 private:
  /// A limit is exceeded by `excess` metres, which falls at `rate` or less, that growing by `growth` a
  /// second.
  void exceeded(double excess, double rate, double growth, ReachLimit by) {
    if (!(excess > 0)) return;
    const double step = growth > 0 ? 2 * excess / (rate + std::sqrt(rate * rate + 2 * growth * excess))
                        : rate > 0 ? excess / rate
                                   : kUnlimited;
    if (step <= step_) return;
    step_ = step;
    limit_ = by;
  }

  void look(double t) {
    step_ = 0;
    limit_ = ReachLimit::none;
    const double T = t - start_.t;
    // What rounding may move.
    const double slack = start_.offset + 1e-12 * (1 + start_.position.norm() + orifice_.position.norm() +
                                                  own_ * std::abs(t) + reach_of(orifice_, false));
    const Gate gate(orifice_, t, center_);
    const Vector3d& p = start_.position;
    Vector3d towards = gate.center() - p;
    if (std::isfinite(limits_.speed)) {
      const double away = distance(Point{p}, gate, &towards);
      exceeded(away - slack - limits_.speed * T, limits_.speed + own_, 0, ReachLimit::speed);
      turning(gate, T, towards, slack);
    }
    if (std::isfinite(limits_.acceleration)) {
      const Vector3d coasted = p + T * start_.velocity;
      exceeded(distance(Point{coasted}, gate) - slack - 0.5 * limits_.acceleration * T * T,
               start_.velocity.norm() + own_ + limits_.acceleration * T, limits_.acceleration,
               ReachLimit::speed);
    }
    heights(gate.least(Vector3d::UnitZ()) - slack, gate.most(Vector3d::UnitZ()) + slack, T);
    if (left_.orifice) from_before(gate, t, slack);
  }

  /// Along any direction it goes no farther than it can turn to.
  void turning(const Gate& gate, double T, const Vector3d& towards, double slack) {
    const Vector3d& v = start_.velocity;
    const double rate = limits_.speed + own_;
    constexpr int kDirections = 24;
    if (std::isfinite(limits_.turn_rate) && !v.isZero(0)) {
      const Vector3d ahead = v.normalized(), aside = towards - ahead.dot(towards) * ahead;
      const Vector3d across = aside.isZero(0) ? ahead.unitOrthogonal() : Vector3d(aside.normalized());
      for (int i = 0; i <= kDirections; ++i) {
        const double off = pi * i / kDirections;
        const Vector3d n = std::cos(off) * ahead + std::sin(off) * across;
        const double gone = limits_.speed * gained(angle(v, n), limits_.turn_rate, T, true);
        exceeded(gate.least(n) - n.dot(start_.position) - slack - gone, rate, 0, ReachLimit::turning);
      }
    }
    const Vector3d course(v.x(), v.y(), 0);
    if (!std::isfinite(limits_.course_rate) || course.isZero(0)) return;
    for (int i = 0; i < 2 * kDirections; ++i) {
      const double azimuth = pi * i / kDirections;
      const Vector3d n(std::cos(azimuth), std::sin(azimuth), 0);
      const double gone = limits_.speed * gained(angle(course, n), limits_.course_rate, T, true);
      exceeded(gate.least(n) - n.dot(start_.position) - slack - gone, rate, 0, ReachLimit::turning);
    }
  }

  /// `low`, `high`: z of the opening.
  void heights(double low, double high, double T) {
    exceeded(low - limits_.top, own_, 0, ReachLimit::height);
    exceeded(limits_.bottom - high, own_, 0, ReachLimit::height);
    if (std::isfinite(limits_.climb)) {
      const double rate = limits_.climb + own_;
      exceeded(low - start_.position.z() - limits_.climb * T, rate, 0, ReachLimit::climb);
      exceeded(start_.position.z() - limits_.climb * T - high, rate, 0, ReachLimit::climb);
    }
    if (!std::isfinite(limits_.climb_jerk)) return;
    const double w = start_.velocity.z(), a = start_.climb_acceleration, j = limits_.climb_jerk;
    // Steps are no longer than the time since the start, or 0.1 s, so rates stay below this.
    const double ahead = T + std::max(T, 0.1);
    const double rate = std::abs(w) + std::abs(a) * ahead + j * ahead * ahead / 2 + own_;
    const double still = start_.position.z() + w * T + a * T * T / 2, gone = j * T * T * T / 6;
    exceeded(std::min(low - still - gone, rate * (ahead - T)), rate, 0, ReachLimit::climb);
    exceeded(std::min(still - gone - high, rate * (ahead - T)), rate, 0, ReachLimit::climb);
  }

  /// From the opening before: where it was when it could first be passed, and what it moves itself since.
  void from_before(const Gate& gate, double t, double slack) {
    const double since = left_.when.not_before, T = t - since;
    const Gate before(*left_.orifice, since, false);
    if (std::isfinite(limits_.speed)) {
      const double fastest = std::max(limits_.speed, before_);
      exceeded(distance(before, gate) - start_.offset - slack - fastest * T, fastest + own_, 0,
               ReachLimit::speed);
    } else if (std::isfinite(limits_.acceleration)) {
      const double speed = start_.velocity.norm() + limits_.acceleration * (since - start_.t);
      const double fastest = std::max(speed, before_);
      exceeded(
          distance(before, gate) - start_.offset - slack - fastest * T - 0.5 * limits_.acceleration * T * T,
          fastest + own_ + limits_.acceleration * T, limits_.acceleration, ReachLimit::speed);
    }
    if (!std::isfinite(limits_.climb)) return;
    const double fastest = std::max(limits_.climb, before_), rate = fastest + own_;
    const Vector3d up = Vector3d::UnitZ();
    const double off = start_.offset + slack + fastest * T;
    exceeded(gate.least(up) - before.most(up) - off, rate, 0, ReachLimit::climb);
    exceeded(before.least(up) - gate.most(up) - off, rate, 0, ReachLimit::climb);
  }

  const ReachStart& start_;
  const ReachLimits& limits_;
  const MovingOrifice& orifice_;
  const Left& left_;
  bool center_;
  double own_ = 0, before_ = 0;  // m/s, of points of this opening, and of the one before
  double step_ = 0;              // s, of the limit that is exceeded for longest
  ReachLimit limit_ = ReachLimit::none;
};

void check(const ReachLimits& limits) {
  for (const double limit : {limits.speed, limits.acceleration, limits.turn_rate, limits.course_rate,
                             limits.climb, limits.climb_jerk})
    if (!(limit >= 0)) throw InputError("limits", to_text(limit), "0 or more");
  if (!(limits.bottom <= limits.top))
    throw InputError("limits", to_text(limits.top) + " m as the highest place",
                     "not below the lowest, " + to_text(limits.bottom) + " m");
}

/// Of a vehicle. Its limits are those through the water, which carries it besides.
ReachLimits limits_of(const Scenario& scenario, const Body& body) {
  ReachLimits limits;
  const VehicleLimits own = body.vehicle->limits(body.start);
  const double water = scenario.water.most(own.bottom, own.top);
  limits.speed = own.speed + water;
  limits.climb = own.climb + water;
  limits.climb_jerk = water == 0 ? own.climb_jerk : kUnlimited;
  // Its turn rate is one of its heading, perhaps of a mean: what slips aside goes another way than it
  // points.
  limits.top = own.top;
  limits.bottom = own.bottom;
  return limits;
}

/// As a vehicle sets out, whatever it is told.
Vector3d first_acceleration(const Scenario& scenario, const Body& body) {
  std::vector<Curve> way;
  const double t = body.appears;
  body.vehicle->launch(body.start, t, scenario.water)->advance({}, t, t + scenario.step, way);
  return way.front().acceleration(t);
}

}  // namespace

const char* to_string(ReachLimit limit) {
  constexpr const char* kWords[] = {"none", "speed", "turning", "climb", "height", "appearance"};
  return kWords[std::size_t(limit)];
}

std::vector<Reach> earliest_passages(const ReachStart& start, const ReachLimits& limits,
                                     const std::vector<const MovingOrifice*>& orifices, double horizon) {
  check(limits);
  std::vector<Reach> all;
  Left left;
  for (const MovingOrifice* orifice : orifices) {
    Reach reach;
    reach.edge = EarliestTime(start, limits, *orifice, left, false).search(horizon);
    reach.center = EarliestTime(start, limits, *orifice, left, true).search(horizon);
    all.push_back(reach);
    left = {orifice, reach.edge};
  }
  return all;
}

std::vector<AgentReach> reach(const Scenario& scenario) {
  std::vector<AgentReach> all;
  for (std::size_t i = 0; i < scenario.bodies.size(); ++i) {
    const Body& body = scenario.bodies[i];
    const auto model = body.pilot ? model_of(*body.pilot) : nullptr;
    if (!model || model->orifices().empty()) continue;
    AgentReach agent{
        i, body.vehicle ? limits_of(scenario, body) : model->limits(body, scenario.step), {}, {}};
    std::vector<const MovingOrifice*> orifices;
    for (const std::string& name : model->orifices()) {
      const std::size_t k = index_of(scenario.orifices, name);
      if (k == scenario.orifices.size())
        throw InputError("bodies[" + std::to_string(i) + "].pilot.through", name,
                         "names of orifices of the scenario");
      agent.orifices.push_back(k);
      orifices.push_back(&scenario.orifices[k]);
    }
    ReachStart start{body.appears, body.start.position, body.start.velocity, 0, 0};
    if (body.vehicle && std::isfinite(agent.limits.climb_jerk))
      start.climb_acceleration = first_acceleration(scenario, body).z();
    start.offset = convex_around(body.shape, body.appears, scenario.duration).center.norm();
    agent.reach = earliest_passages(start, agent.limits, orifices, scenario.duration);
    all.push_back(std::move(agent));
  }
  if (all.empty())
    throw InputError("bodies", "no agent with `through`", "one agent or more that is to pass orifices");
  return all;
}

bool all_passed(const Run& run) {
  return !run.interrupted && std::all_of(run.passages.begin(), run.passages.end(), [](const auto& passage) {
    return !passage.ordered || passage.proof.verdict == PassageVerdict::passed;
  });
}

std::optional<double> largest_drift(const Scenario& scenario, const Run& run) {
  double most = std::numeric_limits<double>::infinity();
  for (const PassageOutcome& passage : run.passages) {
    if (!passage.ordered) continue;
    if (passage.agent >= run.tracks.size() || passage.orifice >= scenario.orifices.size())
      throw InputError("run.passages", "a passage of others", "a run of this scenario");
    const Track& track = run.tracks[passage.agent];
    const auto passes = [&](double drift) {
      ProofOptions options = scenario.proof;
      options.drift = drift;
      const MovingOrifice& orifice = scenario.orifices[passage.orifice];
      const double from = std::max(track.appears(), orifice.appears);
      const PassageProof proof =
          orifice.window
              ? prove_passage(track, *orifice.window, mesh_track(orifice, run.end), from, run.end, options)
              : prove_passage(track, orifice, from, run.end, options);
      return proof.verdict == PassageVerdict::passed;
    };
    double lo = 0, hi = most;
    if (passage.proof.verdict == PassageVerdict::passed)
      lo = scenario.proof.drift;
    else if (!passes(0))
      return std::nullopt;
    if (std::isfinite(hi) && passes(hi)) continue;
    // What is certainly too much: farther than the rim ever is.
    if (!std::isfinite(hi)) hi = lo + (passage.proof.least_distance + 1) / (run.end - track.appears());
    while (passes(hi)) lo = hi, hi *= 2;
    while (hi - lo > 0.01 * lo + 1e-9) {
      const double half = 0.5 * (lo + hi);
      (passes(half) ? lo : hi) = half;
    }
    most = lo;
  }
  return std::isfinite(most) ? std::optional(most) : std::nullopt;
}

std::optional<double> largest_current(const Scenario& scenario, const Vector3d& direction, double first,
                                      int runs, const std::function<bool()>& go_on) {
  RunOptions options;
  options.log = false;
  if (go_on) options.progress = [&](double) { return go_on(); };
  const auto passes = [&](double speed) {
    Scenario there = scenario;
    there.water = scenario.water.carried(speed * direction.normalized());
    try {
      return all_passed(simulate(there, options));
    } catch (const InputError&) {
      return false;  // a vehicle that cannot set out in such water
    }
  };
  if (!passes(0)) return std::nullopt;
  double lo = 0, hi = std::numeric_limits<double>::infinity(), next = first;
  for (int i = 1; i < runs; ++i) {
    (passes(next) ? lo : hi) = next;
    next = std::isfinite(hi) ? 0.5 * (lo + hi) : 2 * lo;
  }
  return lo;
}

}  // namespace vericone::simulation
