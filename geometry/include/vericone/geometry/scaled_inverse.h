// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>

namespace vericone {

/// F^{-1} for lengths of any unit: the determinant of a body of 1e103 metres would overflow. Powers of two
/// are exact.
template <int D>
[[nodiscard]] Eigen::Matrix<double, D, D> scaled_inverse(const Eigen::Matrix<double, D, D>& f) {
  const double scale = std::ldexp(1.0, -std::ilogb(f.cwiseAbs().maxCoeff()));
  return Eigen::Matrix<double, D, D>(f * scale).inverse() * scale;
}

}  // namespace vericone
