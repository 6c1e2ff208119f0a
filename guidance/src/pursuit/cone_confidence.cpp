// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/guidance/pursuit/pursuit_law.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "pursuit/products.h"

namespace vericone::guidance {
namespace {

using Eigen::Matrix2d, Eigen::Matrix4d, Eigen::Vector2d, Eigen::Vector3d, Eigen::Vector4d;

constexpr int kPoints = 509, kStep = 187;

double normal_below(double x) { return 0.5 * std::erfc(-x * std::numbers::sqrt2 / 2); }

/// The x with normal_below(x) = p, by Newton's steps: for the table below.
double normal_quantile(double p) {
  double x = 0;
  for (int i = 0; i < 100; ++i) {
    const double density = std::exp(-0.5 * x * x) / std::sqrt(2 * std::numbers::pi);
    x -= std::clamp((normal_below(x) - p) / density, -1.0, 1.0);
  }
  return x;
}

/// Normal numbers of three directions: a Korobov lattice (1, g, g^2), g the best of a search over random
/// engagements. Even steps in the first direction, which is to matter most.
const std::array<Vector3d, kPoints>& normal_points() {
  static const std::array<Vector3d, kPoints> points = [] {
    std::array<Vector3d, kPoints> p;
    for (int i = 0; i < kPoints; ++i) {
      // The middles of steps: odd parts of 2 kPoints, as every step is odd.
      const auto at = [&](int step) {
        return normal_quantile((2 * i + 1) * step % (2 * kPoints) / (2.0 * kPoints));
      };
      p[static_cast<std::size_t>(i)] = {at(1), at(kStep), at(kStep * kStep % kPoints)};
    }
    return p;
  }();
  return points;
}

/// L with L L' = p, p positive semidefinite: a direction without spread has a column of zeros.
Matrix4d root(const Matrix4d& p) {
  Matrix4d l = Matrix4d::Zero();
  for (int j = 0; j < 4; ++j) {
    const double rest = p(j, j) - l.row(j).head(j).squaredNorm();
    if (!(rest > 1e-14 * p(j, j))) continue;
    l(j, j) = std::sqrt(rest);
    for (int i = j + 1; i < 4; ++i) l(i, j) = (p(i, j) - l.row(i).head(j).dot(l.row(j).head(j))) / l(j, j);
  }
  return l;
}

/// Probability that a < mean + spread n < b.
double between(double a, double b, double mean, double spread) {
  if (!(a < b)) return 0;
  if (!(spread > 0)) return a < mean && mean < b ? 1 : 0;
  return normal_below((b - mean) / spread) - normal_below((a - mean) / spread);
}

class Cubature {
 public:
  Cubature(const Vector2d& x, const Vector2d& w, const EnclosingEllipse& e, const Matrix4d& covariance)
      : x_(x), w_(w) {
    const Vector2d major(std::cos(e.angle), std::sin(e.angle)), minor = left(major);
    shape_ = e.a * e.a * major * major.transpose() + e.b * e.b * minor * minor.transpose();
    area_ = e.a * e.b;
    // Velocity first: where it points says where the ellipse must be met.
    Matrix4d ordered;
    ordered << covariance.bottomRightCorner<2, 2>(), covariance.bottomLeftCorner<2, 2>(),
        covariance.topRightCorner<2, 2>(), covariance.topLeftCorner<2, 2>();
    const Matrix4d l = root(ordered);
    w_by_ = l.topLeftCorner<2, 2>();
    x_by_ = l.bottomLeftCorner<2, 2>();
    rest_ = l.bottomRightCorner<2, 2>() * l.bottomRightCorner<2, 2>().transpose();
    turn_to_what_matters();
  }

  double probability() const {
    double sum = 0;
    for (const Vector3d& n : normal_points()) sum += at(n);
    return sum / kPoints;
  }

 private:
  /// Turns the velocity's errors so that the first moves A's course across the ellipse, the other along it.
  void turn_to_what_matters() {
    const double speed2 = w_.squaredNorm();
    if (!(speed2 > 0)) return;
    const Vector2d across = left(w_);
    const Vector2d effect = x_by_.transpose() * across - x_.dot(w_) / speed2 * (w_by_.transpose() * across);
    if (!(effect.squaredNorm() > 0)) return;
    const Vector2d first = effect.normalized();
    Matrix2d turn;
    turn << first, left(first);
    w_by_ = (w_by_ * turn).eval();
    x_by_ = (x_by_ * turn).eval();
  }

  /// With three errors given, the fourth, A's place across its course, decides: the places from which the
  /// course meets the ellipse are an interval, the chord of the ellipse drawn out against the course.
  double at(const Vector3d& n) const {
    const Vector2d w = w_ + w_by_ * n.head<2>();
    const double speed = w.norm();
    const Vector2d along = speed > 0 ? Vector2d(w / speed) : Vector2d(1, 0), across = left(along);
    const Vector2d x = x_ + x_by_ * n.head<2>();
    const double rest_along = along.dot(rest_ * along), rest_both = along.dot(rest_ * across);
    const double spread_along = std::sqrt(std::max(0.0, rest_along));
    const double place = along.dot(x) + spread_along * n.z();
    const double slope = spread_along > 0 ? rest_both / spread_along : 0;
    const double mean = across.dot(x) + slope * n.z();
    const double spread = std::sqrt(std::max(0.0, across.dot(rest_ * across) - slope * slope));

    const double length2 = along.dot(shape_ * along), both = along.dot(shape_ * across);
    const double half = std::sqrt(across.dot(shape_ * across)), touch = both / half;
    double low = -half, high = half;
    const bool drawn_out = speed > 0;
    if (!drawn_out || place > -touch || place > touch) {
      const double inside = 1 - place * place / length2;
      if (inside <= 0 && (place > 0 || !drawn_out)) return 0;
      const double middle = both / length2 * place;
      const double chord = area_ / std::sqrt(length2) * std::sqrt(std::max(0.0, inside));
      if (!drawn_out || place > -touch) low = middle - chord;
      if (!drawn_out || place > touch) high = middle + chord;
    }
    return between(low, high, mean, spread);
  }

  Vector2d x_, w_;
  Matrix2d shape_, w_by_, x_by_, rest_;
  double area_ = 0;
};

/// y = 4 V^2 [(x V)^2 - s^2], s = V times the reach of the ellipse across V. Every part is bounded where
/// (x, w) is within k of the mean.
void bound_y(const Vector2d& x, const Vector2d& w, const EnclosingEllipse& e, const Matrix4d& p, double k,
             ConeConfidence& c) {
  const Matrix2d p_w = p.bottomRightCorner<2, 2>();
  Vector4d gradient;  // of x V
  gradient << w.y(), -w.x(), -x.y(), x.x();
  // dx dw: a quadratic form K whose largest value is at most the norm of L' K L, L L' = p.
  Matrix4d form = Matrix4d::Zero();
  form(0, 3) = form(3, 0) = 0.5;
  form(1, 2) = form(2, 1) = -0.5;
  const Matrix4d l = root(p);
  const double product = cross(x, w);
  const double product_error =
      k * std::sqrt(std::max(0.0, gradient.dot(p * gradient))) + k * k * (l.transpose() * form * l).norm();
  const double speed = w.norm(), speed_error = k * std::sqrt(std::max(0.0, p_w.trace()));
  const Vector2d major(std::cos(e.angle), std::sin(e.angle)), minor = left(major);
  // Across V the minor axis counts for V along the major one.
  const double across = e.reach(left(w));
  const double across_error =
      k * std::sqrt(std::max(0.0, e.a * e.a * minor.dot(p_w * minor) + e.b * e.b * major.dot(p_w * major)));
  const auto square_of = [](double value, double error) {
    const double least = std::max(0.0, std::abs(value) - error), most = std::abs(value) + error;
    return Vector2d(least * least, most * most);
  };
  const Vector2d v2 = square_of(speed, speed_error), c2 = square_of(product, product_error),
                 s2 = square_of(across, across_error);
  const double low = c2[0] - s2[1], high = c2[1] - s2[0];
  c.y_low = 4 * low * (low < 0 ? v2[1] : v2[0]);
  c.y_high = 4 * high * (high < 0 ? v2[0] : v2[1]);
}

}  // namespace

ConeConfidence cone_confidence(const Vector2d& position, const Vector2d& velocity,
                               const EnclosingEllipse& target, const Matrix4d& covariance,
                               double deviations) {
  const Vector2d x = position - target.centre, w = velocity - target.centre_rate;
  ConeConfidence c;
  c.probability = std::clamp(Cubature(x, w, target, covariance).probability(), 0.0, 1.0);
  bound_y(x, w, target, covariance, deviations, c);
  return c;
}

}  // namespace vericone::guidance
