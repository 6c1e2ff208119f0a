// SPDX-License-Identifier: BSD-3-Clause
#include "containing/star_volume.h"

#include <vericone/internal/geometry/decompositions.h>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace vericone::fitting {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using std::numbers::pi;

constexpr double kSingular = 1e-2;  // determinant over squared norm
constexpr int kAzimuthsOfOne = 128, kAzimuthsOfMany = 256;
// Gauss' rule of eight nodes, on parts of an interval.
constexpr int kParts = 4;
constexpr std::array<double, 4> kNode = {0.18343464249564980494, 0.52553240991632898582,
                                         0.79666647741362673959, 0.96028985649753623168};
constexpr std::array<double, 4> kWeight = {0.36268378337836198297, 0.31370664587788728734,
                                           0.22238103445337447054, 0.10122853629037625915};

/// A quadratic form along a half circle: mean + amplitude * cos(2 t - phase).
struct Wave {
  double mean = 1, amplitude = 0, phase = 0, cosine = 0, sine = 0;
  double at(double t) const { return mean + cosine * std::cos(2 * t) + sine * std::sin(2 * t); }
};

Wave wave(const Matrix3d& form, const Vector3d& pole, const Vector3d& side) {
  const double pp = pole.dot(form * pole), ss = side.dot(form * side), ps = pole.dot(form * side);
  Wave w;
  w.mean = (pp + ss) / 2;
  w.cosine = (pp - ss) / 2;
  w.sine = ps;
  w.amplitude = std::hypot(w.cosine, w.sine);
  w.phase = std::atan2(w.sine, w.cosine);
  return w;
}

/// Angles in [0, pi] where two waves are equal.
void add_crossings(const Wave& a, const Wave& b, std::vector<double>& angles) {
  const double cosine = a.cosine - b.cosine, sine = a.sine - b.sine;
  const double amplitude = std::hypot(cosine, sine), difference = b.mean - a.mean;
  if (!(std::abs(difference) < amplitude)) return;
  const double phase = std::atan2(sine, cosine), half = std::acos(difference / amplitude);
  for (double t : {(phase + half) / 2, (phase - half) / 2}) {
    t = std::fmod(t, pi);
    angles.push_back(t < 0 ? t + pi : t);
  }
}

struct Sums {
  double volume = 0;             // integral of max(...)^(-3/2)
  std::vector<Matrix3d> second;  // of max(...)^(-5/2) u u^T where form i is the greatest; 0: the ball
};

/// Integrals over a part of a half circle, v = (cos t, sin t), of sin(t) q^(-3/2) and sin(t) q^(-5/2) v v^T
/// for q = v^T N v > 0. With J the quarter turn and e = (0, 1), d/dt (a.v / sqrt q) = -(v.N J a) q^(-3/2), so
/// that a = J N^-1 e gives the first in closed form; the second is -2/3 of its derivative with respect to N.
class HalfCircle {
 public:
  explicit HalfCircle(const Matrix2d& form) : form_(form) {
    const double size = form_.norm();
    is_nearly_singular_ = std::abs(form_.determinant()) < kSingular * size * size;
    if (is_nearly_singular_) return;
    inverse_ = form_.inverse();
    of_e_ = inverse_.col(1);
    a_ = Vector2d(-of_e_.y(), of_e_.x());
  }

  void add(double low, double high, double weight, double& volume, Matrix2d& second) const {
    if (is_nearly_singular_) return add_by_quadrature(low, high, weight, volume, second);
    for (const double sign : {-weight, weight}) {
      const double t = sign == weight ? high : low;
      const Vector2d v(std::cos(t), std::sin(t));
      const double root = 1 / std::sqrt(v.dot(form_ * v)), first = a_.dot(v) * root;
      volume += sign * first;
      const Vector2d turned = inverse_ * Vector2d(v.y(), -v.x());
      const Matrix2d outer = turned * of_e_.transpose();
      second += sign * ((outer + outer.transpose()) * root + first * root * root * v * v.transpose()) / 3;
    }
  }

 private:
  /// The closed form loses digits by the square of the condition; q is then nearly a square, and tame.
  void add_by_quadrature(double low, double high, double weight, double& volume, Matrix2d& second) const {
    const double half = (high - low) / (2 * kParts);
    for (int part = 0; part < kParts; ++part)
      for (std::size_t k = 0; k < 2 * kNode.size(); ++k) {
        const double t = low + half * (2 * part + 1 + (k % 2 ? kNode[k / 2] : -kNode[k / 2]));
        const Vector2d v(std::cos(t), std::sin(t));
        const double q = v.dot(form_ * v), w = weight * half * kWeight[k / 2] * v.y() / (q * std::sqrt(q));
        volume += w;
        second += w / q * v * v.transpose();
      }
  }

  Matrix2d form_, inverse_;
  Vector2d of_e_, a_;
  bool is_nearly_singular_ = false;
};

/// One form, in its own axes: half-planes through the axis of the least eigenvalue, which meet it (if at all)
/// from an angle above the equator to the same below it, and everything is in closed form. Where the middle
/// eigenvalue is below 1 only azimuths up to asin(reach) do; with sin(azimuth) = reach * sin(tau) the angle
/// is analytic in tau, and tan(tau) = stretch * tan(omega) evens out narrow bodies.
Sums integrate_one(const Matrix3d& form) {
  const auto solver = symmetric_eigen<3>(form);
  const double low = solver.values(0), middle = solver.values(1), high = solver.values(2);
  Sums sums;
  sums.volume = 4 * pi;
  Vector3d ball(4 * pi / 3, 4 * pi / 3, 4 * pi / 3), active = Vector3d::Zero();
  const double square = high > middle ? std::min((high - 1) / (high - middle), 1.0) : 1.0;
  const bool everywhere = middle >= 1;
  const double reach = everywhere ? 1 : std::sqrt(std::max(square, 0.0));
  // The half-planes are denser where a large form falls to 1.
  const double stretch = std::pow(high / std::max(middle, 1.0), 0.25);
  for (int j = 0; high > 1 && j < kAzimuthsOfOne; ++j) {
    const double omega = pi / 2 * (j + 0.5) / kAzimuthsOfOne;
    const double x = std::cos(omega), y = stretch * std::sin(omega), norm = x * x + y * y;
    const double cos_tau = x / std::sqrt(norm), sin_tau = y / std::sqrt(norm);
    const double sine = reach * sin_tau, cosine = everywhere ? cos_tau : std::sqrt(1 - sine * sine);
    const double weight =
        8 * pi / 2 / kAzimuthsOfOne * stretch / norm * (everywhere ? 1 : reach * cos_tau / cosine);
    // Along the half-plane the form is low * cos^2 + side * sin^2.
    const double side = high * cosine * cosine + middle * sine * sine, excess = side - 1;
    if (!(excess > 0)) continue;
    const double c2 = excess / (side - low), c = std::sqrt(c2), s2 = 1 - c2;
    const Vector3d squares(0, sine * sine, cosine * cosine);
    sums.volume += weight * (c / side - c);
    ball -= weight * (Vector3d(c2 * c / 3, 0, 0) + squares * (c - c2 * c / 3));
    active +=
        weight / 3 * (Vector3d(c2 * c / side, 0, 0) + squares * (2 * c / (side * side) + c * s2 / side));
  }
  const Matrix3d& axes = solver.vectors;
  sums.second = {axes * ball.asDiagonal() * axes.transpose(), axes * active.asDiagonal() * axes.transpose()};
  return sums;
}

/// Several forms: half-planes through the third axis, not through one that moves with the forms, so that the
/// derivatives are those of the sum itself.
Sums integrate_all(std::span<const Matrix3d> forms) {
  Sums sums;
  sums.second.assign(forms.size() + 1, Matrix3d::Zero());
  const Vector3d pole = Vector3d::UnitZ();
  std::vector<Wave> waves(forms.size());
  std::vector<double> angles;
  // Bodies are symmetric about their centre: half of the half-planes, counted twice.
  for (int j = 0; j < kAzimuthsOfMany; ++j) {
    const double azimuth = pi * (j + 0.5) / kAzimuthsOfMany;
    const Vector3d side(std::cos(azimuth), std::sin(azimuth), 0);
    Eigen::Matrix<double, 3, 2> plane;
    plane << pole, side;
    angles.assign({0, pi});
    for (std::size_t i = 0; i < forms.size(); ++i) {
      waves[i] = wave(forms[i], pole, side);
      add_crossings(waves[i], Wave{}, angles);
      for (std::size_t k = 0; k < i; ++k) add_crossings(waves[i], waves[k], angles);
    }
    std::sort(angles.begin(), angles.end());
    for (std::size_t i = 0; i + 1 < angles.size(); ++i) {
      if (!(angles[i] < angles[i + 1])) continue;
      const double middle = (angles[i] + angles[i + 1]) / 2;
      std::size_t greatest = 0;
      double value = 1;
      for (std::size_t k = 0; k < forms.size(); ++k)
        if (const double q = waves[k].at(middle); q > value) {
          value = q;
          greatest = k + 1;
        }
      const Matrix2d form = greatest ? Matrix2d(plane.transpose() * forms[greatest - 1] * plane)
                                     : Matrix2d(Matrix2d::Identity());
      Matrix2d second = Matrix2d::Zero();
      HalfCircle(form).add(angles[i], angles[i + 1], 2 * pi / kAzimuthsOfMany, sums.volume, second);
      sums.second[greatest] += plane * second * plane.transpose();
    }
  }
  return sums;
}

}  // namespace

bool star_volume(const Matrix3d& ellipsoid, std::span<const Matrix3d> delimiters, StarVolume& result) {
  const Cholesky<3> factor = cholesky<3>(ellipsoid);
  if (!factor.positive) return false;
  // y = L^-T u: A becomes the unit matrix.
  const Matrix3d inverse = factor.lower_inverse();
  std::vector<Matrix3d> forms;
  forms.reserve(delimiters.size());
  for (const Matrix3d& m : delimiters) {
    const Matrix3d form = inverse * m * inverse.transpose();
    forms.push_back((form + form.transpose()) / 2);
  }
  const Sums sums = forms.size() == 1 ? integrate_one(forms.front()) : integrate_all(forms);
  if (!std::isfinite(sums.volume) || !(sums.volume > 0)) return false;
  result.log = std::log(sums.volume / 3) - std::log(factor.lower.diagonal().prod());
  result.by_delimiter.resize(forms.size());
  // d(form) = L^-1 dM L^-T - P form - form P^T, where P is the lower triangle of X = L^-1 dA L^-T with half
  // of its diagonal (that is dL = L P).
  Matrix3d turned = Matrix3d::Zero();
  for (std::size_t i = 0; i < forms.size(); ++i) {
    const Matrix3d by_form = -1.5 / sums.volume * sums.second[i + 1];
    const Matrix3d g = inverse.transpose() * by_form * inverse;
    result.by_delimiter[i] = (g + g.transpose()) / 2;
    turned += forms[i] * by_form;
  }
  Matrix3d by_x = Matrix3d::Zero();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j <= i; ++j) by_x(i, j) = by_x(j, i) = -turned(j, i);
  by_x.diagonal().array() -= 0.5;
  const Matrix3d g = inverse.transpose() * by_x * inverse;
  result.by_ellipsoid = (g + g.transpose()) / 2;
  return true;
}

}  // namespace vericone::fitting
