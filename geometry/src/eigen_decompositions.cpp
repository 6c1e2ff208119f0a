// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/decompositions.h>

#include <Eigen/Cholesky>
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

template <int N>
bool generalized_eigen(const Eigen::Matrix<double, N, N>& a, const Eigen::Matrix<double, N, N>& b,
                       SymmetricEigen<N>& result) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix<double, N, N>> solver(a, b);
  result = {solver.eigenvalues(), solver.eigenvectors()};
  return solver.info() == Eigen::Success;
}

template SymmetricEigen<2> symmetric_eigen<2>(const Eigen::Matrix2d&);
template SymmetricEigen<3> symmetric_eigen<3>(const Eigen::Matrix3d&);
template SymmetricEigen<Eigen::Dynamic> symmetric_eigen<Eigen::Dynamic>(const Eigen::MatrixXd&);
template Eigen::Vector2d symmetric_eigenvalues<2>(const Eigen::Matrix2d&);
template Eigen::Vector3d symmetric_eigenvalues<3>(const Eigen::Matrix3d&);
template bool generalized_eigen<3>(const Eigen::Matrix3d&, const Eigen::Matrix3d&, SymmetricEigen<3>&);
template bool generalized_eigen<Eigen::Dynamic>(const Eigen::MatrixXd&, const Eigen::MatrixXd&,
                                                SymmetricEigen<Eigen::Dynamic>&);

}  // namespace vericone
