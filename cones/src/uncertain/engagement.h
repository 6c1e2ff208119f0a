// SPDX-License-Identifier: BSD-3-Clause
//
// Two convex bodies, their relative motion and its errors, as supports: rounded ones for searching, intervals
// for proofs.
#pragma once

#include <vericone/cones/uncertain/robust.h>
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "answers/interval_vector.h"
#include "ellipsoids/enclosed_pair.h"

namespace vericone::robust {

using Eigen::Matrix3d, Eigen::Vector3d;

inline IntervalVector3 exactly(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }
inline IntervalVector3 operator+(const IntervalVector3& x, const IntervalVector3& y) {
  return {x[0] + y[0], x[1] + y[1], x[2] + y[2]};
}
inline IntervalVector3 operator-(const IntervalVector3& x, const IntervalVector3& y) {
  return {x[0] - y[0], x[1] - y[1], x[2] - y[2]};
}
inline IntervalVector3 operator*(const Interval& s, const IntervalVector3& x) {
  return {s * x[0], s * x[1], s * x[2]};
}

/// A convex body about a reference point: an ellipsoid about its centre, or the hull of ellipsoids and of
/// balls about points, about the origin.
class Side {
 public:
  explicit Side(const Ellipsoid& body)
      : ellipsoid_(&body), enclosed_(EnclosedBody<3>(body, 0)), reach_(body.factor().norm()) {}
  Side(std::span<const Ellipsoid> parts, std::span<const Vector3d> points, double radius)
      : parts_(parts), points_(points), radius_(radius) {
    for (const Ellipsoid& part : parts_)
      reach_ = std::max(reach_, part.center().norm() + part.factor().norm());
    for (const Vector3d& x : points_) reach_ = std::max(reach_, x.norm() + radius_);
  }

  const Ellipsoid* ellipsoid() const { return ellipsoid_; }
  Vector3d center() const { return ellipsoid_ ? ellipsoid_->center() : Vector3d(Vector3d::Zero()); }
  /// No point is farther from the reference point, rounding aside.
  double reach() const { return reach_; }

  /// The point farthest along n.
  Vector3d farthest(const Vector3d& n) const {
    if (ellipsoid_) {
      const Vector3d u = ellipsoid_->factor().transpose() * n;
      return ellipsoid_->factor() * (u / u.norm());
    }
    Vector3d best = Vector3d::Zero();
    double most = -std::numeric_limits<double>::infinity();
    for (const Vector3d& x : points_)
      if (const double h = n.dot(x); h > most) most = h, best = x;
    if (radius_ > 0) best += n * (radius_ / n.norm()), most = n.dot(best);
    for (const Ellipsoid& part : parts_)
      if (const double h = part.support(n); h > most) most = h, best = part.support_point(n);
    return best;
  }

  /// h(n) about the reference point, for n exactly as it stands.
  Interval support(const Vector3d& n) const {
    if (ellipsoid_) return enclosed_->support(n).rho;
    double most = -std::numeric_limits<double>::infinity();
    for (const Vector3d& x : points_) most = std::max(most, n.dot(x));
    if (radius_ > 0) most += radius_ * n.norm();
    Interval h(most, 0x1p-48 * n.norm() * reach_);
    for (const Ellipsoid& part : parts_) {
      const Interval of_part =
          dot(exactly(n), exactly(part.center())) + EnclosedBody<3>(part, 0).support(n).rho;
      h = Interval::between(std::max(h.lo(), of_part.lo()), std::max(h.hi(), of_part.hi()));
    }
    return h;
  }

  /// Of an ellipsoid: whether it surely contains centre + y, inside.
  bool surely_contains(const IntervalVector3& y) const { return enclosed_->surely_contains(y); }

 private:
  const Ellipsoid* ellipsoid_ = nullptr;
  std::optional<EnclosedBody<3>> enclosed_;
  std::span<const Ellipsoid> parts_;
  std::span<const Vector3d> points_;
  double radius_ = 0, reach_ = 0;
};

/// An error set with a ball added to it.
struct Widened {
  const ErrorSet& set;
  double by = 0;

  double support(const Vector3d& n) const { return set.support(n) + (by > 0 ? by * n.norm() : 0); }
  Vector3d support_point(const Vector3d& n) const {
    Vector3d e = set.support_point(n);
    if (by > 0) e += n * (by / n.norm());
    return e;
  }
  double reach() const { return set.reach() + by; }
  bool none() const { return set.none() && !(by > 0); }
  Interval enclosed_support(const Vector3d& n) const {
    const IntervalVector3 m = exactly(n);
    Interval h = 0;
    if (set.radius() > 0 || by > 0) h = h + (Interval(set.radius()) + Interval(by)) * norm(m);
    for (const Matrix3d& f : set.factors())
      h = h + norm({dot(exactly(f.col(0)), m), dot(exactly(f.col(1)), m), dot(exactly(f.col(2)), m)});
    for (const Vector3d& g : set.segments()) {
      const Interval s = dot(exactly(g), m);
      h = h + (s.mid() < 0 ? Interval(-s.mid(), s.rad()) : s);
    }
    return h;
  }
};

/// At time t the bodies touch or overlap for the errors p, v where c + p - t (w + v) is in K = A - B, the
/// bodies about their reference points, h_K(n) = h_A(n) + h_B(-n).
struct Engagement {
  const Side &a, &b;
  Widened position, velocity;
  double horizon;
  Vector3d c, w;  // rounded
  IntervalVector3 exact_c, exact_w;
  bool resting;  // w = 0

  Engagement(const Side& side_a, const Side& side_b, const Vector3d& v_a, const Vector3d& v_b,
             Widened of_position, Widened of_velocity, double until)
      : a(side_a),
        b(side_b),
        position(of_position),
        velocity(of_velocity),
        horizon(until),
        c(b.center() - a.center()),
        w(v_a - v_b),
        exact_c(exactly(b.center()) - exactly(a.center())),
        exact_w(exactly(v_a) - exactly(v_b)),
        resting(v_a == v_b) {}

  /// The point of K farthest along n.
  Vector3d farthest(const Vector3d& n) const { return a.farthest(n) - b.farthest(-n); }
  double reach() const { return a.reach() + b.reach(); }

  /// Proves that n keeps its gap for every error.
  bool separates_all(const Vector3d& n) const {
    return stays_open(n, exact_c, exact_w, position.enclosed_support(n), velocity.enclosed_support(n),
                      resting && velocity.none());
  }
  /// The same for one error.
  bool separates(const Vector3d& n, const RelativeError& e) const {
    return stays_open(n, exact_c + exactly(e.position), exact_w + exactly(e.velocity), 0, 0,
                      resting && e.velocity.isZero(0));
  }

  /// Of two ellipsoids: proves that the error makes them overlap at time t, with center_a + x in both.
  bool overlap_at(double t, const Vector3d& x, const RelativeError& e) const {
    const IntervalVector3 q = exact_c + exactly(e.position) - Interval(t) * (exact_w + exactly(e.velocity));
    return a.surely_contains(exactly(x)) && b.surely_contains(exactly(x) - q);
  }

 private:
  bool stays_open(const Vector3d& n, const IntervalVector3& at, const IntervalVector3& moving,
                  const Interval& of_position, const Interval& of_velocity, bool for_ever) const {
    if (!(n.cwiseAbs().maxCoeff() > 0)) return false;
    const IntervalVector3 m = exactly(n);
    const Interval gap = dot(m, at) - a.support(n) - b.support(-n) - of_position;
    if (for_ever || !gap.positive()) return gap.positive();
    const Interval closing = dot(m, moving) + of_velocity;
    return closing.hi() <= 0 || (std::isfinite(horizon) && (gap - Interval(horizon) * closing).positive());
  }
};

}  // namespace vericone::robust
