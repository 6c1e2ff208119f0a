// SPDX-License-Identifier: BSD-3-Clause
//
// Two bodies in intervals, for certificates about points and normals that a floating search has found.
#pragma once

#include <vericone/geometry/ellipsoid.h>
#include <vericone/geometry/interval.h>
#include <algorithm>
#include <array>
#include <cmath>

namespace vericone {

/// x / 2^e; what a subnormal result loses is in the radius.
inline Interval scaled_down(double x, int e) {
  const double y = std::ldexp(x, -e);
  return std::abs(y) >= 0x1p-1000 || x == 0 ? Interval(y) : Interval(y, Interval::kTiny);
}
inline Interval scaled_down(const Interval& x, int e) {
  return {std::ldexp(x.mid(), -e), std::ldexp(x.rad(), -e) * Interval::kInflate + Interval::kTiny};
}

/// A body about its centre, in units of 2^e.
template <int D>
class EnclosedBody {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;
  using IntervalVector = std::array<Interval, D>;

  EnclosedBody(const BasicEllipsoid<D>& body, int e) : by_factor_(body.defined_by_factor()) {
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j)
        m_[i][j] = by_factor_ ? scaled_down(body.factor()(i, j), e) : scaled_down(body.shape()(i, j), 2 * e);
  }

  /// rho(n) = sqrt(n^T S n) and S n, for a vector of doubles or of intervals. S n / rho is the supporting
  /// point: for each n of a box exactly on the body.
  struct Support {
    Interval rho;
    IntervalVector shape_times_n;

    IntervalVector point() const {
      IntervalVector p;
      for (int i = 0; i < D; ++i) p[i] = shape_times_n[i] / rho;
      return p;
    }
  };
  template <typename Normal>
  Support support(const Normal& n) const {
    Support r;
    IntervalVector u;
    Interval sum = 0;
    for (int i = 0; i < D; ++i) {
      u[i] = 0;
      for (int j = 0; j < D; ++j) u[i] = u[i] + (by_factor_ ? m_[j][i] : m_[i][j]) * Interval(n[j]);
      sum = sum + (by_factor_ ? square(u[i]) : u[i] * Interval(n[i]));
    }
    r.rho = sqrt(sum);
    for (int i = 0; i < D; ++i) {
      r.shape_times_n[i] = by_factor_ ? Interval(0) : u[i];
      for (int j = 0; by_factor_ && j < D; ++j) r.shape_times_n[i] = r.shape_times_n[i] + m_[i][j] * u[j];
    }
    return r;
  }

  /// Whether the body certainly contains the point centre + y: |adj(F) y|^2 < det(F)^2, or
  /// y^T adj(S) y < det S.
  bool surely_contains(const IntervalVector& y) const {
    Interval adj[D][D], det = 0, sum = 0;
    if constexpr (D == 2) {
      adj[0][0] = m_[1][1];
      adj[0][1] = -m_[0][1];
      adj[1][0] = -m_[1][0];
      adj[1][1] = m_[0][0];
    } else {
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          const int r0 = (j + 1) % 3, r1 = (j + 2) % 3, c0 = (i + 1) % 3, c1 = (i + 2) % 3;
          adj[i][j] = m_[r0][c0] * m_[r1][c1] - m_[r0][c1] * m_[r1][c0];
        }
    }
    for (int j = 0; j < D; ++j) det = det + m_[0][j] * adj[j][0];
    for (int i = 0; i < D; ++i) {
      Interval u = 0;
      for (int j = 0; j < D; ++j) u = u + adj[i][j] * y[j];
      sum = sum + (by_factor_ ? square(u) : u * y[i]);
    }
    return ((by_factor_ ? square(det) : det) - sum).positive();
  }

 private:
  bool by_factor_;
  Interval m_[D][D];  // the matrix that defines the body
};

/// Both bodies and c = p_B - p_A, in units of 2^exponent so that the largest length is near one.
template <int D>
struct EnclosedPair {
  using Vector = typename EnclosedBody<D>::Vector;
  using Matrix = Eigen::Matrix<double, D, D>;

  bool usable;
  int exponent;
  EnclosedBody<D> a, b;
  std::array<Interval, D> c;
  // The same rounded, for searching.
  Matrix factor_a, factor_b;
  Vector center_line;

  EnclosedPair(const BasicEllipsoid<D>& body_a, const BasicEllipsoid<D>& body_b)
      : usable(std::isfinite(largest(body_a, body_b))),
        exponent(usable ? std::ilogb(largest(body_a, body_b)) + 1 : 0),
        a(body_a, exponent),
        b(body_b, exponent) {
    for (int i = 0; i < D; ++i) {
      c[i] = scaled_down(body_b.center()(i), exponent) - scaled_down(body_a.center()(i), exponent);
      center_line(i) = c[i].mid();
      for (int j = 0; j < D; ++j) {
        factor_a(i, j) = std::ldexp(body_a.factor()(i, j), -exponent);
        factor_b(i, j) = std::ldexp(body_b.factor()(i, j), -exponent);
      }
    }
  }

  /// g(n) = n.c - rho_A(n) - rho_B(n).
  template <typename Normal>
  Interval gap(const Normal& n) const {
    Interval along = 0;
    for (int i = 0; i < D; ++i) along = along + c[i] * Interval(n[i]);
    return along - (a.support(n).rho + b.support(n).rho);
  }

 private:
  static double largest(const BasicEllipsoid<D>& body_a, const BasicEllipsoid<D>& body_b) {
    return std::max({(body_b.center() - body_a.center()).cwiseAbs().maxCoeff(),
                     body_a.factor().cwiseAbs().maxCoeff(), body_b.factor().cwiseAbs().maxCoeff()});
  }
};

}  // namespace vericone
