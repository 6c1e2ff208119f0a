// SPDX-License-Identifier: BSD-3-Clause
#include "solids.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace vericone::swarm {

using Eigen::Matrix3d, Eigen::Vector3d;

namespace {

constexpr int kMostExchanged = 12;
constexpr double kStays = 1e-13;  // rad
constexpr double kNearly = 1e-7;
constexpr double kFine = 1e-3;  // rad: the parabola through three that are as near is right to its cube
constexpr double kAround = std::numbers::pi / 4;

struct Turned {
  Vector3d normal;
  bool cut;  // at the cut-off, the ball of velocities that touch just at the horizon
};

/// Of a ball of radius r about c, the outward normal of { v : t v in the ball, 0 < t <= horizon } nearest to
/// v (the paper's figure 2).
Turned of_ball(const Vector3d& c, double r, const Vector3d& v, double horizon) {
  const Vector3d w = v - c / horizon;
  const double length = w.norm();
  if (length > 0 && w.dot(c) + r * length <= 0) return {w / length, true};
  const double distance = c.norm();
  if (!(distance > r)) return {length > 0 ? Vector3d(w / length) : Vector3d(-c.unitOrthogonal()), true};
  const Vector3d ahead = c / distance;
  Vector3d aside = v - v.dot(ahead) * ahead;
  const double across = aside.norm();
  aside = across > 1e-12 * v.norm() ? Vector3d(aside / across) : ahead.unitOrthogonal();
  const double sine = r / distance;
  return {std::sqrt((1 - sine) * (1 + sine)) * aside - sine * ahead, false};
}

/// Normals of planes through the apex of the velocities that touch both bodies: one about each angle around
/// the way. All in the coordinates (ahead, e, f), in which `n` has none along f.
class AboutTheWay {
 public:
  AboutTheWay(const Vector3d& y, const Vector3d& n, const Matrix3d& a, const Matrix3d& b,
              const Matrix3d& speeds, const Vector3d& w)
      : distance_(y.norm()), sine_(-n.dot(y) / distance_) {
    axes_.col(0) = y / distance_;
    axes_.col(1) = e = (n + sine_ * axes_.col(0)).normalized();
    axes_.col(2) = axes_.col(0).cross(e);
    const auto seen = [&](const Matrix3d& matrix) { return Matrix3d(axes_.transpose() * matrix * axes_); };
    a_ = seen(a);
    b_ = seen(b);
    speeds_ = seen(speeds);
    w_ = axes_.transpose() * w;
  }

  Vector3d normal(double angle) const { return axes_ * here(angle); }
  /// m/s: how far w is on the good side of the plane.
  double outside(double angle) const {
    const Vector3d m = here(angle);
    return m.dot(w_) / std::sqrt(m.dot(speeds_ * m));
  }

  Vector3d e;

 private:
  /// Of a shape matrix what its width needs along (-s, k cos, k sin).
  struct Section {
    Section(const Matrix3d& m, double cosine, double sine)
        : ahead(m(0, 0)),
          mixed(m(0, 1) * cosine + m(0, 2) * sine),
          aside(m(1, 1) * cosine * cosine + 2 * m(1, 2) * cosine * sine + m(2, 2) * sine * sine) {}
    double ahead, mixed, aside;
  };

  Vector3d here(double angle) const {
    const double cosine = std::cos(angle), sine = std::sin(angle);
    const Section p(a_, cosine, sine), q(b_, cosine, sine);
    // Newton: the sine s of the angle off from across the way at which the width is s times the distance.
    double s = sine_;
    for (int k = 0; k < kMostExchanged; ++k) {
      const double c = std::sqrt(std::max(1e-30, (1 - s) * (1 + s)));
      const auto half = [&](const Section& of) {
        return std::sqrt(c * c * of.aside - 2 * c * s * of.mixed + s * s * of.ahead);
      };
      const auto rate = [&](const Section& of) {
        return -s * of.aside + (s * s / c - c) * of.mixed + s * of.ahead;
      };
      const double u = half(p), v = half(q);
      const double by = (u + v - s * distance_) / (distance_ - (rate(p) / u + rate(q) / v));
      s = std::clamp(s + by, -1.0, 1.0);
      if (!(std::abs(by) > kStays)) break;
    }
    const double c = std::sqrt(std::max(0.0, (1 - s) * (1 + s)));
    return {-s, c * cosine, c * sine};
  }

  double distance_, sine_;
  Matrix3d axes_, a_, b_, speeds_;
  Vector3d w_;
};

/// Lower triangular L with L L^T = s.
Matrix3d cholesky(const Matrix3d& s) {
  Matrix3d l = Matrix3d::Zero();
  l(0, 0) = std::sqrt(s(0, 0));
  l(1, 0) = s(1, 0) / l(0, 0);
  l(2, 0) = s(2, 0) / l(0, 0);
  l(1, 1) = std::sqrt(s(1, 1) - l(1, 0) * l(1, 0));
  l(2, 1) = (s(2, 1) - l(2, 0) * l(1, 0)) / l(1, 1);
  l(2, 2) = std::sqrt(s(2, 2) - l(2, 0) * l(2, 0) - l(2, 1) * l(2, 1));
  return l;
}

Matrix3d inverse_of_lower(const Matrix3d& l) {
  Matrix3d m = Matrix3d::Zero();
  for (int k = 0; k < 3; ++k) m(k, k) = 1 / l(k, k);
  m(1, 0) = -l(1, 0) * m(0, 0) * m(1, 1);
  m(2, 1) = -l(2, 1) * m(1, 1) * m(2, 2);
  m(2, 0) = -(l(2, 0) * m(0, 0) + l(2, 1) * m(1, 0)) * m(2, 2);
  return m;
}

}  // namespace

double Solid::reach() const { return box ? half.norm() : half.maxCoeff(); }

Prepared::Prepared(const Solid& solid)
    : axes(solid.rotation * solid.half.asDiagonal()),
      shape(axes * axes.transpose()),
      reach(solid.reach()),
      round(!solid.box && solid.half.x() == solid.half.y() && solid.half.x() == solid.half.z()),
      box(solid.box) {}

WorldBody world_body(const Solid& solid) {
  if (solid.box) return {HullBody::box(-solid.half, solid.half)};
  return {CombinedEllipsoid(Ellipsoid::from_axes(Vector3d::Zero(), solid.half))};
}

Solid turned(const Solid& solid, const Vector3d& by) {
  const double angle = by.norm();
  if (!(angle > 0)) return solid;
  Solid after = solid;
  const Eigen::Quaterniond q(Matrix3d(Eigen::AngleAxisd(angle, by / angle) * solid.rotation));
  after.rotation = q.normalized().toRotationMatrix();
  return after;
}

Vector3d normal_of_balls(const Prepared& a, const Prepared& b, const Vector3d& c, const Vector3d& v,
                         double horizon) {
  return of_ball(c, a.reach + b.reach, v, horizon).normal;
}

Between::Between(const Prepared& first, const Prepared& second)
    : first_(first), second_(second), round_(first.round && second.round) {
  if (round_ || second.box) return;
  from_ = cholesky(first.shape + second.shape);
  to_ = inverse_of_lower(from_);
  a_ = to_ * first.shape * to_.transpose();
  b_ = to_ * second.shape * to_.transpose();
}

Between::Tip Between::tip(const Vector3d& n) const {
  const Vector3d an = a_ * n, bn = b_ * n;
  const double p = std::sqrt(n.dot(an)), q = std::sqrt(n.dot(bn));
  // Half the trace of the support function's second derivative.
  const double bend =
      (a_.trace() - an.squaredNorm() / (p * p)) / p + (b_.trace() - bn.squaredNorm() / (q * q)) / q;
  return {an / p + bn / q, 0.5 * bend};
}

Vector3d Between::normal_to_box(const Vector3d& c) const {
  // The nearest point of the box, as the ellipsoid sees it: along one edge after the other.
  const Matrix3d seen = first_.axes.inverse();
  const Matrix3d edges = seen * second_.axes;
  Vector3d at = seen * c, along = Vector3d::Zero();
  for (int sweep = 0; sweep < 40; ++sweep) {
    double moved = 0;
    for (int k = 0; k < 3; ++k) {
      const Vector3d edge = edges.col(k);
      const double to = std::clamp(along(k) - at.dot(edge) / edge.squaredNorm(), -1.0, 1.0);
      moved = std::max(moved, std::abs(to - along(k)));
      at += (to - along(k)) * edge;
      along(k) = to;
    }
    if (moved < kStays) break;
  }
  const Vector3d n = seen.transpose() * at;
  return n.norm() > 0 ? n.normalized() : Vector3d(Vector3d::UnitX());
}

Vector3d Between::normal(const Vector3d& c) const {
  if (second_.box) return normal_to_box(c);
  if (round_) return c.norm() > 0 ? c.normalized() : Vector3d(Vector3d::UnitX());
  const Vector3d y = to_ * c;
  if (!(y.norm() > 0)) return Vector3d::UnitX();
  Vector3d n = y.normalized();
  for (int k = 0; k < kMostExchanged; ++k) {
    const Tip at = tip(n);
    const Vector3d other = (y - at.point + at.radius * n).normalized();
    const double turned = (other - n).norm();
    if (!(turned < 1)) break;
    n = other;
    if (turned < 1e-6) break;
  }
  return (to_.transpose() * n).normalized();
}

ReciprocalPlane Between::box_plane(const Vector3d& c, const Vector3d& v, double horizon) const {
  const Vector3d n = normal_to_box(c);
  return {-n, (gap(n, c) / horizon - n.dot(v)) * n};
}

ReciprocalPlane Between::plane(const Vector3d& c, const Vector3d& v, double horizon, Nearest nearest) const {
  if (second_.box) return box_plane(c, v, horizon);
  const Vector3d y = round_ ? c : Vector3d(to_ * c), w = round_ ? v : Vector3d(to_ * v);
  Turned turned = of_ball(y, round_ ? most() : 1.25, w, horizon);
  double width = most();
  if (!round_) {
    for (int k = 0; k < kMostExchanged; ++k) {
      // The velocities' set has its contact at the sum's farthest point along the normal.
      const Tip at = tip(turned.normal);
      const Turned other = of_ball(y + at.point - at.radius * turned.normal, at.radius, w, horizon);
      const double by = (other.normal - turned.normal).norm();
      turned = other;
      // What is nearest in speed is sought from there, anew.
      if (by < (nearest == Nearest::in_speed ? kNearly : kStays)) break;
    }
    if (nearest == Nearest::in_speed && !turned.cut) turned.normal = side(y, turned.normal, w);
    width = this->width(turned.normal);
  }
  const Vector3d& n = turned.normal;
  const double support = turned.cut ? (n.dot(y) + width) / horizon : 0, inside = support - n.dot(w);
  if (round_) return {n, inside * n};
  if (nearest == Nearest::in_shape) return {(to_.transpose() * n).normalized(), from_ * (inside * n)};
  const Vector3d normal = to_.transpose() * n;
  const double length = normal.norm();
  return {normal / length, inside / (length * length) * normal};
}

Vector3d Between::side(const Vector3d& y, const Vector3d& n, const Vector3d& w) const {
  const AboutTheWay about(y, n, a_, b_, to_ * to_.transpose(), w);
  // Of two that are as good: the one that is its mirror's where both bodies are exchanged.
  const double odd = about.e.x() != 0 ? about.e.x() : about.e.y() != 0 ? about.e.y() : about.e.z();
  double best = 0, most = about.outside(0);
  for (const double turns : {1.0, -1.0, 2.0, -2.0, 3.0, -3.0, 4.0}) {
    const double angle = turns * std::copysign(kAround, odd);
    if (const double here = about.outside(angle); here > most) {
      best = angle;
      most = here;
    }
  }
  double step = 0.5 * kAround;
  for (int looks = 0; looks < 20 && step > kFine; ++looks) {
    const double left = about.outside(best - step), right = about.outside(best + step);
    if (std::max(left, right) > most) {
      best += right > left || (right == left && odd > 0) ? step : -step;
      most = std::max(left, right);
      continue;
    }
    // The parabola through all three.
    if (const double bend = (left + right) - 2 * most; bend < 0) {
      const double by = std::clamp(0.5 * (left - right) / bend, -1.0, 1.0) * step;
      if (const double here = about.outside(best + by); here > most) {
        best += by;
        most = here;
      }
    }
    step *= 0.1;
  }
  return about.normal(best);
}

ReciprocalPlane reciprocal_plane(const Solid& first, const Solid& second, const Vector3d& between,
                                 const Vector3d& velocity, double horizon, Nearest nearest) {
  const Prepared a(first), b(second);
  return Between(a, b).plane(between, velocity, horizon, nearest);
}

}  // namespace vericone::swarm
