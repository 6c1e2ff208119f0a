// SPDX-License-Identifier: BSD-3-Clause
//
// Lengths of any unit, and of vectors anywhere in memory.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>

namespace vericone {

/// F^{-1} for lengths of any unit: the determinant of a body of 1e103 metres would overflow. Powers of two
/// are exact.
template <int D>
[[nodiscard]] Eigen::Matrix<double, D, D> scaled_inverse(const Eigen::Matrix<double, D, D>& f) {
  const double most = f.cwiseAbs().maxCoeff();
  if (!(most > 0) || std::isinf(most)) return f.inverse();  // there is none: infinite, or not numbers
  const double scale = std::ldexp(1.0, -std::ilogb(most));
  return Eigen::Matrix<double, D, D>(f * scale).inverse() * scale;
}

namespace detail {

/// |v|, to 3 units in the last place, without overflow or underflow in between. Eigen's stableNorm() adds in
/// an order that depends on the address of v, so that its last bit does too.
template <typename Derived>
[[nodiscard]] double length(const Eigen::MatrixBase<Derived>& v) {
  const double square = v.squaredNorm();
  if (square > 1e-280 && square < 1e280) return std::sqrt(square);
  const double most = v.cwiseAbs().maxCoeff();
  if (!(most > 0) || std::isinf(most)) return square > 0 ? square : most;  // zero, infinite or not a number
  const double scale = most < 1 ? 0x1p600 : 0x1p-600;
  return std::sqrt((v * scale).squaredNorm()) / scale;
}

}  // namespace detail

}  // namespace vericone
