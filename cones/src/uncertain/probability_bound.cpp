// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/cones/uncertain/probability.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/geometry/decompositions.h>
#include <vericone/internal/geometry/double_double.h>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "uncertain/covariance.h"
#include "uncertain/engagement.h"

namespace vericone {
namespace gaussian {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;

constexpr double kEndless = std::numeric_limits<double>::infinity();

/// log Phi(-x).
double log_tail(double x) {
  if (x < 30) return std::log(0.5 * std::erfc(x / std::numbers::sqrt2));
  return -0.5 * x * x - std::log(x * std::sqrt(2 * std::numbers::pi)) - 1 / (x * x);
}

/// n^T m n from above, whatever cancels.
double form_from_above(const Vector3d& n, const Matrix3d& m) {
  DoubleDouble sum = 0;
  double size = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const DoubleDouble term = DoubleDouble::two_product(n(i), n(j)) * DoubleDouble(m(i, j));
      sum = sum + term;
      size += std::abs(term.hi);
    }
  return (sum.hi + sum.lo) + 0x1p-90 * size + std::numeric_limits<double>::min();
}

class Planes {
 public:
  Planes(const Ellipsoid& a, const Ellipsoid& b, const Vector3d& w, const JointCovariance& errors,
         double horizon)
      : a_(a),
        b_(b),
        side_a_(a),
        side_b_(b),
        c_(b.center() - a.center()),
        w_(w),
        errors_(errors),
        horizon_(horizon) {
    if (std::isfinite(horizon))
      late_ = errors.position - horizon * (errors.cross + errors.cross.transpose()) +
              horizon * horizon * errors.velocity;
    size_ = c_.norm() + a.factor().norm() + b.factor().norm();
    speed_ = w.norm();
    along_ = speed_ > 0     ? Vector3d(w / speed_)
             : c_.isZero(0) ? Vector3d(Vector3d::UnitX())
                            : c_.unitOrthogonal();
    root_of_position_ = root(errors.position);
    root_of_velocity_ = root(errors.velocity);
    root_late_ = root(late_);
  }

  /// The bound of n, proved.
  double bound(const Vector3d& n) const {
    using robust::exactly, robust::operator-;
    const IntervalVector3 m = exactly(n);
    const Interval gap =
        dot(m, exactly(b_.center()) - exactly(a_.center())) - side_a_.support(n) - side_b_.support(-n);
    if (!gap.positive()) return 1;
    const double of_position = form_from_above(n, errors_.position);
    const double of_velocity = form_from_above(n, errors_.velocity);
    const Interval closing = w_.isZero(0) ? Interval(0) : dot(m, exactly(w_));
    double later = tail(-closing.hi(), of_velocity, errors_.velocity.isZero(0));
    if (std::isfinite(horizon_)) {
      const DoubleDouble t = horizon_;
      // s_p^2 - 2 T n.X n + T^2 s_v^2, from above.
      const double cross = form_from_above(n, -errors_.cross);
      const double terms = of_position + 2 * horizon_ * std::abs(cross) + horizon_ * horizon_ * of_velocity;
      const DoubleDouble v =
          DoubleDouble(of_position) + t * (DoubleDouble(2 * cross) + t * DoubleDouble(of_velocity));
      later = std::min(later, tail((gap - Interval(horizon_) * closing).lo(),
                                   std::max(0.0, double(v)) + 0x1p-50 * terms, is_known()));
    }
    return std::min(1.0, (tail(gap.lo(), of_position, errors_.position.isZero(0)) + later) * (1 + 0x1p-50));
  }

  /// What is searched for: smaller is better, log of the bound where that is below 1. `late`: the plane that
  /// is open at the horizon rather than for ever.
  double value(const Vector3d& n, bool late) const {
    const double length = n.norm(), gap = n.dot(c_) - a_.radius(n) - b_.radius(n), closing = n.dot(w_);
    if (!(gap > 0)) return 100 - gap / size_;
    const double now = margin(gap, (root_of_position_ * n).norm());
    const double later = late ? margin(gap - horizon_ * closing, (root_late_ * n).norm())
                              : margin(-closing - 1e-15 * length * speed_, (root_of_velocity_ * n).norm());
    const double x = log_tail(now), y = log_tail(later), most = std::max(x, y), least = std::min(x, y);
    // On, where the tail has no slope any more.
    const double beyond = -6 - later;
    const double lost = later < -1e100 ? 50 + 20 * std::atan(closing / speed_)
                        : beyond > 0   ? beyond / (1 + beyond / 40)
                                       : 0;
    return (std::isfinite(most) ? most + std::log1p(std::exp(least - most)) : most) + lost;
  }

  ProbabilityBound best() {
    const bool bounded = std::isfinite(horizon_);
    for (const bool late : {false, true}) {
      if (late && !bounded) break;
      search(late);
    }
    found_.most = std::min(found_.most, 1.0);
    if (found_.most >= 1) found_.normal = Vector3d::Zero();
    return found_;
  }

 private:
  static double margin(double gap, double deviation) {
    if (deviation > 0) return std::clamp(gap / deviation, -1e150, 1e150);
    return gap >= 0 ? 1e150 : -1e150;
  }
  /// R with R^T R = m, whose small eigenvalues are not lost beside the large ones.
  static Matrix3d root(const Matrix3d& m) {
    const SymmetricEigen<3> solved = symmetric_eigen<3>(m);
    return solved.values.cwiseMax(0).cwiseSqrt().asDiagonal() * solved.vectors.transpose();
  }
  /// That a normal error takes a margin away, from above.
  static double tail(double margin, double variance, bool known) {
    if (known) return margin >= 0 ? 0 : 1;
    const double x = margin / std::sqrt(variance * (1 + 0x1p-48));
    const double p = 0.5 * std::erfc(x / std::numbers::sqrt2 - 0x1p-50 * std::abs(x));
    return p * (1 + 0x1p-48) + 4 * std::numeric_limits<double>::denorm_min();
  }
  bool is_known() const { return errors_.position.isZero(0) && errors_.velocity.isZero(0); }

  /// The least of f over t = unit sinh(q): golden section in q, as f has one valley.
  template <typename F>
  static std::pair<double, double> valley(double unit, double reach, double narrow, const F& f) {
    constexpr double kGolden = 0.6180339887498949;
    const double end = std::asinh(reach / unit);
    double low = -end, high = end;
    const auto at = [&](double q) { return f(unit * std::sinh(q)); };
    double p = high - kGolden * (high - low), q = low + kGolden * (high - low);
    double at_p = at(p), at_q = at(q);
    while (high - low > narrow) {
      if (at_p <= at_q) {
        high = q, q = p, at_q = at_p;
        at_p = at(p = high - kGolden * (high - low));
      } else {
        low = p, p = q, at_p = at_q;
        at_q = at(q = low + kGolden * (high - low));
      }
    }
    return at_p < at_q ? std::pair(unit * std::sinh(p), at_p) : std::pair(unit * std::sinh(q), at_q);
  }

  /// n turned against w or with it, to the best; looked for most closely at n, or where n is across w.
  Vector3d tilted(const Vector3d& n, bool late, bool from_level, double& value_there) const {
    const Vector3d level = from_level ? Vector3d(n - n.dot(along_) * along_) : n;
    const auto at = [&](double t) { return Vector3d(level - t * along_); };
    const auto [t, least] = valley(1e-15, 1e3, 0.02, [&](double tilt) { return value(at(tilt), late); });
    value_there = least;
    const double plain = value(n, late);
    if (plain <= least) value_there = plain;
    return plain <= least ? n : at(t);
  }

  void search(bool late) {
    Vector3d best = Vector3d::Zero();
    double least = kEndless;
    const auto offer = [&](const Vector3d& n) {
      if (!n.allFinite() || !(n.norm() > 0)) return;
      double at = 0;
      const Vector3d m = tilted(n.normalized(), late, true, at);
      if (at < least) least = at, best = m.normalized();
    };
    starts(late, offer);
    offer(best_all_around(late));
    for (int round = 0; round < 8; ++round) {
      const double before = least;
      const Vector3d e = best.cross(along_).normalized();
      if (!e.allFinite()) break;
      Vector3d there = best;
      double at = least;
      const Vector3d centre = best;
      valley(1e-9, 1e3, 0.01, [&](double s) {
        double value_there = 0;
        const Vector3d n = tilted(Vector3d(centre + s * e), late, round % 2 != 0, value_there);
        if (value_there < at) at = value_there, there = n;
        return value_there;
      });
      if (at < least) least = at, best = there.normalized();
      if (round > 0 && !(least < before - 1e-3)) break;
    }
    const double proved = bound(best);
    if (proved < found_.most) found_.most = proved, found_.normal = best;
  }

  /// Of directions all around, as the errors of position measure them.
  Vector3d best_all_around(bool late) const {
    constexpr int kDirections = 200;
    const Matrix3d& root = late ? root_late_ : root_of_position_;
    const Matrix3d metric = root + 1e-9 * root.norm() * Matrix3d::Identity();
    const Eigen::PartialPivLU<Matrix3d> solver(metric);
    Vector3d best = c_;
    double least = kEndless;
    for (int i = 0; i < kDirections; ++i) {
      const double z = 1 - (2.0 * i + 1) / kDirections, r = std::sqrt(1 - z * z),
                   t = std::numbers::pi * (3 - std::sqrt(5.0)) * i;
      const Vector3d m(r * std::cos(t), r * std::sin(t), z);
      for (const Vector3d& n : {m, Vector3d(solver.solve(m).normalized())})
        if (const double at = value(n, late); at < least) least = at, best = n;
    }
    return best;
  }

  /// The normal of the clearance, the line of centres, and those of the nearest points as the errors measure
  /// distance, now, at the horizon and for ever.
  template <typename Offer>
  void starts(bool late, const Offer& offer) const {
    offer(c_);
    if (speed_ > 0) {
      const Vector3d u = w_.normalized(), level = c_ - c_.dot(u) * u;
      offer(level);
      offer(clearance(a_, b_, w_).normal);
    }
    if (late) offer(c_ - horizon_ * w_);
    for (const Matrix3d* m : {&errors_.position, late ? &late_ : nullptr}) {
      if (!m || m->isZero(0)) continue;
      const Matrix3d metric = *m + 1e-12 * m->trace() * Matrix3d::Identity();
      const Cholesky<3> solver = cholesky<3>(metric);
      for (const bool along : {false, true}) {
        // Without what the motion passes through anyway.
        Vector3d n = solver.solve(c_);
        for (int i = 0; i < 8; ++i) {
          Vector3d apart = c_ - side_a_.farthest(n) + side_b_.farthest(-n);
          if (along) {
            const Vector3d q = solver.solve(w_);
            const double t = w_.dot(q);
            if (t > 0) apart -= (apart.dot(q) / t) * w_;
          }
          n = solver.solve(apart).normalized();
          if (!n.allFinite()) break;
          if (i % 3 == 1) offer(n);
        }
      }
    }
  }

  const Ellipsoid &a_, &b_;
  robust::Side side_a_, side_b_;
  Vector3d c_, w_, along_;
  const JointCovariance& errors_;
  double horizon_, size_, speed_;
  Matrix3d late_ = Matrix3d::Zero(), root_of_position_, root_of_velocity_, root_late_;
  ProbabilityBound found_;
};

}  // namespace
}  // namespace gaussian

ProbabilityBound collision_probability_bound(const Ellipsoid& a, const Ellipsoid& b, const Eigen::Vector3d& w,
                                             const GaussianErrors& errors, double horizon) {
  if (!w.allFinite()) throw InputError("relative_velocity", to_text(w.norm()), "finite (m/s)");
  if (!(horizon > 0)) throw InputError("horizon", to_text(horizon), "a positive number (s), or infinity");
  const gaussian::JointCovariance covariance(errors.position, errors.velocity, errors.cross);
  ProbabilityBound found = gaussian::Planes(a, b, w, covariance, horizon).best();
  found.clipped = covariance.clipped;
  return found;
}

}  // namespace vericone
