// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/guidance/pursuit/pursuit_law.h>
#include <vericone/internal/geometry/lengths.h>
#include <algorithm>
#include <cmath>

#include "pursuit/products.h"

namespace vericone::guidance {
namespace {

using Eigen::Vector2d;

struct Nearest {
  double distance;  // negative inside
  Vector2d normal;  // outward, unit
};

/// Of the ellipse with semi-axes a >= b > 0 along the axes, to a point.
Nearest nearest_on_ellipse(double a, double b, const Vector2d& point) {
  const Vector2d q = point.cwiseAbs();
  const double c2 = a * a - b * b;
  Vector2d at;
  if (c2 <= 1e-14 * a * a) {
    at = q.isZero(0) ? Vector2d(a, 0) : Vector2d(a * q.stableNormalized());
  } else if (q.y() > 0 || q.x() * a >= c2) {
    // The point is at + t (at.x / a^2, at.y / b^2); s = t + b^2, so that nothing cancels near the centre. F
    // is convex and falls: Newton's steps from where it is positive never pass the root.
    double s = std::max(b * q.y(), a * q.x() - c2);
    const auto scaled = [&] { return Vector2d(a * q.x() / (s + c2), q.y() > 0 ? b * q.y() / s : 0); };
    for (int i = 0; i < 100; ++i) {
      const Vector2d e = scaled();
      const double f = e.squaredNorm() - 1;
      const double slope = -2 * (e.x() * e.x() / (s + c2) + (q.y() > 0 ? e.y() * e.y() / s : 0));
      if (!(f > 0) || !(s - f / slope > s)) break;
      s -= f / slope;
    }
    at = {a * scaled().x(), b * scaled().y()};
  } else {
    // On the major axis, between the evolute's cusps.
    at.x() = a * a * q.x() / c2;
    at.y() = b * std::sqrt(std::max(0.0, 1 - at.x() * at.x() / (a * a)));
  }
  const double inside = std::hypot(q.x() / a, q.y() / b) - 1;
  Nearest found;
  found.distance = std::copysign((q - at).norm(), inside);
  found.normal =
      Vector2d(std::copysign(at.x() / (a * a), point.x()), std::copysign(at.y() / (b * b), point.y()));
  found.normal.normalize();
  return found;
}

/// The velocity wanted relative to the ellipse, and how fast it changes along w.
struct Wanted {
  Vector2d velocity, rate;

  Wanted(const Vector2d& x, const Vector2d& w, const PursuitGains& gains) {
    const double k = gains.distance, d = x.norm(), slower = 1 + k * k * d / gains.most;
    const double factor = k / std::sqrt(slower);
    velocity = -factor * x;
    rate = -factor * w;
    if (d > 0) rate += (0.5 * factor * k * k / (gains.most * slower) * (x.dot(w) / d)) * x;
  }
};

}  // namespace

double miss_distance(const Vector2d& x, const Vector2d& w, const EnclosingEllipse& target) {
  const Vector2d major(std::cos(target.angle), std::sin(target.angle)), minor(-major.y(), major.x());
  const Vector2d in_axes(major.dot(x), minor.dot(x)), course(major.dot(w), minor.dot(w));
  const bool outside = std::hypot(in_axes.x() / target.a, in_axes.y() / target.b) > 1;
  const double speed = detail::length(w);
  if (outside || speed == 0) {
    const Nearest nearest = nearest_on_ellipse(target.a, target.b, in_axes);
    if (speed == 0 || nearest.normal.dot(course) >= 0) return nearest.distance;
  }
  const Vector2d across = left(w) / speed;
  return std::abs(across.dot(x)) - target.reach(across);
}

PursuitStep pursuit_law(const Vector2d& position, const Vector2d& velocity, const EnclosingEllipse& target,
                        const Vector2d& target_acceleration, const PursuitGains& gains) {
  const Vector2d x = position - target.centre, w = velocity - target.centre_rate;
  const Wanted wanted(x, w, gains);
  PursuitStep step;
  step.acceleration = target_acceleration + wanted.rate + gains.speed * (wanted.velocity - w);
  step.demanded = step.acceleration.norm();
  if (step.demanded > gains.most) step.acceleration *= gains.most / step.demanded;
  step.m = miss_distance(x, w, target);
  const double c = cross(x, w), reach = target.reach(left(w));
  step.y2 = w.squaredNorm();
  step.y1 = 4 * step.y2 * (c - reach) * (c + reach);
  return step;
}

}  // namespace vericone::guidance
