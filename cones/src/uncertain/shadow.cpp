// SPDX-License-Identifier: BSD-3-Clause
#include "uncertain/shadow.h"

#include <vericone/internal/geometry/double_double.h>
#include <algorithm>
#include <array>
#include <utility>

namespace vericone::gaussian {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;
using Number = DoubleDouble;

// Covariances whose deviations are 10^6 to 1 lose 12 digits when they are seen along w, hence two doubles.
Number quotient(const Number& x, const Number& y) {
  const double q = x.hi / y.hi;
  const Number rest = x - Number(q) * y;
  const double r = rest.hi / y.hi;
  const Number more = rest - Number(r) * y;
  return Number::two_sum(q, r) + Number(more.hi / y.hi);
}
Number root(const Number& x) {
  if (!(x.hi > 0)) return 0;
  const double r = std::sqrt(x.hi);
  const Number rest = x - Number::two_product(r, r);
  return Number::two_sum(r, rest.hi / (2 * r));
}
double rounded(const Number& x) { return x.hi + x.lo; }

/// A symmetric matrix of the plane.
struct Form {
  Number xx, xy, yy;

  friend Form operator+(const Form& f, const Form& g) { return {f.xx + g.xx, f.xy + g.xy, f.yy + g.yy}; }
  /// Of (x, y - slope x).
  Form sheared(const Number& slope) const {
    const Number cross = xy - slope * xx;
    return {xx, cross, yy - slope * (xy + cross)};
  }
  Form stretched(const Number& of_x, const Number& of_y) const {
    return {xx * of_x * of_x, xy * of_x * of_y, yy * of_y * of_y};
  }
  /// Along (c, s) and (-s, c).
  Form turned(const Number& c, const Number& s) const {
    const Number p = c * xx + s * xy, q = c * xy + s * yy;
    return {c * p + s * q, c * q - s * p, c * (c * yy - s * xy) - s * (c * xy - s * xx)};
  }
};

/// The direction (c, s) of the largest eigenvalue.
std::pair<Number, Number> main_axis(const Form& f) {
  const Number half = Number(0.5) * (f.xx - f.yy);
  const Number length = root(half * half + f.xy * f.xy);
  Number c = half.hi >= 0 ? half + length : f.xy, s = half.hi >= 0 ? f.xy : length - half;
  const Number norm = root(c * c + s * s);
  if (!(norm.hi > 0)) return {Number(1), Number(0)};
  return {quotient(c, norm), quotient(s, norm)};
}

/// F P F^T, or F F^T of a factor's image where P is its product.
using Row = std::array<Number, 3>;
Number dot(const Row& x, const Row& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }
Row times(const Matrix3d& m, const Row& x) {
  Row r;
  for (int i = 0; i < 3; ++i) r[std::size_t(i)] = dot({m(i, 0), m(i, 1), m(i, 2)}, x);
  return r;
}
Form seen(const Matrix3d& m, const Row& e1, const Row& e2) {
  const Row p = times(m, e1), q = times(m, e2);
  return {dot(e1, p), dot(e1, q), dot(e2, q)};
}
Form seen(const Ellipsoid& body, double unit, const Row& e1, const Row& e2) {
  if (!body.defined_by_factor()) return seen(Matrix3d(body.shape() * (unit * unit)), e1, e2);
  const Matrix3d transposed = body.factor().transpose() * unit;
  const Row p = times(transposed, e1), q = times(transposed, e2);
  return {dot(p, p), dot(p, q), dot(q, q)};
}

double power_of_two_near(double x) { return x > 0 ? std::ldexp(1.0, std::ilogb(x)) : 1; }

}  // namespace

Shadow::Shadow(const Ellipsoid& a, const Ellipsoid& b, const Vector3d& w, const Matrix3d& covariance) {
  // In a unit of length in which nothing overflows, along two exact vectors across w.
  const double size = std::sqrt(covariance.diagonal().maxCoeff());
  const double bodies = std::max(a.factor().norm(), b.factor().norm());
  const double unit = 1 / power_of_two_near(std::max(size, 1e-100 * bodies));
  Eigen::Index k = 0;
  const double fastest = w.cwiseAbs().maxCoeff(&k);
  const Vector3d u = w / power_of_two_near(fastest);
  const std::size_t i = std::size_t(k + 1) % 3, j = std::size_t(k + 2) % 3, main = std::size_t(k);
  Row e1, e2;
  e1[main] = -u(Eigen::Index(i)), e1[i] = u(k), e1[j] = 0;
  for (std::size_t n = 0; n < 3; ++n) {
    const std::size_t p = (n + 1) % 3, q = (n + 2) % 3;
    e2[n] = Number(u(Eigen::Index(p))) * e1[q] - Number(u(Eigen::Index(q))) * e1[p];
  }
  Row between;
  for (std::size_t n = 0; n < 3; ++n)
    between[n] = Number::two_sum(unit * a.center()(Eigen::Index(n)), -unit * b.center()(Eigen::Index(n)));
  Number cx = dot(e1, between), cy = dot(e2, between);
  Form c = seen(Matrix3d(covariance * (unit * unit)), e1, e2);
  Form of_a = seen(a, unit, e1, e2), of_b = seen(b, unit, e1, e2);
  if (c.yy.hi > c.xx.hi) {
    // Mirrored, which changes no probability.
    std::swap(cx, cy);
    for (Form* f : {&c, &of_a, &of_b}) std::swap(f->xx, f->yy);
  }

  still = !(c.xx.hi > 1e-150);
  const Number slope = still ? Number(0) : quotient(c.xy, c.xx);
  const Number across = c.sheared(slope).yy;
  const double share = still ? 0 : across.hi / c.yy.hi;
  flat = still || !(share > 0x1p-60 && across.hi > 1e-16 * c.xx.hi);
  const Number deviation = still ? Number(1) : root(c.xx);
  cy = cy - slope * cx;
  of_a = of_a.sheared(slope), of_b = of_b.sheared(slope);
  // Of a flat error y is in units of the bodies' height.
  const Number height = flat ? root((of_a + of_b).yy) : root(across);
  const Number by_x = quotient(1, deviation), by_y = quotient(1, height);
  cx = cx * by_x, cy = cy * by_y;
  of_a = of_a.stretched(by_x, by_y), of_b = of_b.stretched(by_x, by_y);
  Form both = of_a + of_b;
  rounding = 0x1p-49;
  if (!flat) {
    rounding += 0x1p-94 / share;
    // Along the axes of the bodies, the longer one first.
    const auto [g, h] = main_axis(both);
    const Number turned = g * cx + h * cy;
    cy = g * cy - h * cx, cx = turned;
    of_a = of_a.turned(g, h), of_b = of_b.turned(g, h), both = of_a + of_b;
  } else if (across.hi > 0) {
    // Nine deviations across; the bodies reach as far up and down as the ellipse of both does at least.
    constexpr double kDeviations = 9;
    const double det = rounded(both.xx * both.yy - both.xy * both.xy);
    smear = kDeviations * rounded(root(across)) / rounded(height) * std::sqrt(rounded(both.xx) / det);
    beside = std::erfc(kDeviations / std::sqrt(2.0));
  }
  // The bodies on M = [sqrt(xx) 0; xy/sqrt(xx) sqrt(yy - xy^2/xx)] (axes of the first).
  const Number first = root(both.xx), lean = quotient(both.xy, first), second = root(both.yy - lean * lean);
  const Number tilt = quotient(both.xy, both.xx);
  const Number i1 = quotient(1, first), i2 = quotient(1, second);
  const Form part_a = of_a.sheared(tilt).stretched(i1, i2), part_b = of_b.sheared(tilt).stretched(i1, i2);
  const auto [g, h] = main_axis(part_a);
  const Form at = part_a.turned(g, h), bt = part_b.turned(g, h);
  l1 = rounded(at.xx), l2 = rounded(at.yy), m1 = rounded(bt.xx), m2 = rounded(bt.yy);
  ax = rounded(first * g), bx = -rounded(first * h);
  ay = rounded(lean * g + second * h), by = rounded(second * g - lean * h);
  x = rounded(cx), y = rounded(cy);
}

}  // namespace vericone::gaussian
