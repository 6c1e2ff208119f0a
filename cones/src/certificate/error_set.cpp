// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/error_set.h"

#include <cmath>

namespace vericone::certificates {

Fractions fractions(const Eigen::Vector3d& v) { return {Rational(v.x()), Rational(v.y()), Rational(v.z())}; }

Rational dot(const Fractions& x, const Fractions& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }

void write(Text& text, const Fractions& v) {
  text.raw("[").number(v[0]).raw(", ").number(v[1]).raw(", ").number(v[2]).raw("]");
}

Rational root_above(const Rational& q) {
  if (q.sign() <= 0) return 0;
  const Integer above = numerator(q), below = denominator(q);
  const int bits = static_cast<int>(msb(above)) - static_cast<int>(msb(below));
  const auto shift = static_cast<unsigned>(std::max(0, 64 - bits / 2));
  return Rational(Integer(sqrt(Integer((above << (2 * shift)) / below)) + 1), Integer(1) << shift);
}

StatedErrors::StatedErrors(const ErrorSet& set) : set_(set) {
  const std::size_t parts = (set.radius() > 0 ? 1 : 0) + set.factors().size() + set.segments().size();
  if (parts == 0) return;
  kind_ = Kind::other;
  if (set.radius() > 0 && parts == 1) kind_ = Kind::ball;
  if (set.factors().size() == 1 && parts == 1) kind_ = Kind::factor;
  if (set.segments().size() != parts) return;
  for (const Eigen::Vector3d& g : set.segments()) {
    if ((g.array() != 0).count() != 1) return;
    int axis = 0;
    const double most = g.cwiseAbs().maxCoeff(&axis);
    if (half_(axis) != 0) return;
    half_(axis) = most;
  }
  kind_ = Kind::box;
}

Rational StatedErrors::most(const Fractions& n) const {
  switch (kind_) {
    case Kind::ball:
      return root_above(dot(n, n) * Rational(set_.radius()) * Rational(set_.radius()));
    case Kind::box: {
      const Fractions half = fractions(half_);
      return abs(n[0]) * half[0] + abs(n[1]) * half[1] + abs(n[2]) * half[2];
    }
    case Kind::factor: {
      Rational square = 0;
      for (int j = 0; j < 3; ++j) {
        const Rational along = dot(fractions(set_.factors().front().col(j)), n);
        square += along * along;
      }
      return root_above(square);
    }
    default:
      return 0;
  }
}

bool StatedErrors::contains(const Fractions& e) const {
  switch (kind_) {
    case Kind::ball:
      return dot(e, e) <= Rational(set_.radius()) * Rational(set_.radius());
    case Kind::box: {
      const Fractions half = fractions(half_);
      return abs(e[0]) <= half[0] && abs(e[1]) <= half[1] && abs(e[2]) <= half[2];
    }
    case Kind::factor: {
      // |adj(F) e|^2 <= det(F)^2
      const Eigen::Matrix3d& f = set_.factors().front();
      const int grid = grid_of(f);
      Matrix m;
      for (int i = 0; i < 3; ++i) m[i] = on_grid(f.row(i).transpose(), grid);
      const Matrix adjoint = adjugate(m);
      const Integer determinant = m[0][0] * adjoint[0][0] + m[0][1] * adjoint[1][0] + m[0][2] * adjoint[2][0];
      Rational square = 0;
      for (const Vector& row : adjoint) {
        const Rational along = Rational(row[0]) * e[0] + Rational(row[1]) * e[1] + Rational(row[2]) * e[2];
        square += along * along;
      }
      // F is the matrix in units of the grid, adj(F) in units of its square.
      const Rational size = Rational(determinant) * Rational(std::ldexp(1.0, grid));
      return !determinant.is_zero() && square <= size * size;
    }
    default:
      return e[0].is_zero() && e[1].is_zero() && e[2].is_zero();
  }
}

void StatedErrors::write(Text& text) const {
  if (kind_ == Kind::ball) text.raw("{\"ball\": ").number(set_.radius()).raw("}");
  if (kind_ == Kind::box) text.raw("{\"box\": ").number(half_).raw("}");
  if (kind_ != Kind::factor) return;
  const char* between = "{\"factor\": [";
  for (int i = 0; i < 3; ++i) {
    text.raw(between).number(Eigen::Vector3d(set_.factors().front().row(i).transpose()));
    between = ", ";
  }
  text.raw("]}");
}

}  // namespace vericone::certificates
