// SPDX-License-Identifier: BSD-3-Clause
#include "distance/quadric_foot.h"

#include <vericone/internal/geometry/decompositions.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

// A point y of sum values_i y_i^2 = level at which the distance from x is stationary has
// (1 + t values_i) y_i = x_i for a multiplier t, a root of the secular equation
//   sum values_i x_i^2 / (1 + t values_i)^2 = level.
// It is nearest if 1 + t values_i >= 0 for all i: with y' any other point of the surface,
//   |x - y'|^2 - |x - y|^2 = (y' - y)^T (I + t M) (y' - y) >= 0.
// Where all these are positive the left side decreases in t, so there is one such root, or else (the "hard
// case") one of them is zero, x lies in the plane of symmetry, and two feet mirror each other.

namespace vericone::fitting {
namespace {

using Eigen::Vector3d;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/// The secular equation in s = 1 + t values_m, m the largest of the values, all divided by that one:
/// 1 + t values_i = alpha_i + s beta_i, without cancellation near the pole s = 0.
struct Secular {
  Vector3d alpha, beta, x;
  double level;
  int pole = 0;

  Secular(const Vector3d& values, double of_level, const Vector3d& point) : x(point) {
    const double largest = values.maxCoeff(&pole);
    beta = values / largest;
    alpha = (Vector3d::Constant(largest) - values) / largest;
    level = of_level / largest;
  }

  double denominator(int i, double s) const { return alpha(i) + s * beta(i); }

  double operator()(double s) const {
    double sum = -level;
    for (int i = 0; i < 3; ++i)
      if (x(i) != 0) {
        const double y = x(i) / denominator(i, s);
        sum += beta(i) * y * y;
      }
    return sum;
  }

  double slope(double s) const {
    double sum = 0;
    for (int i = 0; i < 3; ++i)
      if (x(i) != 0) {
        const double d = denominator(i, s), y = beta(i) * x(i) / d;
        sum -= 2 * y * y / d;
      }
    return sum;
  }

  Vector3d point(double s) const {
    Vector3d y = Vector3d::Zero();
    for (int i = 0; i < 3; ++i)
      if (x(i) != 0) y(i) = x(i) / denominator(i, s);
    return y;
  }

  /// |x - y|; the differences without cancellation.
  double distance(double s) const {
    Vector3d d = Vector3d::Zero();
    for (int i = 0; i < 3; ++i)
      if (x(i) != 0) d(i) = (1 - s) * beta(i) * x(i) / denominator(i, s);
    return d.norm();
  }
};

/// The root of a function that is not negative at `low` and not positive at `high`: Newton's steps where they
/// stay inside and help, else halving (of the logarithm while the ends are of different size).
double root(const Secular& f, double low, double high, double start) {
  double s = start, width = high - low;
  for (int k = 0; k < 300; ++k) {
    const double value = f(s);
    if (value == 0) return s;
    (value > 0 ? low : high) = s;
    double next = s - value / f.slope(s);
    const bool slow = k % 4 == 3 && high - low > 0.5 * width;
    if (k % 4 == 3) width = high - low;
    if (!(next > low && next < high) || slow)
      next = low > 0 && high > 4 * low ? std::sqrt(low) * std::sqrt(high) : 0.5 * (low + high);
    if (std::abs(next - s) <= 2 * kEpsilon * std::abs(s) || next == low || next == high) return next;
    s = next;
  }
  return s;
}

/// Where the denominators vanish with index `pole`, the other terms leave this for beta y^2 = y^2.
double left_at_pole(const Secular& f) {
  double rest = f.level;
  for (int i = 0; i < 3; ++i)
    if (f.alpha(i) != 0) {
      const double y = f.x(i) / f.alpha(i);
      rest -= f.beta(i) * y * y;
    }
  return rest;
}

double at_pole(const Secular& f) {
  double sum = 0;
  for (int i = 0; i < 3; ++i)
    if (f.alpha(i) == 0) sum += f.x(i) * f.x(i);
  return std::sqrt(sum);
}

Foot nearest_in_axes(Vector3d values, double level, const Vector3d& x) {
  double side = -level;
  for (int i = 0; i < 3; ++i) side += values(i) * x(i) * x(i);
  if (side > 0 && values.minCoeff() < 0) {
    // The multiplier is then between 0 and the pole of the least value: the same with all signs changed.
    values = -values;
    level = -level;
    side = -side;
  }
  const Secular f(values, level, x);
  if (side > 0) {
    // Only an ellipsoid (or cylinder) with x outside: 1 <= s.
    double above = 0;
    for (int i = 0; i < 3; ++i)
      if (f.beta(i) > 0) above += x(i) / f.beta(i) * x(i);
    const double high = f.level > 0 ? 1 + 2 * std::sqrt(above / f.level) : 1 / kEpsilon;
    const double s = root(f, 1, high, 1);
    return {f.point(s), f.distance(s)};
  }
  const double on_pole = at_pole(f);
  double room = f.level;
  for (int i = 0; i < 3; ++i)
    if (f.beta(i) < 0) room -= f.beta(i) * x(i) * x(i);
  const double low =
      on_pole > 0 && room > 0 ? std::min(1.0, on_pole / std::sqrt(room) * (1 - 8 * kEpsilon)) : 0;
  if (low < 1e-150) {
    // In the plane of symmetry (or within 1e-150 of it).
    const double left = left_at_pole(f);
    if (left >= 0) {
      Vector3d y = Vector3d::Zero(), d = Vector3d::Zero();
      for (int i = 0; i < 3; ++i)
        if (f.alpha(i) != 0) {
          y(i) = x(i) / f.alpha(i);
          d(i) = f.beta(i) * y(i);
        }
      y(f.pole) = d(f.pole) = std::sqrt(left);
      return {y, d.norm()};
    }
  }
  const double s = root(f, low, 1, low > 0 ? low : 1);
  return {f.point(s), f.distance(s)};
}

/// Roots of the secular equation for s in (-last, -first), by signs at points that are dense towards both
/// ends, and by the least value between them where three points show a dip.
std::vector<double> roots_beyond_pole(const Secular& f, double first, double last) {
  constexpr int kSteps = 32;
  std::vector<double> s;
  const double middle = std::sqrt(first) * std::sqrt(last);
  for (int k = 0; k <= kSteps; ++k) s.push_back(first * std::pow(middle / first, double(k) / kSteps));
  for (int k = kSteps; k-- > 0;) {
    const double mirrored = last - (last - middle) * std::pow(1e-9, double(kSteps - k) / kSteps);
    if (mirrored > s.back()) s.push_back(mirrored);
  }
  if (last > s.back()) s.push_back(last);

  std::vector<double> value, found;
  for (const double at : s) value.push_back(f(-at));
  const auto bisect = [&](double low, double high) {
    const bool positive = f(-low) > 0;
    for (int k = 0; k < 80; ++k) {
      const double at = 0.5 * (low + high);
      ((f(-at) > 0) == positive ? low : high) = at;
    }
    found.push_back(-0.5 * (low + high));
  };
  for (std::size_t k = 0; k + 1 < s.size(); ++k) {
    if ((value[k] > 0) != (value[k + 1] > 0)) {
      bisect(s[k], s[k + 1]);
    } else if (k > 0 && value[k] > 0 && value[k] <= value[k - 1] && value[k] <= value[k + 1]) {
      double low = s[k - 1], high = s[k + 1];
      for (int step = 0; step < 60 && value[k] > 0; ++step) {
        const double a = low + (high - low) / 3, b = high - (high - low) / 3;
        const double at_a = f(-a), at_b = f(-b);
        (at_a < at_b ? high : low) = at_a < at_b ? b : a;
        if (std::min(at_a, at_b) <= 0) {
          const double inside = at_a < at_b ? a : b;
          bisect(s[k - 1], inside);
          bisect(inside, s[k + 1]);
          break;
        }
      }
    }
  }
  return found;
}

}  // namespace

CenteredQuadric::CenteredQuadric(const Eigen::Matrix3d& matrix, double level) : level_(level) {
  const auto solver = symmetric_eigen<3>(matrix);
  axes_ = solver.vectors;
  values_ = solver.values;
}

CenteredQuadric CenteredQuadric::ellipsoid(const Eigen::Matrix3d& axes, const Vector3d& semi_axes) {
  CenteredQuadric q;
  q.axes_ = axes;
  q.values_ = semi_axes.cwiseAbs2().cwiseInverse();
  return q;
}

double CenteredQuadric::value(const Vector3d& y) const {
  return values_.dot((axes_.transpose() * y).cwiseAbs2()) - level_;
}

Foot CenteredQuadric::nearest(const Vector3d& x) const {
  Foot foot = nearest_in_axes(values_, level_, axes_.transpose() * x);
  foot.point = axes_ * foot.point;
  return foot;
}

// A foot that is not the nearest has 1 + t values_i < 0 for some i; on the two-dimensional tangent plane
// I + tM is not negative at a local minimum, so for one i only, and t > 0 where x is on the outer side along
// the normal. So the value is the least (negative) one and t lies between its pole and the next.
void CenteredQuadric::add_other_feet(const Vector3d& x, double reach, std::vector<Vector3d>& feet) const {
  if (!(values_.minCoeff() < 0)) return;
  const Secular f(-values_, -level_, axes_.transpose() * x);
  const auto add = [&](const Vector3d& y) { feet.push_back(axes_ * y); };
  // x in a plane of symmetry: the feet mirror each other, or they are a circle.
  if (const double left = left_at_pole(f); at_pole(f) <= 1e-12 * reach && left >= 0) {
    Vector3d y = Vector3d::Zero();
    for (int i = 0; i < 3; ++i)
      if (f.alpha(i) != 0) y(i) = f.x(i) / f.alpha(i);
    for (int i = 0; i < 3; ++i)
      if (f.alpha(i) == 0)
        for (const double sign : {-1.0, 1.0}) {
          Vector3d one = y;
          one(i) = sign * std::sqrt(left);
          add(one);
        }
  }
  // Where a component of the foot is larger than `reach` there is nothing to look for.
  double first = std::max(1e-12, 0.5 * at_pole(f) / reach), last = std::numeric_limits<double>::infinity();
  double negative = 0;
  for (int i = 0; i < 3; ++i) {
    if (f.alpha(i) == 0) continue;
    if (f.beta(i) > 0) last = std::min(last, (f.alpha(i) - 0.5 * std::abs(f.x(i)) / reach) / f.beta(i));
    if (f.beta(i) < 0) negative += f.x(i) * f.x(i) / -f.beta(i);
  }
  // Without a second pole the terms that balance the level fall off as 1 / s^2.
  if (!std::isfinite(last)) last = f.level < 0 ? 2 * std::sqrt(negative / -f.level) : 1e6;
  if (!(last > first)) return;
  for (const double s : roots_beyond_pole(f, first, last)) add(f.point(s));
}

}  // namespace vericone::fitting
