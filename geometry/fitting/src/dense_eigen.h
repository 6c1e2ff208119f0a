// SPDX-License-Identifier: BSD-3-Clause
//
// Eigenvalues that only fits need: of matrices of any size and of pencils. They cost 10 s of compiling, so
// they are compiled once and not in the core (geometry/decompositions.h).
#pragma once

#include <vericone/internal/geometry/decompositions.h>

namespace vericone::fitting {

/// Of a symmetric matrix of any size, whose lower triangle is read.
SymmetricEigen<Eigen::Dynamic> dense_eigen(const Eigen::MatrixXd& a);

/// a v = value b v for symmetric a and positive definite b; the values increase, v^T b v = 1. False: b is not
/// positive definite. N is 3 or Eigen::Dynamic.
template <int N>
bool generalized_eigen(const Eigen::Matrix<double, N, N>& a, const Eigen::Matrix<double, N, N>& b,
                       SymmetricEigen<N>& result);

}  // namespace vericone::fitting
