// SPDX-License-Identifier: BSD-3-Clause
#include "proof/quadratic_form.h"

#include <Eigen/QR>
#include <cmath>

#include "proof/rational_quadric.h"

namespace vericone::fitting {
namespace {

using exact::Integer;
using exact::Rational;

exact::RationalMatrix<4> rational(const Quadric& quadric) {
  return exact::to_rational<4>(Eigen::Matrix4d(quadric.matrix()));
}

/// All principal minors are not negative.
bool positive_semidefinite(const exact::IntegerMatrix<4>& m) {
  const auto minor = [&](std::size_t i, std::size_t j) {
    return Integer(m[i][i] * m[j][j] - m[i][j] * m[i][j]);
  };
  for (std::size_t i = 0; i < 3; ++i)
    if (m[i][i].sign() < 0 || minor(i, (i + 1) % 3).sign() < 0) return false;
  const Integer det = m[0][0] * minor(1, 2) - m[0][1] * (m[0][1] * m[2][2] - m[0][2] * m[1][2]) +
                      m[0][2] * (m[0][1] * m[1][2] - m[0][2] * m[1][1]);
  return det.sign() >= 0;
}

}  // namespace

QuadraticForm::QuadraticForm(const Quadric& quadric, const Eigen::Vector3d& near)
    : QuadraticForm(rational(quadric), near) {}

QuadraticForm::QuadraticForm(const exact::RationalMatrix<4>& matrix, const Eigen::Vector3d& near)
    : near_(near) {
  Integer common = 1;
  for (const auto& row : matrix)
    for (const Rational& x : row) common = lcm(common, denominator(x));
  unit_ = Rational(Integer(1), common);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      integers_[i][j] = numerator(matrix[i][j]) * (common / denominator(matrix[i][j]));
  convex_ = positive_semidefinite(integers_);

  const exact::RationalVector<3> p = exact::to_rational<3>(near);
  exact::RationalMatrix<3> second;
  exact::RationalVector<3> first;
  Rational c = matrix[3][3];
  for (std::size_t i = 0; i < 3; ++i) {
    Rational b = matrix[i][3];
    for (std::size_t j = 0; j < 3; ++j) {
      second[i][j] = matrix[i][j];
      a_[i][j] = enclosed(matrix[i][j]);
      b += matrix[i][j] * p[j];
    }
    first[i] = b;
    b_[i] = enclosed(b);
    c += p[i] * (b + matrix[i][3]);
  }
  c_ = enclosed(c);
  squares_ = SquaresForm(second, first, c);

  Eigen::Matrix3d a;
  Eigen::Vector3d b;
  for (int i = 0; i < 3; ++i) {
    b(i) = b_[static_cast<std::size_t>(i)].mid();
    for (int j = 0; j < 3; ++j) a(i, j) = a_[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)].mid();
  }
  const Eigen::Vector3d center = -a.completeOrthogonalDecomposition().solve(b);
  depth_ = -(c_.mid() + b.dot(center));
}

QuadraticForm::At QuadraticForm::at(const Eigen::Vector3d& x) const {
  At r;
  for (std::size_t i = 0; i < 3; ++i)
    r.offset[i] = Interval(x(static_cast<int>(i))) - Interval(near_(static_cast<int>(i)));
  for (std::size_t i = 0; i < 3; ++i)
    r.half_gradient[i] = a_[i][0] * r.offset[0] + a_[i][1] * r.offset[1] + a_[i][2] * r.offset[2] + b_[i];
  r.rest = b_[0] * r.offset[0] + b_[1] * r.offset[1] + b_[2] * r.offset[2] + c_;
  r.value = polar(r, r);
  return r;
}

QuadraticForm::At QuadraticForm::narrowly_at(const Eigen::Vector3d& x) const {
  At r = at(x);
  const Interval value = squares_.value(r.offset);
  if (value.rad() < r.value.rad()) r.value = value;
  return r;
}

double QuadraticForm::approximately(const Eigen::Vector3d& x) const {
  const Eigen::Vector3d d = x - near_;
  double sum = c_.mid();
  for (std::size_t i = 0; i < 3; ++i) {
    const double di = d(static_cast<int>(i));
    sum += 2 * b_[i].mid() * di;
    for (std::size_t j = 0; j < 3; ++j) sum += di * a_[i][j].mid() * d(static_cast<int>(j));
  }
  return sum;
}

template <int N>
ExactPolars<N> QuadraticForm::exact_polars(const std::array<Eigen::Vector3d, N>& points) const {
  constexpr int kNone = 1 << 20;
  int e = 0;
  for (const auto& x : points)
    for (int i = 0; i < 3; ++i) e = std::min(e, exact::grid_exponent(x(i), kNone));
  ExactPolars<N> r;
  r.exponent = 2 * e;
  std::array<exact::IntegerVector<4>, N> x, q;
  for (std::size_t n = 0; n < N; ++n) {
    for (std::size_t i = 0; i < 4; ++i)
      x[n][i] = exact::on_grid(i < 3 ? points[n](static_cast<int>(i)) : 1.0, e);
    for (std::size_t i = 0; i < 4; ++i) {
      q[n][i] = 0;
      for (std::size_t j = 0; j < 4; ++j) q[n][i] += integers_[i][j] * x[n][j];
    }
    for (std::size_t m = 0; m <= n; ++m) {
      r.form[n][m] = 0;
      for (std::size_t i = 0; i < 4; ++i) r.form[n][m] += q[n][i] * x[m][i];
      r.form[m][n] = r.form[n][m];
    }
  }
  return r;
}

exact::Rational QuadraticForm::number(const Integer& entry, int exponent) const {
  const Integer power = Integer(1) << static_cast<unsigned>(std::abs(exponent));
  return unit_ * (exponent >= 0 ? Rational(entry * power) : Rational(entry, power));
}

template ExactPolars<1> QuadraticForm::exact_polars<1>(const std::array<Eigen::Vector3d, 1>&) const;
template ExactPolars<3> QuadraticForm::exact_polars<3>(const std::array<Eigen::Vector3d, 3>&) const;

}  // namespace vericone::fitting
