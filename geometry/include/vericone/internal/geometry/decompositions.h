// SPDX-License-Identifier: BSD-3-Clause
//
// Eigen's decompositions of small matrices, each compiled once. Every file that instantiates one itself pays
// for it: 2 s for the eigenvalues of a 2 x 2 matrix, where a call of these functions costs nothing.
// Answers are Eigen's bit for bit. No function throws; where no size is said, N is 2 or 3.
#pragma once

#include <Eigen/Core>

namespace vericone {

/// a = vectors diag(values) vectors^T: values increase, vectors are orthonormal columns.
template <int N>
struct SymmetricEigen {
  Eigen::Matrix<double, N, 1> values;
  Eigen::Matrix<double, N, N> vectors;
};

/// Of a symmetric matrix, whose lower triangle is read. N is 2, 3 or 6.
template <int N>
[[nodiscard]] SymmetricEigen<N> symmetric_eigen(const Eigen::Matrix<double, N, N>& a);

/// Its values alone, in the unit of `a`, the same bits, in half the time.
template <int N>
[[nodiscard]] Eigen::Matrix<double, N, 1> symmetric_eigenvalues(const Eigen::Matrix<double, N, N>& a);

/// a = L L^T of a symmetric matrix, whose lower triangle is read. N is 2, 3 or 4.
template <int N>
struct Cholesky {
  Eigen::Matrix<double, N, N> lower;  // zeros above the diagonal
  bool positive = false;              // otherwise `lower` has no meaning

  /// L^{-1} x.
  [[nodiscard]] Eigen::Matrix<double, N, 1> half_solve(const Eigen::Matrix<double, N, 1>& x) const;
  /// a^{-1} x.
  [[nodiscard]] Eigen::Matrix<double, N, 1> solve(const Eigen::Matrix<double, N, 1>& x) const;
  /// L^{-1}.
  [[nodiscard]] Eigen::Matrix<double, N, N> lower_inverse() const;
  /// a^{-1}.
  [[nodiscard]] Eigen::Matrix<double, N, N> inverse() const;
};
template <int N>
[[nodiscard]] Cholesky<N> cholesky(const Eigen::Matrix<double, N, N>& a);

/// a = u diag(values) v^T, v left out: values decrease, u is orthogonal.
template <int N>
struct LeftSingular {
  Eigen::Matrix<double, N, 1> values;  // in the unit of the matrix
  Eigen::Matrix<double, N, N> u;       // orthonormal
};
template <int N>
[[nodiscard]] LeftSingular<N> left_singular(const Eigen::Matrix<double, N, N>& a);
template <int N>
[[nodiscard]] Eigen::Matrix<double, N, 1> singular_values(const Eigen::Matrix<double, N, N>& a);  // unit: a's

/// The orthonormal matrix nearest to `a`: u v^T of its singular vectors.
template <int N>
[[nodiscard]] Eigen::Matrix<double, N, N> nearest_orthogonal(const Eigen::Matrix<double, N, N>& a);

/// x (unit of b / a) of a x = b for a square matrix of up to 16 rows, by elimination with partial pivots; not
/// finite where `a` is singular. `a` is overwritten, b becomes x. No allocation.
void solve_square(Eigen::Ref<Eigen::MatrixXd> a, Eigen::Ref<Eigen::VectorXd> b);

/// x (unit of b / a) of least |a x - b|, any size; of several the shortest, however the rank falls short.
[[nodiscard]] Eigen::VectorXd shortest_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

/// x (unit of b / a) of least |a x - b|, any size: quicker, one of several.
[[nodiscard]] Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

}  // namespace vericone
