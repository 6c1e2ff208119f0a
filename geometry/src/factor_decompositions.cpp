// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/decompositions.h>

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <Eigen/SVD>

namespace vericone {

template <int N>
Cholesky<N> cholesky(const Eigen::Matrix<double, N, N>& a) {
  const Eigen::LLT<Eigen::Matrix<double, N, N>> llt(a);
  return {llt.matrixL(), llt.info() == Eigen::Success};
}

template <int N>
Eigen::Matrix<double, N, 1> Cholesky<N>::half_solve(const Eigen::Matrix<double, N, 1>& x) const {
  return lower.template triangularView<Eigen::Lower>().solve(x);
}

template <int N>
Eigen::Matrix<double, N, 1> Cholesky<N>::solve(const Eigen::Matrix<double, N, 1>& x) const {
  return lower.template triangularView<Eigen::Lower>().transpose().solve(half_solve(x));
}

template <int N>
Eigen::Matrix<double, N, N> Cholesky<N>::lower_inverse() const {
  return lower.template triangularView<Eigen::Lower>().solve(Eigen::Matrix<double, N, N>::Identity());
}

template <int N>
Eigen::Matrix<double, N, N> Cholesky<N>::inverse() const {
  return lower.template triangularView<Eigen::Lower>().transpose().solve(lower_inverse());
}

template <int N>
LeftSingular<N> left_singular(const Eigen::Matrix<double, N, N>& a) {
  const Eigen::JacobiSVD<Eigen::Matrix<double, N, N>> svd(a, Eigen::ComputeFullU);
  return {svd.singularValues(), svd.matrixU()};
}

template <int N>
Eigen::Matrix<double, N, 1> singular_values(const Eigen::Matrix<double, N, N>& a) {
  return Eigen::JacobiSVD<Eigen::Matrix<double, N, N>>(a).singularValues();
}

template <int N>
Eigen::Matrix<double, N, N> nearest_orthogonal(const Eigen::Matrix<double, N, N>& a) {
  const Eigen::JacobiSVD<Eigen::Matrix<double, N, N>> svd(a, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

Eigen::VectorXd shortest_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  return a.completeOrthogonalDecomposition().solve(b);
}

Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  return a.colPivHouseholderQr().solve(b);
}

// Of the members what is used: each size of each costs half a second.
template Eigen::Vector2d Cholesky<2>::half_solve(const Eigen::Vector2d&) const;
template Eigen::Vector3d Cholesky<3>::half_solve(const Eigen::Vector3d&) const;
template Eigen::Vector3d Cholesky<3>::solve(const Eigen::Vector3d&) const;
template Eigen::Matrix2d Cholesky<2>::lower_inverse() const;
template Eigen::Matrix3d Cholesky<3>::lower_inverse() const;
template Eigen::Matrix3d Cholesky<3>::inverse() const;
template Cholesky<2> cholesky<2>(const Eigen::Matrix2d&);
template Cholesky<3> cholesky<3>(const Eigen::Matrix3d&);
template Cholesky<4> cholesky<4>(const Eigen::Matrix4d&);
template LeftSingular<2> left_singular<2>(const Eigen::Matrix2d&);
template LeftSingular<3> left_singular<3>(const Eigen::Matrix3d&);
template Eigen::Vector2d singular_values<2>(const Eigen::Matrix2d&);
template Eigen::Vector3d singular_values<3>(const Eigen::Matrix3d&);
template Eigen::Matrix2d nearest_orthogonal<2>(const Eigen::Matrix2d&);
template Eigen::Matrix3d nearest_orthogonal<3>(const Eigen::Matrix3d&);

}  // namespace vericone
