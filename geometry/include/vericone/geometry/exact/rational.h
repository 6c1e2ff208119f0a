// SPDX-License-Identifier: BSD-3-Clause
//
// Exact arithmetic of the last rung of every predicate. Slow to compile and to run: include it in .cpp files.
#pragma once

#include <vericone/geometry/ellipsoid.h>
#include <vericone/geometry/sign.h>
#include <Eigen/Core>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <utility>

namespace vericone::exact {

using Rational =
    boost::multiprecision::number<boost::multiprecision::cpp_rational_backend, boost::multiprecision::et_off>;

template <int D>
using RationalVector = std::array<Rational, D>;
template <int D>
using RationalMatrix = std::array<std::array<Rational, D>, D>;

[[nodiscard]] inline int sign(const Rational& x) { return x.sign(); }

template <int D>
[[nodiscard]] RationalVector<D> to_rational(const Eigen::Matrix<double, D, 1>& v) {
  RationalVector<D> r;
  for (int i = 0; i < D; ++i) r[i] = v(i);
  return r;
}

template <int D>
[[nodiscard]] RationalMatrix<D> to_rational(const Eigen::Matrix<double, D, D>& m) {
  RationalMatrix<D> r;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) r[i][j] = m(i, j);
  return r;
}

/// Determinant by elimination; exact.
template <int D>
[[nodiscard]] Rational determinant(RationalMatrix<D> m) {
  Rational det = 1;
  for (int k = 0; k < D; ++k) {
    int pivot = k;
    while (pivot < D && m[pivot][k] == 0) ++pivot;
    if (pivot == D) return 0;
    if (pivot != k) {
      std::swap(m[pivot], m[k]);
      det = -det;
    }
    det *= m[k][k];
    for (int i = k + 1; i < D; ++i) {
      const Rational f = m[i][k] / m[k][k];
      for (int j = k; j < D; ++j) m[i][j] -= f * m[k][j];
    }
  }
  return det;
}

/// Whether all leading minors are positive (Sylvester).
template <int D>
[[nodiscard]] bool positive_definite(const RationalMatrix<D>& m) {
  if (m[0][0].sign() <= 0) return false;
  if (m[0][0] * m[1][1] - m[0][1] * m[1][0] <= 0) return false;
  if constexpr (D == 3) return determinant<3>(m).sign() > 0;
  return true;
}

// Ellipsoids in rational numbers. Slow to compile: include it in .cpp files.

/// The shape matrix that *defines* the body (see BasicEllipsoid).
template <int D>
[[nodiscard]] RationalMatrix<D> defining_shape(const BasicEllipsoid<D>& body) {
  if (!body.defined_by_factor()) return to_rational<D>(body.shape());
  const RationalMatrix<D> f = to_rational<D>(body.factor());
  RationalMatrix<D> s;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j <= i; ++j) {
      Rational sum = 0;
      for (int k = 0; k < D; ++k) sum += f[i][k] * f[j][k];
      s[i][j] = s[j][i] = sum;
    }
  return s;
}

/// An ellipsoid (D = 3) or ellipse (D = 2) in rational numbers: what BasicEllipsoid is to doubles.
template <int D>
struct RationalBody {
  RationalVector<D> center;
  RationalMatrix<D> shape;  // symmetric, positive definite

  RationalBody() = default;
  RationalBody(RationalVector<D> p, RationalMatrix<D> s) : center(std::move(p)), shape(std::move(s)) {}
  explicit RationalBody(const BasicEllipsoid<D>& body)
      : center(to_rational<D>(body.center())), shape(defining_shape<D>(body)) {}
};

// The last rung of side() for input in rational numbers.

/// For rational coordinates.
template <int D>
[[nodiscard]] Sign side(const RationalMatrix<D + 1>& quadric, const RationalVector<D>& point);
template <int D>
[[nodiscard]] Sign side(const RationalBody<D>& body, const RationalVector<D>& point);

}  // namespace vericone::exact
