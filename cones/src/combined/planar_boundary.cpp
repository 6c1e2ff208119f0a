// SPDX-License-Identifier: BSD-3-Clause
#include "combined/planar_boundary.h"

#include <vericone/internal/geometry/double_double.h>
#include <vericone/internal/geometry/lengths.h>
#include <cmath>

namespace vericone {

using Eigen::Matrix2d;
using Eigen::Vector2d;

namespace {

/// Roundings of a value, relative to the terms it is summed from: a point that far outside counts as on the
/// body. Which of the two it is does not matter where a corner is that near; only both must not be lost.
constexpr double kRoundings = 1e-15;

bool within(const Matrix2d& m, double level, const Vector2d& x) {
  const double xx = m(0, 0) * x.x() * x.x(), xy = 2 * m(0, 1) * x.x() * x.y(), yy = m(1, 1) * x.y() * x.y();
  return xx + xy + yy <= level + kRoundings * (std::abs(xx) + std::abs(xy) + std::abs(yy) + level);
}

/// F with F F^T = level M^{-1}, M positive definite, by one Jacobi rotation.
Matrix2d factor_of(const Matrix2d& m, double level) {
  const double angle = 0.5 * std::atan2(2 * m(0, 1), m(0, 0) - m(1, 1));
  const double c = std::cos(angle), s = std::sin(angle);
  const double mean = 0.5 * (m(0, 0) + m(1, 1)), reach = std::hypot(0.5 * (m(0, 0) - m(1, 1)), m(0, 1));
  // The smaller eigenvalue without cancellation: it is the square of the long axis.
  const DoubleDouble determinant =
      DoubleDouble::two_product(m(0, 0), m(1, 1)) - DoubleDouble::two_product(m(0, 1), m(0, 1));
  const double large = mean + reach, small = static_cast<double>(determinant) / large;
  const double p = std::sqrt(level / large), q = std::sqrt(level / small);
  Matrix2d f;
  f << c * p, -s * q, s * p, c * q;
  return f;
}

/// xx x^2 + 2 xy x y + yy y^2 with 31 digits.
DoubleDouble form(const DoubleDouble& xx, const DoubleDouble& xy, const DoubleDouble& yy, const Vector2d& p) {
  const DoubleDouble x = p.x(), y = p.y(), mixed = xy * (x * y);
  return xx * (x * x) + mixed + mixed + yy * (y * y);
}

/// By how much a point misses a conic (where the centre's value is -1, or 0 at level 0), with the digits that
/// a thin body's matrix would lose.
double residual(const CombinedEllipse& body, int conic, const Vector2d& p) {
  if (conic > 0) {
    const auto& [m, level] = body.delimiters()[conic - 1];
    const double value = static_cast<double>(form(m(0, 0), m(0, 1), m(1, 1), p) - DoubleDouble(level));
    return level > 0 ? value / level : value;
  }
  if (body.ellipsoid().defined_by_factor()) {
    const Matrix2d& f = body.ellipsoid().factor();
    const DoubleDouble x = p.x(), y = p.y(), u = x * f(1, 1) - y * f(0, 1), v = y * f(0, 0) - x * f(1, 0);
    const DoubleDouble determinant =
        DoubleDouble::two_product(f(0, 0), f(1, 1)) - DoubleDouble::two_product(f(0, 1), f(1, 0));
    const DoubleDouble square = determinant * determinant;
    return static_cast<double>(u * u + v * v - square) / static_cast<double>(square);
  }
  const Matrix2d& s = body.ellipsoid().shape();
  const DoubleDouble determinant =
      DoubleDouble::two_product(s(0, 0), s(1, 1)) - DoubleDouble::two_product(s(0, 1), s(0, 1));
  return static_cast<double>(form(s(1, 1), -s(0, 1), s(0, 0), p) - determinant) /
         static_cast<double>(determinant);
}

/// One step of Newton's method for the crossing of two conics, u where the ellipse is the unit disc.
Vector2d polished(const CombinedEllipse& body, int i, int j, const Vector2d& u, const Matrix2d& of_i,
                  const Matrix2d& of_j, double level_i, double level_j) {
  const Vector2d offset = body.ellipsoid().factor() * u;
  Matrix2d slopes;
  slopes << (2 / (level_i > 0 ? level_i : 1) * of_i * u).transpose(),
      (2 / (level_j > 0 ? level_j : 1) * of_j * u).transpose();
  const Vector2d step = slopes.inverse() * Vector2d(residual(body, i, offset), residual(body, j, offset));
  // Conics that hardly cross have no better corner than this one.
  constexpr double kSmallStep = 1e-5;
  return step.norm() < kSmallStep * u.norm() ? Vector2d(offset - body.ellipsoid().factor() * step) : offset;
}

}  // namespace

PlanarBoundary::PlanarBoundary(const CombinedEllipse& body) : body_(&body) {
  const Matrix2d& f = body.ellipsoid().factor();
  rounds_.push_back({0, f, scaled_inverse<2>(f)});
  for (std::size_t i = 0; i < body.delimiters().size(); ++i) {
    const auto& [m, level] = body.delimiters()[i];
    if (!(level > 0) || !(m(0, 0) + m(1, 1) > 0) || !(m(0, 0) * m(1, 1) - m(0, 1) * m(0, 1) > 0)) continue;
    const Matrix2d factor = factor_of(m, level);
    if (factor.allFinite()) rounds_.push_back({static_cast<int>(i) + 1, factor, scaled_inverse<2>(factor)});
  }
}

bool PlanarBoundary::on_body(const Vector2d& offset, int of) const {
  if (of != 0 && (rounds_[0].inverse * offset).squaredNorm() > 1 + kRoundings) return false;
  for (int i = 1; i < conics(); ++i) {
    const Delimiter<2>& d = body_->delimiters()[i - 1];
    if (i != of && !within(d.matrix, d.level, offset)) return false;
  }
  return true;
}

Matrix2d PlanarBoundary::matrix(int conic) const {
  if (conic == 0) return Matrix2d::Identity();
  const Matrix2d& f = rounds_[0].factor;
  const Matrix2d m = f.transpose() * body_->delimiters()[conic - 1].matrix * f;
  return 0.5 * (m + m.transpose());
}

int root_directions(const Matrix2d& h, Vector2d roots[2]) {
  const double discriminant = h(0, 1) * h(0, 1) - h(0, 0) * h(1, 1);
  if (!(discriminant > 0)) return 0;
  const double q = -(h(0, 1) + std::copysign(std::sqrt(discriminant), h(0, 1)));
  roots[0] = Vector2d(q, h(0, 0)).normalized();
  roots[1] = Vector2d(h(1, 1), q).normalized();
  return 2;
}

SmallList<PlanarBoundary::CornerPoint, 16> PlanarBoundary::corners() const {
  SmallList<CornerPoint, 16> all;
  const int count = conics();
  bool pinched = false;
  for (int i = 0; i < count; ++i) {
    const Matrix2d a = matrix(i);
    pinched = pinched || level(i) == 0;
    for (int j = i + 1; j < count; ++j) {
      // On both curves r^2 u^T A_i u = level_i and r^2 u^T A_j u = level_j. The radius is taken from the
      // curve of the higher level: at level 0 a curve says nothing about it.
      const Matrix2d b = matrix(j);
      Vector2d roots[2];
      const int found = root_directions(level(j) * a - level(i) * b, roots);
      for (int k = 0; k < found; ++k) {
        const Vector2d& u = roots[k];
        const double highest = std::max(level(i), level(j));
        const double value = u.dot((level(i) >= level(j) ? a : b) * u);
        if (!(value > 0) || !(highest > 0)) continue;
        const double r = std::sqrt(highest / value);
        bool valid = true;
        for (int other = 0; other < count && valid; ++other)
          valid = other == i || other == j || within(matrix(other), level(other), r * u);
        if (!valid) continue;
        const Vector2d offset = polished(*body_, i, j, r * u, a, b, level(i), level(j));
        all.push_back({offset, i, j});
        all.push_back({-offset, i, j});
      }
    }
  }
  if (pinched && all.empty()) all.push_back({Vector2d::Zero(), 0, 0});
  return all;
}

Ellipse round_ellipse(const PlanarBoundary& boundary, const PlanarBoundary::Round& round) {
  if (round.conic == 0) return boundary.body().ellipsoid();
  const Vector2d axes(round.factor.col(0).norm(), round.factor.col(1).norm());
  return Ellipse::from_axes(boundary.body().center(), axes, round.factor * axes.cwiseInverse().asDiagonal());
}

}  // namespace vericone
