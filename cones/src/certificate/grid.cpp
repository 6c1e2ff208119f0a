// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/grid.h"

#include <cmath>
#include <limits>

namespace vericone::certificates {

Matrix adjugate(const Matrix& m) {
  Matrix r;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int r0 = (j + 1) % 3, r1 = (j + 2) % 3, c0 = (i + 1) % 3, c1 = (i + 2) % 3;
      r[i][j] = m[r0][c0] * m[r1][c1] - m[r0][c1] * m[r1][c0];
    }
  return r;
}

Matrix transposed(const Matrix& m) {
  Matrix r;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) r[i][j] = m[j][i];
  return r;
}

double to_double(const Integer& x, int exponent) {
  if (x.is_zero()) return 0;
  const Integer size = abs(x);
  const int bits = static_cast<int>(msb(size)) + 1, drop = std::max(0, bits - 62);
  const auto top = static_cast<std::int64_t>(Integer(size >> static_cast<unsigned>(drop)));
  const double value = std::ldexp(static_cast<double>(top), drop + exponent);
  return x.sign() < 0 ? -value : value;
}

int grid_of_matrix(const Ellipsoid& body) {
  if (body.defined_by_factor()) return grid_of(body.factor());
  return static_cast<int>(std::floor(grid_of(body.shape()) / 2.0));
}

Round::Round(const Ellipsoid& body, int grid) : by_factor_(body.defined_by_factor()) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      matrix_[i][j] = by_factor_ ? exact::on_grid(body.factor()(i, j), grid)
                                 : exact::on_grid(body.shape()(i, j), 2 * grid);
  finish();
}

Round::Round(double radius, int grid) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) matrix_[i][j] = i == j ? exact::on_grid(radius, grid) : Integer(0);
  finish();
}

void Round::finish() {
  adjugate_ = adjugate(matrix_);
  determinant_ =
      matrix_[0][0] * adjugate_[0][0] + matrix_[0][1] * adjugate_[1][0] + matrix_[0][2] * adjugate_[2][0];
  shape_ = matrix_;
  if (!by_factor_) return;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j <= i; ++j) shape_[i][j] = shape_[j][i] = dot(matrix_[i], matrix_[j]);
}

Integer Round::square(const Vector& n) const {
  if (!by_factor_) return dot(n, matrix_ * n);
  Integer sum = 0;
  for (int j = 0; j < 3; ++j) {
    const Integer u = matrix_[0][j] * n[0] + matrix_[1][j] * n[1] + matrix_[2][j] * n[2];
    sum += u * u;
  }
  return sum;
}

bool Round::holds(const Vector& v, unsigned finer) const {
  const Vector image = adjugate_ * v;
  if (by_factor_) return dot(image, image) < (determinant_ * determinant_) << (2 * finer);
  return dot(v, image) < determinant_ << (2 * finer);
}

Integer Convex::support(const Vector& n) const {
  Integer most = dot(n, points.front());
  for (std::size_t i = 1; i < points.size(); ++i) most = std::max(most, dot(n, points[i]));
  return most;
}

Motion::Motion(const Eigen::Vector3d& agent, const Eigen::Vector3d& obstacle, double t0, double t1, int on)
    : v_a(on_grid(agent, on)), v_b(on_grid(obstacle, on)), w(v_a - v_b), from(time_of(t0)), grid(on) {
  if (!std::isinf(t1)) until = time_of(t1);
}

int largest_entry(const Vector& w) {
  int k = 0;
  for (int i = 1; i < 3; ++i)
    if (abs(w[i]) > abs(w[k])) k = i;
  return k;
}

Plane plane_across(const Vector& w, int k, const Integer& a, const Integer& b) {
  const int i = (k + 1) % 3, j = (k + 2) % 3;
  Plane plane{{}, Plane::Across{k, a, b}};
  plane.normal[i] = a * w[k];
  plane.normal[j] = b * w[k];
  plane.normal[k] = -(a * w[i] + b * w[j]);
  return plane;
}

namespace {

/// Of gap g = n.c - h > sqrt(q_a) + sqrt(q_b), without the roots.
bool exceeds(const Integer& g, const Integer& q_a, const Integer& q_b) {
  if (g.sign() <= 0) return false;
  const Integer rest = g * g - q_a - q_b;
  return rest.sign() > 0 && rest * rest > 4 * q_a * q_b;
}

}  // namespace

bool separates_at(const Convex& a, const Convex& b, const Motion& motion, const Vector& n, const Dyadic& t) {
  const Vector back{-n[0], -n[1], -n[2]};
  const Integer still = -b.support(back) - a.support(n), along = dot(n, motion.w);
  const Integer gap = (still << t.exponent) - t.numerator * along;
  const auto square = [&](const Convex& body) {
    return body.round ? Integer(body.round->square(n) << (2 * t.exponent)) : Integer(0);
  };
  return exceeds(gap, square(a), square(b));
}

bool separates(const Convex& a, const Convex& b, const Motion& motion, const Vector& n) {
  const bool nearing = dot(n, motion.w).sign() > 0;
  if (nearing && !motion.until) return false;
  return separates_at(a, b, motion, n, nearing ? *motion.until : motion.from);
}

}  // namespace vericone::certificates
