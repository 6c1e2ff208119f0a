// SPDX-License-Identifier: BSD-3-Clause
//
// Two ellipsoids within a horizon (docs/explanation/predicates/horizon.md). First rung: the plane and the
// forms prepared for all velocities. Second: a plane with the whole way on its far side, or a point of both
// bodies at one time of it. Last: where the ends of the way lie along the line of motion, in integers.
#include <vericone/cones/ellipsoids/predicates.h>
#include <vericone/internal/cones/ellipsoids/contact_frame.h>
#include <vericone/internal/cones/ellipsoids/rungs.h>
#include <cmath>
#include <limits>

#include "answers/stretch.h"
#include "ellipsoids/contact_polynomial.h"
#include "ellipsoids/enclosed_pair.h"
#include "ellipsoids/line_meets.h"
#include "ellipsoids/velocity_forms.h"
#include "ellipsoids/within.h"

namespace vericone {
namespace {

using Eigen::Vector3d;
using IntervalVector = std::array<Interval, 3>;

Vector3d middle(const IntervalVector& v) { return {v[0].mid(), v[1].mid(), v[2].mid()}; }

Interval dot(const Vector3d& n, const IntervalVector& v) {
  return Interval(n.x()) * v[0] + Interval(n.y()) * v[1] + Interval(n.z()) * v[2];
}

/// The way d_0 + s (d_1 - d_0), 0 <= s <= 1, in the units of a pair.
struct EnclosedWay {
  IntervalVector start, end;
  bool usable = true;

  EnclosedWay(const Stretch& stretch, const EnclosedPair<3>& pair) {
    start = scaled(stretch.way(stretch.from), pair.exponent);
    double until = stretch.until;
    if (std::isinf(until)) {
      // Twice what is enough: all of K is as near as both bodies and the line of centres are long.
      const double reach = pair.center_line.norm() + pair.factor_a.norm() + pair.factor_b.norm();
      const double speed = middle(scaled(stretch.velocity(), pair.exponent)).norm();
      until = stretch.from + 2 * (reach + middle(start).norm()) / speed;
    }
    end = scaled(stretch.way(until), pair.exponent);
    for (int k = 0; k < 3; ++k) usable = usable && start[k].finite() && end[k].finite();
  }

  IntervalVector at(double s) const {
    IntervalVector d;
    for (int k = 0; k < 3; ++k) d[k] = start[k] + Interval(s) * (end[k] - start[k]);
    return d;
  }

 private:
  static IntervalVector scaled(IntervalVector d, int exponent) {
    for (Interval& x : d) x = scaled_down(x, exponent);
    return d;
  }
};

/// The contact function at its least along the way, as a function of x = lambda / (1 - lambda): concave in
/// lambda, so one maximum. Above 1 anywhere it has a plane, and at the maximum below 1 a common point.
class Saddle {
 public:
  /// Of the way from `start` to `end`.
  Saddle(const ContactFrame<3>& frame, const Vector3d& start, const Vector3d& end)
      : frame_(frame),
        start_(frame.center - frame.to_frame * start),
        along_(frame.to_frame * (end - start)),
        square_(frame.sigma.cwiseAbs2()) {}

  /// Calls done() at one x after the other, beginning with x, until it says so or the maximum is reached.
  template <typename Done>
  void climb(double x, const Done& done) {
    constexpr int kMostSteps = 30;
    double low = 0, high = std::numeric_limits<double>::infinity();
    for (int step = 0; step < kMostSteps && x > 1e-100 && x < 1e100; ++step) {
      look_at(x);
      if (done()) return;
      const double next = std::sqrt(y_.squaredNorm() / y_.cwiseAbs2().dot(square_));
      if (!(std::abs(next - x) > 1e-14 * x)) return;
      (next > x ? low : high) = x;
      x = next > low && next < high ? next : low > 0 && std::isfinite(high) ? std::sqrt(low * high) : next;
    }
  }

  double value() const { return x_ / (1 + x_) * z_.dot(y_); }
  Vector3d normal() const { return frame_.to_frame.transpose() * y_; }

  double s() const { return s_; }
  bool is_common() const { return y_.squaredNorm() < 1 && x_ * x_ * y_.cwiseAbs2().dot(square_) < 1; }
  Vector3d point() const { return frame_.to_space * y_; }  // from A's centre

 private:
  /// The slope in x would vanish where |y| / |sigma y| is, if y did not change; that is above x where the
  /// value grows.
  void look_at(double x) {
    x_ = x;
    weight_ = (Vector3d::Ones() + x * square_).cwiseInverse();
    const double most = along_.cwiseAbs2().dot(weight_);
    s_ = most > 0 ? std::clamp(start_.cwiseProduct(along_).dot(weight_) / most, 0.0, 1.0) : 0;
    z_ = start_ - s_ * along_;
    y_ = z_.cwiseProduct(weight_);
  }

  const ContactFrame<3>& frame_;
  Vector3d start_, along_, square_, weight_, z_, y_;
  double x_ = 1, s_ = 0;
};

std::optional<Membership> interval_within(const Ellipsoid& a, const Ellipsoid& b, const Stretch& stretch) {
  const EnclosedPair<3> pair(a, b);
  if (!pair.usable) return std::nullopt;
  const EnclosedWay way(stretch, pair);
  if (!way.usable) return std::nullopt;
  const ContactFrame<3> frame(pair.factor_a, pair.factor_b, pair.center_line);
  Saddle saddle(frame, middle(way.start), middle(way.end));
  constexpr int kMostProofs = 4;
  int proofs = 0;
  std::optional<Membership> answer;
  saddle.climb(frame.ratio, [&] {
    if (saddle.value() > 1) {
      Vector3d n = saddle.normal();
      n /= n.cwiseAbs().maxCoeff();
      if (!n.allFinite()) return true;
      const Interval gap = pair.gap(n);
      if ((gap - dot(n, way.start)).positive() && (gap - dot(n, way.end)).positive())
        answer = Membership::out;
    } else if (saddle.is_common()) {
      const Vector3d y = saddle.point();
      const IntervalVector d = way.at(saddle.s());
      const IntervalVector of_a{y.x(), y.y(), y.z()};
      IntervalVector of_b;
      for (int k = 0; k < 3; ++k) of_b[k] = of_a[k] - (pair.c[k] - d[k]);
      if (pair.a.surely_contains(of_a) && pair.b.surely_contains(of_b)) answer = Membership::in;
    } else {
      return false;
    }
    return answer || ++proofs == kMostProofs;
  });
  return answer;
}

/// Where a time lies: with regard to the first contact, and with regard to the last; -1 before it, 0 at it, 1
/// after it. Of bodies whose line of motion meets.
struct Phase {
  int first, last;
};

Phase phase_at(exact::PairOnGrid<3> pair, const exact::Way& way, const exact::IntegerVector<3>& w) {
  for (int k = 0; k < 3; ++k) pair.c[k] -= way.on(k, pair.exponent);
  const int roots = exact::distinct_positive_roots(exact::contact_polynomial<3>(pair));
  if (roots == 0) return {1, -1};
  const int side = *exact::side_of_contact<3>(pair, w);
  if (roots == 1) return {side < 0 ? 1 : 0, side > 0 ? -1 : 0};
  return {-side, -side};
}

}  // namespace

std::optional<NearestPlane> nearest_plane(const ContactFrame<3>& frame, const Vector3d& start,
                                          const Vector3d& end) {
  Saddle saddle(frame, start, end);
  double most = 0;
  NearestPlane plane{Vector3d::Zero(), 0};
  saddle.climb(frame.ratio, [&] {
    if (const double value = saddle.value(); value > most) {
      const bool nearly = value < most * (1 + 1e-9);
      most = value;
      plane = {saddle.normal(), saddle.s()};
      return nearly;
    }
    return false;
  });
  if (!(most > 1)) return std::nullopt;
  return plane;
}

namespace exact {

Membership within(const Ellipsoid& a, const Ellipsoid& b, const Stretch& stretch) {
  const Way direction(stretch, 1);
  const Membership line = line_meets({a, b}, direction.of);
  if (line == Membership::out) return line;
  const auto at = [&](double time) {
    const Way way(stretch, time);
    return phase_at(PairOnGrid<3>(a, b, way.exponent), way, direction.of);
  };
  const int last = at(stretch.from).last, first = std::isinf(stretch.until) ? 1 : at(stretch.until).first;
  if (first > 0 && last < 0) return line;
  return first >= 0 && last <= 0 ? Membership::on : Membership::out;
}

}  // namespace exact

std::optional<Membership> interval_within(const Ellipsoid& a, const Ellipsoid& b, const Vector3d& v_a,
                                          const Vector3d& v_b, const Horizon& horizon) {
  return interval_within(a, b, Stretch{v_a, v_b, horizon.from, horizon.until});
}

Membership exact_within(const Ellipsoid& a, const Ellipsoid& b, const Vector3d& v_a, const Vector3d& v_b,
                        const Horizon& horizon) {
  return exact::within(a, b, Stretch{v_a, v_b, horizon.from, horizon.until});
}

Verdict ConeOracle::verdict(const Vector3d& v_a, const Vector3d& v_b, const Horizon& horizon,
                            Rung* rung) const {
  const Vector3d w = v_a - v_b;
  if (relation_ == Relation::disjoint && horizon.from >= 0 && horizon.until >= horizon.from) {
    // All that is on the far side of the prepared plane; the same for the whole line.
    const double slack = 8 * kUnitRoundoff * normal_size_ * w.cwiseAbs().maxCoeff();
    const bool before_plane = slack > 1e-280 && (normal_.dot(w) + slack) * horizon.until < room_;
    const auto side = certain_side(forms_, w);
    if (before_plane || side < 0) {
      decided_by<WithinHorizon>(Rung::triage, rung);
      return Verdict::out;
    }
    // What meets has met when it has gone as far as any of K is.
    if (side > 0 && horizon.from == 0 && w.cwiseAbs().maxCoeff() * (1 - 0x1p-40) * horizon.until > reach_) {
      decided_by<WithinHorizon>(Rung::triage, rung);
      return Verdict::in;
    }
  }
  if (rung && relation_ != Relation::disjoint) *rung = relation_rung_;
  return verdict_within(relation_, v_a, v_b, horizon, [&](const Stretch& stretch) {
    return to_verdict(climb<WithinHorizon>(
        rung, [] { return std::optional<Membership>(); }, [&] { return interval_within(a_, b_, stretch); },
        [&] { return exact::within(a_, b_, stretch); }));
  });
}

}  // namespace vericone
