// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace vericone::simulation {

/// The nearest rotation of a matrix that is one up to accumulated rounding: one step of Newton's iteration
/// for the polar factor, whose error is the square of what it is given.
template <int D>
Eigen::Matrix<double, D, D> orthonormal(const Eigen::Matrix<double, D, D>& r) {
  using Matrix = Eigen::Matrix<double, D, D>;
  const Matrix defect = Matrix::Identity() - r.transpose() * r;
  return r + 0.5 * (r * defect);
}

}  // namespace vericone::simulation
