// SPDX-License-Identifier: BSD-3-Clause
//
// A quantity changed at a constant rate, after waiting for a while, and then kept.
#pragma once

#include "bands/at_once.h"

namespace vericone::guidance::banding {

/// Of one quantity q: velocities over ground while it changes from its present value, and after.
class Change {
 public:
  Change(double value, double a_second, double first_derivative, double second_derivative)
      : start(value), rate(a_second), slope_size(first_derivative), bend_size(second_derivative) {}
  virtual ~Change() = default;
  virtual Vector3d velocity(double q) const = 0;
  virtual Vector3d slope(double q) const = 0;  // d velocity / d q
  /// Displacement over ground on the way to q; at a finite rate.
  virtual Vector3d way(double q) const = 0;

  double duration(double q) const { return std::isinf(rate) ? 0 : std::abs(q - start) / rate; }

  const double start, rate;            // of q, and of q a second; infinite: at once
  const double slope_size, bend_size;  // of the first and second derivative of the velocity, at most
};

/// Headings, on a circle.
class Turn : public Change {
 public:
  Turn(double speed, double heading, double a_second, const Vector3d& rest)
      : Change(heading, a_second, speed, speed), speed_(speed), rest_(rest) {}
  Vector3d velocity(double q) const override {
    return rest_ + speed_ * Vector3d(std::sin(q), std::cos(q), 0);
  }
  Vector3d slope(double q) const override { return speed_ * Vector3d(std::cos(q), -std::sin(q), 0); }
  Vector3d way(double q) const override {
    // Of the chord, without the difference of two cosines.
    const double half = 0.5 * (q - start), middle = start + half;
    const double chord = (q < start ? -2 : 2) * speed_ / rate * std::sin(half);
    return duration(q) * rest_ + chord * Vector3d(std::sin(middle), std::cos(middle), 0);
  }

 private:
  double speed_;
  Vector3d rest_;
};

/// Velocities base + q along, with a constant acceleration.
class Acceleration : public Change {
 public:
  Acceleration(const Vector3d& base, const Vector3d& along, double value, double a_second)
      : Change(value, a_second, along.norm(), 0), base_(base), along_(along) {}
  Vector3d velocity(double q) const override { return base_ + q * along_; }
  Vector3d slope(double) const override { return along_; }
  Vector3d way(double q) const override { return duration(q) * (base_ + 0.5 * (start + q) * along_); }

 private:
  Vector3d base_, along_;
};

/// One pair of convex parts and a change: on for `wait`, then the change, then straight on until `until`.
/// With a normal n the gap of the plane less n.D is a smooth function of q at either end of the straight
/// part, with a bound of its second derivative, and linear between; so one normal frees q and all about it up
/// to where the parabola below it vanishes.
///
/// Displacements that hit are a convex set. At a value that hits there is a time within the horizon when the
/// bodies overlap; between two such values and times the displacement is near the straight line between both,
/// so a range is hit where balls about its ends are in that set.
class OfManoeuvre : public Question {
 public:
  /// `parts`: of the whole range, between two hits what is narrower than one of so many is not looked at.
  /// `hits`: whether ranges that hit are to be proved.
  OfManoeuvre(const Part& part, double margin, const Change& change, double wait, double until,
              const Range& range, int parts, bool hits)
      : part_(part),
        pair_(part.swollen()),
        margin_(margin),
        other_(part.velocity),
        change_(change),
        before_(wait * (change.velocity(change.start) - part.velocity)),
        until_(until - wait),
        finest_((range.to - range.from) / parts),
        hits_(hits) {
    clear_ = {clear_to(range.from), clear_to(range.to)};
    hit_ = {hit_from(clear_.from, range.from), hit_from(clear_.to, range.to)};
  }

  std::optional<Range> free_about(double q) const override {
    if (q < clear_.from || q > clear_.to) return std::nullopt;
    const double left = until_ - change_.duration(q);
    // What is reached only after the horizon: the change itself is clear.
    if (left <= 0) return q < change_.start ? Range{clear_.from, q} : Range{q, clear_.to};
    const Vector3d w = change_.velocity(q) - other_, start = displacement(q), end = start + left * w;
    const auto normal = pair_.normal_along(start, end);
    if (!normal) return std::nullopt;
    // Turned away from w as far as the plane still holds at the start, and a part of that.
    const Vector3d back = w.isZero(0) ? w : Vector3d(w.normalized());
    const auto at_start = [&](double turn) {
      const Vector3d n = *normal - turn * back;
      return room(n) - n.dot(start);
    };
    double most = 0;
    if (const double here = at_start(0); here > 0 && !back.isZero(0)) {
      double low = 0, high = 1;
      while (high < 1e3 && at_start(high) > 0) low = high, high *= 8;
      for (int step = 0; step < 12; ++step) {
        const double between = 0.5 * (low + high);
        (at_start(between) > 0 ? low : high) = between;
      }
      most = low;
    }
    std::optional<Range> best;
    for (const double part : {0.0, 0.25, 0.5, 0.75, 0.9, 0.97, 0.99, 0.997, 0.999}) {
      const auto range = about(q, *normal - part * most * back, left, w, start, end);
      if (range && (!best || range->to - range->from > best->to - best->from)) best = range;
      if (most == 0) break;
    }
    return best;
  }

  bool is_hit(double q) const override {
    if (q <= hit_.from || q >= hit_.to) return true;
    const double left = until_ - change_.duration(q);
    if (left <= 0) return false;
    Placed moved = pair_.agent();
    moved.pose.position += displacement(q);
    return meets(Pair(moved, pair_.obstacle()).verdict(change_.velocity(q), other_, {0, left}));
  }
  bool all_hit(double from, double to) const override {
    if (!hits_) return false;
    if (to <= hit_.from || from >= hit_.to) return true;
    if (from < change_.start && to > change_.start) return false;
    const auto first = overlap(from), last = overlap(to);
    if (!first || !last) return false;
    // The second derivative of the displacement along the line of values and times.
    const double width = to - from, slope = width > 0 ? std::abs(*last - *first) / width : 0;
    const double bend =
        until_ * change_.bend_size + change_.slope_size / change_.rate + 2 * slope * change_.slope_size;
    const double off = 0.125 * bend * width * width * (1 + 1e-9);
    return overlaps(at(from, *first), off) && overlaps(at(to, *last), off);
  }
  double finest_between_hits() const override { return finest_; }

 private:
  /// Displacement of the agent, seen from the obstacle, a time after `wait` that is not before the change to
  /// q is done.
  Vector3d at(double q, double time) const {
    return displacement(q) + (time - change_.duration(q)) * (change_.velocity(q) - other_);
  }

  /// After a displacement, seen from the obstacle: a second of that velocity, and no sooner.
  bool overlap_at(const Vector3d& displacement) const {
    return meets(pair_.verdict(displacement, Vector3d::Zero(), {1, 1}));
  }

  /// Whether all displacements within `off` of one, and of its rounding, surely make the bodies overlap: the
  /// corners of an octahedron about that ball do.
  bool overlaps(const Vector3d& displacement, double off) const {
    const double size = until_ * (change_.velocity(change_.start).norm() + other_.norm()) +
                        pair_.agent().pose.position.norm() + displacement.norm();
    const double corner = std::sqrt(3.0) * (off + kRoundings * size) * (1 + 1e-12);
    for (int k = 0; k < 6; ++k) {
      if (!overlap_at(displacement + (k % 2 == 0 ? corner : -corner) * Vector3d::Unit(k / 2))) return false;
    }
    return true;
  }

  /// A time after the change to q, in the middle of those when they overlap within the horizon.
  std::optional<double> overlap(double q) const {
    const double done = change_.duration(q), left = until_ - done;
    if (!(left > 0)) return std::nullopt;
    Placed moved = pair_.agent();
    moved.pose.position += displacement(q);
    const auto contact = Pair(moved, pair_.obstacle()).contact(change_.velocity(q), other_);
    if (!contact || !(contact->latest < left)) return std::nullopt;
    double over = contact->latest, apart = left;
    const auto overlapping = [&](double time) { return overlap_at(at(q, done + time)); };
    if (overlapping(left)) {
      over = left;
    } else {
      // From outside a few parts of what is left, then by halves.
      for (int step = 0; step < 24; ++step) {
        const double between = 0.5 * (over + apart);
        (overlapping(between) ? over : apart) = between;
        if (over > contact->latest && apart - over < 0.25 * (over - contact->latest)) break;
      }
    }
    return done + 0.5 * (contact->latest + over);
  }

  /// Beyond where the change is clear: from where on it hits itself, so that all farther values do.
  double hit_from(double clear, double end) const {
    const double side = end < change_.start ? -1 : 1, none = side * kInfinity;
    if (!hits_ || std::isinf(change_.rate) || clear == end) return none;
    const auto hits = [&](double q) {
      return side * (end - q) >= 0 && change_.duration(q) <= until_ && overlaps(displacement(q), 0);
    };
    double low = clear, step = 1e-9;
    while (step < std::abs(end - clear) && !hits(clear + side * step)) step *= 2;
    double high = clear + side * step;
    if (!hits(high)) return none;
    for (int k = 0; k < 30; ++k) {
      const double between = 0.5 * (low + high);
      (hits(between) ? high : low) = between;
    }
    return high;
  }

  /// Less the margin.
  double room(const Vector3d& n) const { return part_.pair.gap(n) - margin_ * n.norm() * (1 + 0x1p-48); }

  Vector3d displacement(double q) const {
    if (std::isinf(change_.rate)) return before_;
    return before_ + change_.way(q) - change_.duration(q) * other_;
  }

  /// Where value + slope x - bend x^2 / 2 surely stays positive, on both sides of 0.
  struct Reach {
    double down, up;
  };
  static Reach reach(double value, double slope, double bend) {
    const double root = std::sqrt(slope * slope + 2 * bend * value);
    const auto to =
        [&](double towards) {  // the root of value + towards x - bend x^2 / 2, without cancellation
          return towards >= 0 ? (bend > 0 ? (towards + root) / bend : kInfinity)
                              : 2 * value / (root - towards);
        };
    return {to(-slope), to(slope)};
  }

  std::optional<Range> about(double q, const Vector3d& n, double left, const Vector3d& w,
                             const Vector3d& start, const Vector3d& end) const {
    const double size = n.norm(), per_second = std::isinf(change_.rate) ? 0 : 1 / change_.rate;
    const double gap = room(n), slack = kRoundings * size *
                                        (start.norm() + end.norm() + until_ * (w.norm() + other_.norm()));
    const double at_start = gap - n.dot(start) - slack, at_end = gap - n.dot(end) - slack;
    if (!(at_start > 0 && at_end > 0)) return std::nullopt;
    const double side = q < change_.start ? -1 : 1;
    const Reach first =
                    reach(at_start, -n.dot(w) * side * per_second, size * change_.slope_size * per_second),
                last = reach(at_end, -left * n.dot(change_.slope(q)),
                             size * (until_ * change_.bend_size + change_.slope_size * per_second));
    constexpr double kShort = 1 - 1e-9;  // for all that was rounded on the way
    Range range{q - kShort * std::min(first.down, last.down), q + kShort * std::min(first.up, last.up)};
    // The change to the other side is another function.
    if (per_second > 0) {
      if (q >= change_.start) range.from = std::max(range.from, change_.start);
      if (q <= change_.start) range.to = std::min(range.to, change_.start);
    }
    return Range{std::max(range.from, clear_.from), std::min(range.to, clear_.to)};
  }

  /// How far towards `end` the change itself is proved to be clear.
  double clear_to(double end) const {
    if (std::isinf(change_.rate)) return end;
    const double side = end < change_.start ? -1 : 1;
    double q = change_.start;
    for (int step = 0; step < 500 && side * (end - q) > 0 && change_.duration(q) < until_; ++step) {
      const Vector3d at = displacement(q), w = change_.velocity(q) - other_;
      const auto n = pair_.normal_along(at, at);
      if (!n) break;
      const double slack = kRoundings * n->norm() * (at.norm() + until_ * (w.norm() + other_.norm()));
      const double value = room(*n) - n->dot(at) - slack;
      if (!(value > 0)) break;
      // In time.
      const double time = reach(value, -n->dot(w), n->norm() * change_.slope_size * change_.rate).up;
      const double next = q + side * (1 - 1e-9) * time * change_.rate;
      if (!(side * (next - q) > 1e-9)) break;
      q = next;
    }
    return side * (end - q) > 0 && change_.duration(q) < until_ ? q : end;
  }

  const Part& part_;
  const Pair& pair_;  // with less than the margin around the agent
  double margin_;
  Vector3d other_;
  const Change& change_;
  Vector3d before_;
  double until_, finest_;
  bool hits_;
  Range clear_, hit_;  // values up to which the change itself is clear; beyond which it hits
};

}  // namespace vericone::guidance::banding
