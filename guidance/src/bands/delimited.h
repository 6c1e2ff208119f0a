// SPDX-License-Identifier: BSD-3-Clause
//
// Bodies with delimiters as they are. Their unsafe velocities are no convex set, so planes do not do; but if
// a pair stays apart with one body grown by a length, every flight that is never farther than that from it
// stays apart too, and if it meets with one body shrunk, so does every such flight.
#pragma once

#include <algorithm>
#include <cmath>

#include "bands/at_once.h"
#include "bands/threats.h"

namespace vericone::guidance::banding {

/// A body that contains all within `by` of this one; `by` negative: that has only what is as deep in it.
/// Nothing where that is empty about its centre.
inline std::optional<CombinedEllipsoid> grown(const CombinedEllipsoid& body, double by) {
  const Ellipsoid& e = body.ellipsoid();
  Eigen::Matrix3d axes = e.axis_directions();
  if (axes.determinant() < 0) axes.col(0) *= -1;
  const Vector3d semi = e.semi_axes();
  const double rounded = 1e-12 * (semi.maxCoeff() + std::abs(by));
  Vector3d changed;
  if (by >= 0) {
    // (1 + k) S + (1 + 1/k) by^2 contains the sum of ellipsoid and ball for every k > 0.
    const double k = by / std::sqrt(semi.squaredNorm() / 3);
    const double more = k > 0 ? (1 + 1 / k) * by * by : 0;
    changed = ((1 + k) * semi.array().square() + more).sqrt() + rounded;
  } else {
    const double part = 1 + (by - rounded) / semi.minCoeff();
    if (!(part > 0)) return std::nullopt;
    changed = part * semi;
  }
  const Ellipsoid around = Ellipsoid::from_axes(e.center(), changed, axes);
  std::vector<Delimiter<3>> delimiters;
  for (Delimiter<3> one : body.delimiters()) {
    // (a + d)^T M (a + d) <= a^T M a + 2 |d| |M F| + |d|^2 |M| for all a of the ellipsoid.
    const double length = std::abs(by), size = one.matrix.norm();
    const double change =
        (2 * length * (one.matrix * e.factor()).norm() + length * length * size) * (1 + 1e-12) +
        1e-12 * (one.level + size * semi.squaredNorm());
    one.level += by >= 0 ? change : -change;
    if (!(one.level > 0)) return std::nullopt;
    if (by < 0) {
      delimiters.push_back(one);
      continue;
    }
    try {  // one that reaches beyond the ellipsoid delimits nothing
      const CombinedEllipsoid alone(around, {one});
      delimiters.push_back(one);
    } catch (const InputError&) {
    }
  }
  return CombinedEllipsoid::trusted(around, std::move(delimiters));
}

/// A body that contains all within `by` of a convex body, or of one with delimiters.
inline Placed wider_than(const Placed& body, double by) {
  if (const auto* quadric = body.body.quadric()) return {*grown(*quadric, by), body.pose};
  if (const auto* convex = body.body.convex()) return {convex->swollen(by * (1 + 1e-12)), body.pose};
  std::vector<Vector3d> points;
  for (const Vector3d& x : body.body.hull()->points())
    for (int k = 0; k < 8; ++k)
      points.push_back(x + by * (1 + 1e-12) * Vector3d(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1));
  return {HullBody(std::move(points)), body.pose};
}

/// Single flights of two parts as they are, one of them with delimiters.
class AsTheyAre {
 public:
  explicit AsTheyAre(const Pair& pair) : pair_(pair) {
    const auto* agent = pair.agent().body.quadric();
    const auto* obstacle = pair.obstacle().body.quadric();
    of_agent_ = agent && (agent->is_ellipsoid() || !obstacle || !obstacle->is_ellipsoid());
  }

  /// Whether flights up to `by` metres beside this one surely stay apart; or surely meet.
  bool apart(const Vector3d& v, const Vector3d& other, const Horizon& horizon, double by) const {
    return verdict(v, other, horizon, by) == Verdict::out;
  }
  bool meets(const Vector3d& v, const Vector3d& other, const Horizon& horizon, double by) const {
    const Verdict found = verdict(v, other, horizon, -by);
    return found == Verdict::in || found == Verdict::overlapping;
  }

 private:
  Verdict verdict(const Vector3d& v, const Vector3d& other, const Horizon& horizon, double by) const {
    if (by == 0) return pair_.verdict(v, other, horizon);
    const Placed& changed = of_agent_ ? pair_.agent() : pair_.obstacle();
    const auto body = grown(*changed.body.quadric(), by);
    if (!body) return Verdict::undecided;
    const Placed placed(*body, changed.pose);
    return (of_agent_ ? Pair(placed, pair_.obstacle()) : Pair(pair_.agent(), placed))
        .verdict(v, other, horizon);
  }

  const Pair& pair_;
  bool of_agent_;
};

/// A quantity of velocity against two parts as they are.
class OfDelimited : public Question {
 public:
  OfDelimited(const Part& part, const Horizon& horizon, double margin, const Curve& curve, double finest)
      : part_(part),
        truth_(*part.truth),
        horizon_(horizon),
        margin_(margin),
        curve_(curve),
        finest_(finest) {}

  std::optional<Range> free_about(double q) const override {
    const Vector3d v = curve_.velocity(q), w = v - part_.velocity;
    if (!truth_.apart(v, part_.velocity, horizon_, margin_)) return std::nullopt;
    Range range{-kInfinity, kInfinity};
    // Once they have passed each other a plane does, and for so long flights spread.
    double until = horizon_.until;
    if (const double passed = 1.5 * after(w); passed < until) {
      const Vector3d n = -w / w.norm();
      const double room = part_.pair.gap(n) - margin_ * (1 + 0x1p-48), along = n.dot(part_.velocity);
      const double from = std::max(passed, horizon_.from);
      const double most = room > 0 ? room / horizon_.until : room / from;
      const auto about =
          curve_.about(q, n, most + along, std::abs(most) + n.cwiseAbs().dot(part_.velocity.cwiseAbs()));
      if (about) {
        range = *about;
        until = from;
      }
    }
    const double spread = until * curve_.slope() * (1 + 1e-9);
    if (!std::isfinite(spread)) return std::nullopt;
    double by = by_ > 0 ? 2 * by_ : 0.25 * part_.reach;
    // What is proved of less than a step of the search would leave crumbs.
    const double least = std::max(1e-7 * part_.reach, 4 * finest_ * spread),
                 slack = 0x1p-40 * (part_.reach + part_.apart.norm());
    while (by > least && !truth_.apart(v, part_.velocity, horizon_, margin_ + by + slack)) by *= 0.5;
    by_ = by;
    if (!(by > least)) return std::nullopt;
    if (spread == 0) return range;
    return Range{std::max(range.from, q - by / spread), std::min(range.to, q + by / spread)};
  }

  bool is_hit(double q) const override {
    return truth_.meets(curve_.velocity(q), part_.velocity, horizon_, 0);
  }

  bool all_hit(double from, double to) const override {
    const double q = 0.5 * (from + to);
    const Vector3d v = curve_.velocity(q);
    const double until = std::min(horizon_.until, after(v - part_.velocity));
    const double by = until * curve_.slope() * 0.5 * (to - from) * (1 + 1e-9) +
                      0x1p-40 * (part_.reach + part_.apart.norm());
    return std::isfinite(by) && truth_.meets(v, part_.velocity, horizon_, by);
  }

  double finest() const override { return finest_; }

 private:
  /// A time after which balls about them have passed each other.
  double after(const Vector3d& w) const {
    const double square = w.squaredNorm();
    return square > 0 ? std::max(0.0, part_.apart.dot(w) + part_.reach * std::sqrt(square)) / square
                      : kInfinity;
  }

  const Part& part_;
  AsTheyAre truth_;
  Horizon horizon_;
  double margin_;
  const Curve& curve_;
  double finest_;
  mutable double by_ = 0;  // m, of the value asked about before
};

/// Flying level, higher by q from now on, against two parts as they are.
class OfDelimitedAltitude : public Question {
 public:
  OfDelimitedAltitude(const Part& part, const Vector3d& level, const Horizon& horizon, double margin,
                      double finest)
      : part_(part), level_(level), horizon_(horizon), margin_(margin), finest_(finest) {}

  std::optional<Range> free_about(double q) const override {
    const Pair moved = higher(q);
    const AsTheyAre truth(moved);
    if (!truth.apart(level_, part_.velocity, horizon_, margin_)) return std::nullopt;
    double by = by_ > 0 ? 2 * by_ : 0.25 * part_.reach;
    const double least = std::max(1e-7 * part_.reach, 4 * finest_);
    while (by > least && !truth.apart(level_, part_.velocity, horizon_, margin_ + by + slack())) by *= 0.5;
    by_ = by;
    return by > least ? std::optional(Range{q - by, q + by}) : std::nullopt;
  }
  bool is_hit(double q) const override {
    const Pair moved = higher(q);
    return AsTheyAre(moved).meets(level_, part_.velocity, horizon_, 0);
  }
  bool all_hit(double from, double to) const override {
    const Pair moved = higher(from + 0.5 * (to - from));
    const double by = 0.5 * (to - from) * (1 + 1e-9) + slack();
    return AsTheyAre(moved).meets(level_, part_.velocity, horizon_, by);
  }
  double finest() const override { return finest_; }

 private:
  Pair higher(double q) const {
    Placed moved = part_.truth->agent();
    moved.pose.position.z() += q;
    return {moved, part_.truth->obstacle()};
  }
  double slack() const { return 0x1p-40 * (part_.reach + part_.apart.norm()); }

  const Part& part_;
  Vector3d level_;
  Horizon horizon_;
  double margin_, finest_;
  mutable double by_ = 0;  // m, of the value asked about before
};

}  // namespace vericone::guidance::banding
