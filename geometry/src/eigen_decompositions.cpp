// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/internal/geometry/decompositions.h>

#include <Eigen/Eigenvalues>

namespace vericone {

template <int N>
SymmetricEigen<N> symmetric_eigen(const Eigen::Matrix<double, N, N>& a) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, N, N>> solver(a);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

template <int N>
Eigen::Matrix<double, N, 1> symmetric_eigenvalues(const Eigen::Matrix<double, N, N>& a) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, N, N>>(a, Eigen::EigenvaluesOnly).eigenvalues();
}

template SymmetricEigen<2> symmetric_eigen<2>(const Eigen::Matrix2d&);
template SymmetricEigen<3> symmetric_eigen<3>(const Eigen::Matrix3d&);
template SymmetricEigen<6> symmetric_eigen<6>(const Eigen::Matrix<double, 6, 6>&);
template Eigen::Vector2d symmetric_eigenvalues<2>(const Eigen::Matrix2d&);
template Eigen::Vector3d symmetric_eigenvalues<3>(const Eigen::Matrix3d&);

}  // namespace vericone
