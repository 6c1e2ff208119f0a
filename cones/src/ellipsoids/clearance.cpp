// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/ellipsoids/clearance.h>

#include <vericone/cones/cone_geometry.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/ellipsoids/contact_frame.h>
#include <vericone/internal/geometry/lengths.h>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "ellipsoids/velocity_difference.h"

namespace vericone {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using ShadowFactor = Eigen::Matrix<double, 2, 3>;

constexpr double kDistant =
    1e20;  // beyond these times the width of the bodies their distance is that of points

constexpr double kFast = VelocityDifference::kFast;

/// g on the unit circle of normals perpendicular to w, as a function of the angle.
class ShadowGap {
 public:
  ShadowGap(const Ellipsoid& a, const Ellipsoid& b, const AxisFrame& frame) {
    Eigen::Matrix<double, 2, 3> e;
    e << frame.e1.transpose(), frame.e2.transpose();
    a_ = e * a.factor();
    b_ = e * b.factor();
    c_ = e * (b.center() - a.center());
    if (const double c = c_.cwiseAbs().maxCoeff(); c > kLargest && std::isfinite(c)) {
      exponent_ = std::ilogb(c);
      for (auto* entries : {a_.data(), b_.data()})
        for (int i = 0; i < 6; ++i) entries[i] = std::ldexp(entries[i], -exponent_);
      for (double& x : c_) x = std::ldexp(x, -exponent_);
    }
  }

  /// g in metres.
  double metres(double g) const { return std::ldexp(g, exponent_); }

  /// What the bodies are wide is below the rounding of the distance between the shadows: the normal is along
  /// it.
  bool distant() const {
    return c_.cwiseAbs().maxCoeff() > kDistant * (a_.cwiseAbs().maxCoeff() + b_.cwiseAbs().maxCoeff());
  }
  Vector2d center_line() const { return c_.stableNormalized(); }
  double center_distance() const { return detail::length(c_); }

  /// Whether doubles near the normal n resolve g to some nine digits. Of shadows with an axis ratio beyond
  /// 1e16 they need not: the next normal may be one of a width that is larger by orders of magnitude.
  bool resolves(const Vector2d& n) const {
    const Value v = at(n);
    return std::abs(v.slope) * std::numeric_limits<double>::epsilon() <=
           1e-9 * std::abs(v.g) + 1e-15 * c_.cwiseAbs().maxCoeff();
  }

  struct Value {
    double g, slope, curvature;  // and derivatives by the angle
  };

  static Vector2d normal(double angle) { return {std::cos(angle), std::sin(angle)}; }
  Value at(double angle) const { return at(normal(angle)); }
  Value at(const Vector2d& n) const {
    const Vector2d t(-n.y(), n.x());
    Value v{n.dot(c_), t.dot(c_), 0};
    for (const ShadowFactor* f : {&a_, &b_}) {
      const Vector3d u = f->transpose() * n, u_t = f->transpose() * t;
      const double rho = u.norm(), slope = u.dot(u_t) / rho;
      v.g -= rho;
      v.slope -= slope;
      v.curvature -= (u_t.squaredNorm() - slope * slope) / rho;
    }
    v.curvature -= v.g;  // n'' = -n and g is homogeneous
    return v;
  }

  /// A starting angle with g > 0 if the shadows are apart; nothing otherwise.
  std::optional<double> separating_angle() const {
    const ContactFrame<2> frame(square_factor(a_), square_factor(b_), c_);
    if (!(frame.contact > 1)) return std::nullopt;
    const Vector2d n = frame.separating_normal();
    const double angle = std::atan2(n.y(), n.x());
    return at(angle).g > 0 ? std::optional(angle) : std::nullopt;
  }

  /// Where g > 0 its second derivative is negative: one maximum, Newton climbs to it.
  double climb(double angle) const {
    Value v = at(angle);
    for (int iteration = 0; iteration < 60; ++iteration) {
      double step = std::clamp(-v.slope / v.curvature, -0.5, 0.5);
      Value next = at(angle + step);
      while (next.g < v.g && std::abs(step) > 1e-15) {
        step /= 2;
        next = at(angle + step);
      }
      if (next.g < v.g) break;
      angle += step;
      v = next;
      if (std::abs(step) < 1e-12) break;
    }
    // g is stationary here and says nothing about the last half of the angle's digits; its slope does.
    const double last = -v.slope / v.curvature;
    return v.curvature < 0 && std::abs(last) < 1e-6 ? angle + last : angle;
  }

  /// Global maximum where g may be negative: every sign change of the slope from + to - on a grid that
  /// contains the thin directions of both shadows, where rho has a narrow notch.
  Vector2d search() const {
    constexpr int kUniform = 48;
    const auto wrapped = [](double angle) {
      return angle - 2 * std::numbers::pi * std::floor(angle / (2 * std::numbers::pi));
    };
    std::array<double, kUniform + 5> grid;
    int count = 0;
    for (; count < kUniform; ++count) grid[count] = 2 * std::numbers::pi * count / kUniform;
    for (const ShadowFactor* f : {&a_, &b_}) {
      const Matrix2d s = *f * f->transpose();
      const double long_axis = 0.5 * std::atan2(2 * s(0, 1), s(0, 0) - s(1, 1));
      for (int k : {1, 3}) grid[count++] = wrapped(long_axis + k * std::numbers::pi / 2);
    }
    grid[count] = wrapped(std::atan2(c_.y(), c_.x()));
    std::sort(grid.begin(), grid.end());
    double best = grid[0], best_g = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < grid.size(); ++i) {
      double lo = grid[i], hi = i + 1 < grid.size() ? grid[i + 1] : grid[0] + 2 * std::numbers::pi;
      const Value at_lo = at(lo);
      if (at_lo.g > best_g) {
        best_g = at_lo.g;
        best = lo;
      }
      if (!(at_lo.slope > 0) || !(at(hi).slope < 0)) continue;
      double angle = 0.5 * (lo + hi);
      for (int iteration = 0; iteration < 80 && hi - lo > 1e-14; ++iteration) {
        const Value v = at(angle);
        (v.slope > 0 ? lo : hi) = angle;
        const double newton = angle - v.slope / v.curvature;
        angle = newton > lo && newton < hi ? newton : 0.5 * (lo + hi);
      }
      if (const double g = at(angle).g; g > best_g) {
        best_g = g;
        best = angle;
      }
    }
    // An angle has too few digits for the notch of a very thin shadow; its direction is a column of the
    // shape.
    Vector2d best_normal = normal(best);
    for (const ShadowFactor* f : {&a_, &b_}) {
      const Matrix2d s = *f * f->transpose();
      const Vector2d long_axis = s.col(s(0, 0) >= s(1, 1) ? 0 : 1).stableNormalized();
      for (const double side : {1.0, -1.0}) {
        const Vector2d n(-side * long_axis.y(), side * long_axis.x());
        if (const double g = at(n).g; g > best_g + 1e-12 * std::abs(best_g)) {
          best_g = g;
          best_normal = n;
        }
      }
    }
    return best_normal;
  }

 private:
  static constexpr double kLargest = 1e140;  // squares beyond leave the doubles

  /// A square factor with the same shape, by Gram-Schmidt on the rows.
  static Matrix2d square_factor(const ShadowFactor& f) {
    const double l11 = f.row(0).norm(), l21 = f.row(1).dot(f.row(0)) / l11;
    const double l22 = (f.row(1) - (l21 / l11) * f.row(0)).norm();
    Matrix2d l;
    l << l11, 0, l21, l22;
    return l;
  }

  ShadowFactor a_, b_;
  Vector2d c_;
  int exponent_ = 0;  // of the unit of length
};

/// c - S_A n / rho_A - S_B n / rho_B: the vector between the supporting points, the gradient of g.
Vector3d support_difference(const Ellipsoid& a, const Ellipsoid& b, const Vector3d& n) {
  const Vector3d ua = a.factor().transpose() * n, ub = b.factor().transpose() * n;
  return b.center() - a.center() - a.factor() * (ua / ua.norm()) - b.factor() * (ub / ub.norm());
}

double gap(const Ellipsoid& a, const Ellipsoid& b, const Vector3d& n) {
  return n.dot(b.center() - a.center()) - a.radius(n) - b.radius(n);
}

void require_direction(const Vector3d& w) {
  if (!w.allFinite() || w.isZero(0))
    throw InputError("relative_velocity",
                     "[" + to_text(w.x()) + ", " + to_text(w.y()) + ", " + to_text(w.z()) + "]",
                     "finite and not zero");
}

}  // namespace

Clearance clearance(const Ellipsoid& a, const Ellipsoid& b, const Vector3d& w) {
  require_direction(w);
  if (w.cwiseAbs().maxCoeff() > kFast) {
    Clearance m = clearance(a, b, 0.125 * w);
    m.time *= 0.125;
    return m;
  }
  const double speed = detail::length(w);
  const AxisFrame frame(w / speed);
  const ShadowGap shadows(a, b, frame);
  Clearance m;
  Vector2d n;
  if (shadows.distant()) {
    n = shadows.center_line();
    m.distance = shadows.metres(shadows.center_distance());
  } else {
    const auto start = shadows.separating_angle();
    n = start ? shadows.normal(shadows.climb(*start)) : shadows.search();
    m.distance = shadows.metres(shadows.at(n).g);
    if (!start && !shadows.resolves(n)) m.distance = std::numeric_limits<double>::quiet_NaN();
  }
  m.normal = n.x() * frame.e1 + n.y() * frame.e2;
  m.time = support_difference(a, b, m.normal).dot(frame.axis) / speed;
  return m;
}

Separation separation(const Ellipsoid& a, const Ellipsoid& b) {
  const ContactFrame<3> frame(a, b);
  const Relation rel = relation<3>(a, b, frame);
  if (rel == Relation::overlapping) return {};
  const double far = frame.center_line.cwiseAbs().maxCoeff(),
               width = a.factor().cwiseAbs().maxCoeff() + b.factor().cwiseAbs().maxCoeff();
  if (far > kDistant * width)
    return {detail::length(frame.center_line), frame.center_line.stableNormalized()};
  if (far > 1e140 && std::isfinite(far)) {
    // The same in another unit of length, in which squares stay within the doubles.
    const int e = std::ilogb(far);
    const double scale = std::ldexp(1.0, -e);
    Separation scaled = separation(a.scaled(scale), b.scaled(scale));
    scaled.distance = std::ldexp(scaled.distance, e);
    return scaled;
  }
  Vector3d n = frame.separating_normal().normalized();
  double g = gap(a, b, n);
  if (rel == Relation::touching || !(g > 0)) return {0, n};
  // Newton on the unit sphere. Where g > 0 the Hessian -(H_A + H_B) - g I on the tangent plane is negative
  // definite, so the step climbs; it is halved until it does.
  for (int iteration = 0; iteration < 100; ++iteration) {
    const AxisFrame tangent(n);
    Eigen::Matrix<double, 3, 2> e;
    e << tangent.e1, tangent.e2;
    const Vector2d slope = e.transpose() * support_difference(a, b, n);
    Matrix2d hessian = g * Matrix2d::Identity();
    for (const Ellipsoid* body : {&a, &b}) {
      const Vector3d u = body->factor().transpose() * n;
      const Eigen::Matrix<double, 3, 2> fe = body->factor().transpose() * e;
      const double rho = u.norm();
      const Vector2d along = fe.transpose() * u / rho;
      hessian += (fe.transpose() * fe - along * along.transpose()) / rho;
    }
    const Vector2d step = hessian.inverse() * slope;
    double scale = std::min(1.0, 0.5 / step.norm());
    Vector3d next = (n + scale * (e * step)).normalized();
    // g is stationary at the end and says nothing about the last half of the normal's digits; the slope does.
    const auto steepness = [&](const Vector3d& at) { return support_difference(a, b, at).cross(at).norm(); };
    double next_g = gap(a, b, next);
    if (!(step.norm() < 1e-7 && steepness(next) < steepness(n))) {
      while (next_g < g && scale > 1e-12) {
        scale /= 2;
        next = (n + scale * (e * step)).normalized();
        next_g = gap(a, b, next);
      }
      if (!(next_g > g)) break;
    }
    n = next;
    g = next_g;
  }
  return {std::max(g, 0.0), n};
}

double contact_time(const Ellipsoid& a, const Ellipsoid& b, const Vector3d& w) {
  // Every ellipsoid |x - c|_{S_K(x)} <= 1 of the contact function contains K, so the ray enters it no later
  // than K; the last of these entries is the one into K. The entry time is a root of a quadratic and
  // quasi-concave in log x, and its derivative has the sign of that of f at the point of entry.
  const ContactFrame<3> frame(a, b);
  const Vector3d v = frame.to_frame * w;
  std::array<double, 3> cross;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    cross[i] = v(i) * frame.center(j) - v(j) * frame.center(i);
  }
  struct Entry {
    double time, phi;
  };
  const auto entry = [&](double log_x) {
    const double x = std::exp(log_x);
    double ww = 0, cw = 0, cc = -1;
    std::array<double, 3> d, k;
    for (int i = 0; i < 3; ++i) {
      const double s2 = frame.sigma(i) * frame.sigma(i);
      d[i] = 1 / (1 + x * s2);
      k[i] = x / (1 + x) * d[i];
      ww += k[i] * v(i) * v(i);
      cw += k[i] * v(i) * frame.center(i);
      cc += k[i] * frame.center(i) * frame.center(i);
    }
    // cw^2 - ww cc by Lagrange's identity: for distant bodies the two products agree in all their digits.
    double discriminant = ww;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      discriminant -= k[i] * k[j] * cross[i] * cross[i];
    }
    const double root = std::sqrt(std::max(discriminant, 0.0));
    const double t = cc / (cw + root);
    double aa = 0, bb = 0;
    for (int i = 0; i < 3; ++i) {
      const double n = (frame.center(i) - t * v(i)) * d[i], n2 = n * n;
      aa += n2;
      bb += n2 * frame.sigma(i) * frame.sigma(i);
    }
    return Entry{t, std::log(aa / bb) - 2 * log_x};
  };
  double lo = -std::log(frame.sigma.maxCoeff()), hi = -std::log(frame.sigma.minCoeff());
  double u = std::clamp(std::log(frame.ratio), lo, hi);
  Entry at = entry(u);
  // Secant between the ends of the bracket with the stale end's value halved (Illinois).
  double f_lo = 0, f_hi = 0;
  if (hi - lo > 1e-12) {
    f_lo = entry(lo).phi;
    f_hi = entry(hi).phi;
    int side = 0;
    for (int iteration = 0; iteration < 60 && hi - lo > 1e-9; ++iteration) {
      if (at.phi == 0) break;
      if (at.phi > 0) {
        lo = u;
        f_lo = at.phi;
        if (side == 1) f_hi /= 2;
        side = 1;
      } else {
        hi = u;
        f_hi = at.phi;
        if (side == -1) f_lo /= 2;
        side = -1;
      }
      double next = (lo * f_hi - hi * f_lo) / (f_hi - f_lo);
      if (!(next > lo && next < hi)) next = 0.5 * (lo + hi);
      const bool settled = std::abs(next - u) < 1e-9;
      u = next;
      at = entry(u);
      if (settled) break;
    }
  }
  // The supporting plane at the contact: every plane n gives the lower bound g(n) / n.w, and this one is the
  // largest, so an error in n enters squared.
  const double x = std::exp(u);
  Vector3d n;
  for (int i = 0; i < 3; ++i)
    n(i) = (frame.center(i) - at.time * v(i)) / (1 + x * frame.sigma(i) * frame.sigma(i));
  n = frame.to_frame.transpose() * n;
  const double closing = n.dot(w);
  if (closing > 1e-6 * n.norm() * w.norm()) return std::max(gap(a, b, n) / closing, 0.0);
  return std::max(at.time, 0.0);
}

double clearance_ahead(const ConeOracle& oracle, const Vector3d& v_a, const Vector3d& v_b) {
  constexpr double kLeast = std::numeric_limits<double>::min();  // rounding must not contradict the verdict
  const Vector3d w = VelocityDifference(v_a, v_b).w;
  switch (oracle.verdict(v_a, v_b)) {
    case Verdict::touching:
    case Verdict::on:
      return 0;
    case Verdict::overlapping:
      return w.isZero(0) ? 0 : std::min(clearance(oracle.a(), oracle.b(), w).distance, 0.0);
    case Verdict::in:
      return std::min(clearance(oracle.a(), oracle.b(), w).distance, -kLeast);
    case Verdict::out:
    case Verdict::undecided:  // never of ellipsoids
      break;
  }
  // Bodies that come nearest later than rounding explains are closing; otherwise the normal now tells.
  if (oracle.separating_normal().dot(w) > 0) {
    const Clearance c = clearance(oracle.a(), oracle.b(), w);
    const double far = (oracle.b().center() - oracle.a().center()).cwiseAbs().maxCoeff();
    if (c.time * w.cwiseAbs().maxCoeff() > 1e-3 * far) return std::max(c.distance, kLeast);
  }
  const Separation now = separation(oracle.a(), oracle.b());
  if (w.isZero(0) || !(now.normal.dot(w) > 0)) return std::max(now.distance, kLeast);
  return std::max(clearance(oracle.a(), oracle.b(), w).distance, kLeast);
}

}  // namespace vericone
