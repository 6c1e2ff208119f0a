// SPDX-License-Identifier: BSD-3-Clause
#include "dense_eigen.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace vericone::fitting {

SymmetricEigen<Eigen::Dynamic> dense_eigen(const Eigen::MatrixXd& a) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(a);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

template <int N>
bool generalized_eigen(const Eigen::Matrix<double, N, N>& a, const Eigen::Matrix<double, N, N>& b,
                       SymmetricEigen<N>& result) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix<double, N, N>> solver(a, b);
  result = {solver.eigenvalues(), solver.eigenvectors()};
  return solver.info() == Eigen::Success;
}

template bool generalized_eigen<3>(const Eigen::Matrix3d&, const Eigen::Matrix3d&, SymmetricEigen<3>&);
template bool generalized_eigen<Eigen::Dynamic>(const Eigen::MatrixXd&, const Eigen::MatrixXd&,
                                                SymmetricEigen<Eigen::Dynamic>&);

}  // namespace vericone::fitting
