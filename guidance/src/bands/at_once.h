// SPDX-License-Identifier: BSD-3-Clause
//
// A quantity changed at once: headings, lines of velocities, heights.
#pragma once

#include <vericone/cones/pair.h>
#include <functional>
#include <limits>
#include <numbers>

#include "bands/margin.h"
#include "bands/search.h"
#include "bands/threats.h"

namespace vericone::guidance::banding {

using Eigen::Vector3d;

inline constexpr double kPi = std::numbers::pi, kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kRoundings = 0x1p-48;  // of a sum of some ten products, relative to all their sizes

/// All values x with slope x < level; nothing where q is not one.
inline std::optional<Range> below(double q, double slope, double level) {
  const double end = level / slope, slack = std::abs(end) * kRoundings;
  if (!(q * slope < level)) return std::nullopt;
  Range range{-kInfinity, kInfinity};
  if (slope > 0) range.to = end - slack;
  if (slope < 0) range.from = end + slack;
  return range.from <= q && q <= range.to ? std::optional(range) : std::nullopt;
}

/// One quantity of an agent's velocity, the rest kept: a curve of velocities over ground.
class Curve {
 public:
  virtual ~Curve() = default;
  virtual Vector3d velocity(double q) const = 0;
  virtual double slope() const = 0;  // of the velocity's derivative, at most
  /// All values about q for which n.v < most, `size` being that of all terms of `most`; nothing where q is
  /// not surely one.
  virtual std::optional<Range> about(double q, const Vector3d& n, double most, double size) const = 0;
  /// Values between two hits that are hits of a convex set of velocities too; asks for single velocities.
  virtual bool all_hit(double from, double to, const std::function<bool(const Vector3d&)>& hit) const = 0;
  /// Of a closed one: with it the agent comes nearest to the middle of what is at c and moves with u, or does
  /// so soonest; to rounding.
  virtual std::optional<double> towards(const Vector3d& c, const Vector3d& u) const {
    static_cast<void>(c), static_cast<void>(u);
    return std::nullopt;
  }
};

/// Headings q clockwise from y, at one speed.
class Headings : public Curve {
 public:
  Headings(double speed, double climb, const Vector3d& wind) : speed_(speed), rest_(wind) {
    rest_.z() += climb;
  }
  Vector3d velocity(double q) const override {
    return rest_ + speed_ * Vector3d(std::sin(q), std::cos(q), 0);
  }

  double slope() const override { return speed_; }

  // speed (n_x sin q + n_y cos q) < most - n.rest: all but an arc about the direction of n.
  std::optional<Range> about(double q, const Vector3d& n, double most, double size) const override {
    const Range all_about{q - 2 * kPi, q + 2 * kPi};
    if (speed_ == 0) return all_about;  // all headings are one velocity
    const double all =
        size + n.cwiseAbs().dot(rest_.cwiseAbs()) + speed_ * (std::abs(n.x()) + std::abs(n.y()));
    const double level = most - n.dot(rest_) - kRoundings * all;
    const double most_along = speed_ * std::hypot(n.x(), n.y()) * (1 + 8 * 0x1p-53);
    if (level > most_along) return all_about;
    if (!(level > -most_along)) return std::nullopt;
    const double half = std::acos(level / most_along) + 0x1p-49;
    const double off = std::remainder(q - std::atan2(n.x(), n.y()), 2 * kPi);
    const double slack = 0x1p-49 * (1 + std::abs(q));
    const double beyond = std::abs(off) - half - slack, rest = 2 * (kPi - half) - beyond - 2 * slack;
    if (!(beyond > 0 && rest > 0)) return std::nullopt;
    return off > 0 ? Range{q - beyond, q + rest} : Range{q - rest, q + beyond};
  }

  /// An arc is in the triangle of its ends and the point where the tangents there meet.
  bool all_hit(double from, double to, const std::function<bool(const Vector3d&)>& hit) const override {
    const double half = 0.5 * (to - from);
    if (half > 0.5) return false;
    const double middle = from + half, out = speed_ / std::cos(half);
    return hit(rest_ + out * Vector3d(std::sin(middle), std::cos(middle), 0));
  }

  /// On a collision course u + c / t, the earliest of this speed, seen from above.
  std::optional<double> towards(const Vector3d& c, const Vector3d& u) const override {
    const Eigen::Vector2d m = (u - rest_).head<2>(), p = c.head<2>();
    const double square = p.squaredNorm(), half = m.dot(p),
                 root = half * half - square * (m.squaredNorm() - speed_ * speed_);
    const double rate = square > 0 ? std::max(0.0, (std::sqrt(std::max(root, 0.0)) - half) / square) : 0;
    const Eigen::Vector2d v = m + rate * p;
    const double heading = std::atan2(v.x(), v.y());
    if (!std::isfinite(heading)) return std::nullopt;
    return heading < 0 ? heading + 2 * kPi : heading;
  }

 private:
  double speed_;
  Vector3d rest_;
};

/// Velocities start + q along.
class Line : public Curve {
 public:
  Line(const Vector3d& start, const Vector3d& along, const Range& range)
      : start_(start), along_(along), farthest_(std::max(std::abs(range.from), std::abs(range.to))) {}
  Vector3d velocity(double q) const override { return start_ + q * along_; }
  double slope() const override { return along_.norm(); }

  std::optional<Range> about(double q, const Vector3d& n, double most, double size) const override {
    const double all = size + n.cwiseAbs().dot(start_.cwiseAbs() + farthest_ * along_.cwiseAbs());
    return below(q, n.dot(along_), most - n.dot(start_) - kRoundings * all);
  }

  bool all_hit(double, double, const std::function<bool(const Vector3d&)>&) const override { return true; }

 private:
  Vector3d start_, along_;
  double farthest_;  // q
};

/// Whether freed_by(plane, q), the values about q that are free by a plane found before, are all of these.
template <typename FreedBy>
bool some_plane_frees(const Part& part, double from, double to, const FreedBy& freed_by) {
  return std::any_of(part.planes.begin(), part.planes.end(), [&](const SafeHalfSpace& half) {
    const std::optional<Range> about = freed_by(half, 0.5 * (from + to));
    return about && about->from <= from && to <= about->to;
  });
}

/// Along a curve of velocities, keeping a margin from a part.
class OfVelocity : public Question {
 public:
  OfVelocity(const Part& part, const Horizon& horizon, double margin, const Curve& curve)
      : part_(part), horizon_(horizon), margin_(margin), curve_(curve) {}

  std::optional<Range> free_about(double q) const override {
    const auto half = safe(part_, curve_.velocity(q), horizon_, margin_);
    if (!half) return std::nullopt;
    constexpr std::size_t kMostKept = 8;
    if (part_.planes.size() < kMostKept) part_.planes.push_back(*half);
    const auto about = freed_by(*half, q);
    return about ? about : Range{q, q};  // of itself, at least
  }
  bool known_free(double from, double to) const override {
    return some_plane_frees(part_, from, to,
                            [this](const auto& half, double q) { return freed_by(half, q); });
  }
  bool is_hit(double q) const override { return hit(curve_.velocity(q)); }
  std::optional<double> likeliest() const override { return curve_.towards(part_.apart, part_.velocity); }
  bool all_hit(double from, double to) const override {
    return curve_.all_hit(from, to, [this](const Vector3d& v) { return hit(v); });
  }

 private:
  std::optional<Range> freed_by(const SafeHalfSpace& half, double q) const {
    const double most = half.most(horizon_), along = half.normal.dot(part_.velocity);
    return curve_.about(q, half.normal, most + along,
                        std::abs(most) + half.normal.cwiseAbs().dot(part_.velocity.cwiseAbs()));
  }
  bool hit(const Vector3d& v) const { return comes_nearer(part_, v, horizon_, margin_); }

  const Part& part_;
  Horizon horizon_;
  double margin_;
  const Curve& curve_;
};

/// Flying level, higher by q from now on: the heights that hit are one interval.
class OfAltitude : public Question {
 public:
  OfAltitude(const Part& part, const Vector3d& level, const Horizon& horizon, double margin)
      : part_(part), level_(level), horizon_(horizon), margin_(margin) {}

  std::optional<Range> free_about(double q) const override {
    const Vector3d w = level_ - part_.velocity, here(0, 0, q);
    const auto found = part_.swollen().normal_along(here + horizon_.from * w, here + farthest() * w);
    if (const auto range = found ? freed_by(*found, q) : std::nullopt; range || margin_ == 0) return range;
    // Where the swollen body is less than the margin, the plane where they are nearest leaves more. Where
    // they pass it is along w, to rounding of a search.
    const Pair there = higher(q, part_.pair);
    if (there.verdict(level_, part_.velocity, horizon_) != Verdict::out) return std::nullopt;
    const Miss nearest = nearest_within(there, level_, part_.velocity, horizon_);
    if (!(nearest.least > margin_)) return std::nullopt;
    Vector3d n = nearest.normal;
    if (std::abs(n.dot(w)) < 1e-3 * n.norm() * w.norm()) n -= n.dot(w) / w.squaredNorm() * w;
    const auto range = freed_by(n, q);
    return range ? range : Range{q, q};  // of itself, at least
  }
  bool known_free(double from, double to) const override {
    return some_plane_frees(part_, from, to,
                            [this](const auto& half, double q) { return freed_by(half.normal, q); });
  }
  bool is_hit(double q) const override {
    if (meets(higher(q, part_.swollen()).verdict(level_, part_.velocity, horizon_))) return true;
    return margin_ > 0 &&
           nearest_within(higher(q, part_.pair), level_, part_.velocity, horizon_).most < margin_;
  }
  bool all_hit(double, double) const override { return true; }

 private:
  /// The plane of the pair at q is one of the pair here, moved.
  std::optional<Range> freed_by(Vector3d n, double q) const {
    const Vector3d w = level_ - part_.velocity;
    // Where they pass, n.w is 0 to rounding; for ever it has to be less.
    if (std::isinf(horizon_.until) && !w.isZero(0))
      n -= (std::max(n.dot(w), 0.0) + kRoundings * n.norm() * w.norm()) / w.squaredNorm() * w;
    const double room = part_.pair.gap(n) - margin_ * n.norm() * (1 + 0x1p-48), along = n.dot(w);
    const double time = along > 0 ? horizon_.until : horizon_.from, reached = along == 0 ? 0 : time * along;
    const double size =
        std::abs(room) + time * n.cwiseAbs().dot(level_.cwiseAbs() + part_.velocity.cwiseAbs());
    return below(q, n.z(), room - reached - kRoundings * (std::isfinite(size) ? size : std::abs(room)));
  }
  static Pair higher(double q, const Pair& pair) {
    Placed moved = pair.agent();
    moved.pose.position.z() += q;
    return {moved, pair.obstacle()};
  }
  /// A time after which they have passed, where the horizon has no end.
  double farthest() const {
    const double speed = (level_ - part_.velocity).norm();
    if (std::isfinite(horizon_.until) || !(speed > 0))
      return std::isfinite(horizon_.until) ? horizon_.until : 0;
    const auto size = [](const Placed& body) {
      const Box bounds = body.body.bounds();
      return bounds.low.norm() + bounds.high.norm() + body.pose.position.norm();
    };
    return horizon_.from + 2 * (size(part_.pair.agent()) + size(part_.pair.obstacle()) + margin_) / speed;
  }

  const Part& part_;
  Vector3d level_;
  Horizon horizon_;
  double margin_;
};

}  // namespace vericone::guidance::banding
