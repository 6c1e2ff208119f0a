// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/mesh/surface.h>

#include <vericone/internal/geometry/decompositions.h>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "whitened_forms.h"

namespace vericone {
namespace {

using Eigen::Matrix2d, Eigen::Matrix3d, Eigen::Vector2d, Eigen::Vector3d;
using Form2 = forms::Form<2>;
using Form3 = forms::Form<3>;
using std::numbers::pi;

/// Angles in (0, end) where two forms of a plane cross, sorted, with both ends.
std::vector<double> breaks(const std::vector<Form2>& plane, double end) {
  std::vector<double> angles{0, end};
  for (std::size_t i = 0; i < plane.size(); ++i)
    for (std::size_t j = i + 1; j < plane.size(); ++j) {
      const Matrix2d h = forms::difference<2>(plane[i], plane[j]).matrix;
      const forms::Roots r = forms::roots(h(0, 0), h(0, 1), h(1, 1));
      for (int k = 0; k < r.count; ++k) {
        double t = std::atan2(r.direction[k].y(), r.direction[k].x());
        if (t < 0) t += pi;
        for (; t < end; t += pi) angles.push_back(t);
      }
    }
  std::sort(angles.begin(), angles.end());
  return angles;
}

/// Integral of sin(t) q(t)^(-3/2) between two directions (cos t, sin t), q the form's value there. With
/// P = A x + B y and D = A C - B^2 the antiderivative is -P / (D sqrt(q)), and P^2 + D y^2 = A q; the second
/// form of the difference has no division by D, which may vanish.
double meridian_integral(const Matrix2d& q, const Vector2d& from, const Vector2d& to) {
  const double q0 = from.dot(q * from), q1 = to.dot(q * to);
  const double p0 = q.row(0).dot(from) / std::sqrt(q0), p1 = q.row(0).dot(to) / std::sqrt(q1);
  if (p0 * p1 > 0) return (to.y() * to.y() / q1 - from.y() * from.y() / q0) / (p0 + p1);
  return (p0 - p1) / (q(0, 0) * q(1, 1) - q(0, 1) * q(0, 1));
}

/// Integral of r^3 sin(t) dt over the half-plane { cos(t) pole + sin(t) side, 0 <= t <= pi }.
double half_plane(const std::vector<Form3>& all, const Vector3d& pole, const Vector3d& side) {
  Eigen::Matrix<double, 3, 2> axes;
  axes << pole, side;
  std::vector<Form2> plane;
  plane.reserve(all.size());
  for (const Form3& f : all) plane.push_back({axes.transpose() * f.matrix * axes, f.level});
  const std::vector<double> angles = breaks(plane, pi);
  double sum = 0;
  for (std::size_t i = 0; i + 1 < angles.size(); ++i) {
    const double t0 = angles[i], t1 = angles[i + 1], middle = 0.5 * (t0 + t1);
    if (!(t1 > t0)) continue;
    const auto at = [](double t) { return Vector2d(std::cos(t), std::sin(t)); };
    const Form2& f = plane[static_cast<std::size_t>(forms::active_form<2>(plane, at(middle)))];
    if (f.level == 0) continue;
    sum +=
        f.level * std::sqrt(f.level) *
        (meridian_integral(f.matrix, at(t0), at(middle)) + meridian_integral(f.matrix, at(middle), at(t1)));
  }
  return sum;
}

/// The part of the sphere of directions in which a form bounds the body, seen from its axis.
struct Cap {
  Vector3d axis;
  double radius;
};

Cap cap(const Form3& form) {
  const auto solver = symmetric_eigen<3>(form.matrix);
  const Vector3d& l = solver.values;
  // Dents: about the largest eigenvector. A waist is a belt; what it leaves is about the smallest.
  if (form.level > l(1))
    return {solver.vectors.col(2), std::atan(std::sqrt((l(2) - form.level) / (form.level - l(1))))};
  return {solver.vectors.col(0), std::atan(std::sqrt((form.level - l(0)) / (l(1) - form.level)))};
}

struct Panel {
  double from, to, value, error;
};

/// Adaptive quadrature over the panels: always the one of the largest error is halved. The error is that of
/// the Gauss rule inside the Kronrod rule, which is far larger than that of the value. Where values carry
/// rounding errors it stays at those.
template <typename Function>
std::pair<double, double> integral(const Function& f, const std::vector<double>& ends) {
  constexpr double kRelative = 1e-13;
  constexpr std::size_t kMostPanels = 300;
  const auto panel = [&](double from, double to) {
    double error = 0;
    // Depth 0: one application of the rules.
    const double value =
        boost::math::quadrature::gauss_kronrod<double, 21>::integrate(f, from, to, 0, 0, &error);
    return Panel{from, to, value, error};
  };
  const auto smaller = [](const Panel& x, const Panel& y) { return x.error < y.error; };
  std::vector<Panel> all;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i)
    if (ends[i + 1] > ends[i]) all.push_back(panel(ends[i], ends[i + 1]));
  std::make_heap(all.begin(), all.end(), smaller);
  for (;;) {
    double value = 0, error = 0;
    for (const Panel& p : all) {
      value += p.value;
      error += p.error;
    }
    if (error <= kRelative * value || all.size() >= kMostPanels) return {value, error};
    std::pop_heap(all.begin(), all.end(), smaller);
    const Panel worst = all.back();
    const double middle = 0.5 * (worst.from + worst.to);
    all.back() = panel(worst.from, middle);
    std::push_heap(all.begin(), all.end(), smaller);
    all.push_back(panel(middle, worst.to));
    std::push_heap(all.begin(), all.end(), smaller);
  }
}

}  // namespace

VolumeEstimate volume(const CombinedEllipsoid& body) {
  constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
  if (body.is_ellipsoid()) return {body.ellipsoid().volume(), 16 * kEpsilon * body.ellipsoid().volume()};
  const std::vector<Form3> all = forms::whitened_forms<3>(body);
  // Half-planes through the axis of the first delimiter cross its rims once and never touch them.
  const Vector3d pole = cap(all[1]).axis;
  const Vector3d first = pole.unitOrthogonal(), second = pole.cross(first);
  // The other delimiters begin and end near these azimuths: panels must not step over a narrow dent.
  std::vector<double> panels{0, 0.25 * pi, 0.5 * pi, 0.75 * pi, pi};
  for (std::size_t i = 2; i < all.size(); ++i) {
    const Cap c = cap(all[i]);
    const double azimuth = std::atan2(c.axis.dot(second), c.axis.dot(first));
    const double width =
        std::asin(std::min(1.0, std::sin(c.radius) / std::max(1e-300, c.axis.cross(pole).norm())));
    for (double a : {azimuth - width, azimuth, azimuth + width}) {
      a = std::fmod(a, pi);
      panels.push_back(a < 0 ? a + pi : a);
    }
  }
  std::sort(panels.begin(), panels.end());
  const auto integrand = [&](double azimuth) {
    return half_plane(all, pole, std::cos(azimuth) * first + std::sin(azimuth) * second);
  };
  const auto [sum, error] = integral(integrand, panels);
  // Both halves of the body, dV = r^3 / 3 dOmega.
  const double scale = 2.0 / 3.0 * std::abs(body.ellipsoid().factor().determinant());
  // A rounding of a form's matrix moves the surface by its size against the level: thin bodies are known
  // less.
  double condition = 64;
  for (const Form3& f : all)
    if (f.level > 0) condition = std::max(condition, f.matrix.norm() / f.level);
  return {scale * sum, scale * (error + condition * kEpsilon * sum)};
}

double area(const CombinedEllipse& body) {
  const std::vector<Form2> all = forms::whitened_forms<2>(body);
  const std::vector<double> angles = breaks(all, pi);
  // Integral of 1/q between two directions less than a right angle apart.
  const auto piece = [](const Matrix2d& q, const Vector2d& from, const Vector2d& to) {
    const double cross = from.x() * to.y() - from.y() * to.x(), middle = from.dot(q * to);
    const double d = q(0, 0) * q(1, 1) - q(0, 1) * q(0, 1), root = std::sqrt(std::abs(d));
    const double x = root * cross;
    if (x < 1e-8 * middle) return cross / middle;
    return (d > 0 ? std::atan2(x, middle) : std::atanh(x / middle)) / root;
  };
  double sum = 0;
  for (std::size_t i = 0; i + 1 < angles.size(); ++i) {
    const double t0 = angles[i], t1 = angles[i + 1];
    if (!(t1 > t0)) continue;
    const auto at = [&](double s) {
      const double t = t0 + s * (t1 - t0);
      return Vector2d(std::cos(t), std::sin(t));
    };
    const Form2& f = all[static_cast<std::size_t>(forms::active_form<2>(all, at(0.5)))];
    if (f.level == 0) continue;
    for (const double s : {0.0, 0.25, 0.5, 0.75}) sum += f.level * piece(f.matrix, at(s), at(s + 0.25));
  }
  return sum * std::abs(body.ellipsoid().factor().determinant());  // two halves, dA = r^2 / 2 dt
}

}  // namespace vericone
