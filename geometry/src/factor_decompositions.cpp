// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/internal/geometry/decompositions.h>

#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <utility>

namespace vericone {

// Factor and triangular solutions as Eigen's LLT and triangularView compute them, operation for operation: as
// templates of any size these took a third of the time of this file.

template <int N>
Cholesky<N> cholesky(const Eigen::Matrix<double, N, N>& a) {
  Cholesky<N> result{Eigen::Matrix<double, N, N>::Zero(), false};
  auto& l = result.lower;
  for (int k = 0; k < N; ++k) {
    double square = 0;
    for (int j = 0; j < k; ++j) square += l(k, j) * l(k, j);
    const double rest = a(k, k) - square;
    if (rest <= 0) return result;
    l(k, k) = std::sqrt(rest);
    for (int i = k + 1; i < N; ++i) {
      double sum = 0;
      for (int j = 0; j < k; ++j) sum += l(i, j) * l(k, j);
      l(i, k) = (a(i, k) - sum) / l(k, k);
    }
  }
  result.positive = true;
  return result;
}

template <int N>
Eigen::Matrix<double, N, 1> Cholesky<N>::half_solve(const Eigen::Matrix<double, N, 1>& x) const {
  Eigen::Matrix<double, N, 1> y;
  for (int i = 0; i < N; ++i) {
    double sum = 0;
    for (int j = 0; j < i; ++j) sum += lower(i, j) * y(j);
    y(i) = (x(i) - sum) / lower(i, i);
  }
  return y;
}

template <int N>
Eigen::Matrix<double, N, 1> Cholesky<N>::solve(const Eigen::Matrix<double, N, 1>& x) const {
  Eigen::Matrix<double, N, 1> y = half_solve(x);
  for (int i = N - 1; i >= 0; --i) {
    double sum = 0;
    for (int j = i + 1; j < N; ++j) sum += lower(j, i) * y(j);
    y(i) = (y(i) - sum) / lower(i, i);
  }
  return y;
}

template <int N>
Eigen::Matrix<double, N, N> Cholesky<N>::lower_inverse() const {
  Eigen::Matrix<double, N, N> r = Eigen::Matrix<double, N, N>::Identity();
  for (int i = 0; i < N; ++i) {
    const double reciprocal = 1 / lower(i, i);
    for (int c = 0; c < N; ++c) {
      const double entry = r(i, c) *= reciprocal;
      for (int j = i + 1; j < N; ++j) r(j, c) -= entry * lower(j, i);
    }
  }
  return r;
}

template <int N>
Eigen::Matrix<double, N, N> Cholesky<N>::inverse() const {
  Eigen::Matrix<double, N, N> r = lower_inverse();
  for (int i = N - 1; i >= 0; --i) {
    const double reciprocal = 1 / lower(i, i);
    for (int c = 0; c < N; ++c) {
      double sum = 0;
      for (int j = i + 1; j < N; ++j) sum += lower(j, i) * r(j, c);
      r(i, c) = (r(i, c) - sum) * reciprocal;
    }
  }
  return r;
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

// The least squares' decompositions are Eigen's; what follows is its solve() for one right-hand side, and its
// PartialPivLU up to its size of blocks. Its own take many right-hand sides, in blocks, at seconds to
// compile.
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// x - tau v (v.x) with v = (1, essential), for x from entry `first` on.
template <typename Essential>
void reflect(const Essential& essential, double tau, Index first, VectorXd& x) {
  const Index n = essential.size();
  if (n == 0) {
    x(first) *= 1 - tau;
  } else if (tau != 0) {
    const double along = essential.dot(x.segment(first + 1, n)) + x(first);
    x(first) -= tau * along;
    x.segment(first + 1, n) -= tau * essential * along;
  }
}

constexpr Index kPanel = 8;  // Eigen's: what a panel takes from the entries beyond it is summed first

/// What columns from `start` to `end` take from the entries `first` to `last`.
void subtract_panel(const Eigen::Ref<const MatrixXd>& a, Index start, Index end, Index first, Index last,
                    Eigen::Ref<VectorXd> z) {
  for (Index i = first; i < last; ++i) {
    double sum = 0;
    for (Index k = start; k < end; ++k) sum += a(i, k) * z(k);
    z(i) -= sum;
  }
}

/// The first n entries, with the upper triangle.
void solve_upper(const Eigen::Ref<const MatrixXd>& a, Index n, Eigen::Ref<VectorXd> z) {
  for (Index end = n; end > 0; end -= kPanel) {
    const Index start = std::max<Index>(0, end - kPanel);
    for (Index k = end - 1; k >= start; --k) {
      z(k) /= a(k, k);
      for (Index i = start; i < k; ++i) z(i) -= z(k) * a(i, k);
    }
    subtract_panel(a, start, end, 0, start, z);
  }
}

/// The same with the lower triangle, its diagonal of ones not stored.
void solve_unit_lower(const Eigen::Ref<const MatrixXd>& a, Index n, Eigen::Ref<VectorXd> z) {
  for (Index start = 0; start < n; start += kPanel) {
    const Index end = std::min(n, start + kPanel);
    for (Index k = start; k < end; ++k)
      for (Index i = k + 1; i < end; ++i) z(i) -= z(k) * a(i, k);
    subtract_panel(a, start, end, end, n, z);
  }
}

/// The first `rank` entries z of R z = Q^T b, of a packed decomposition.
VectorXd triangular_part(const MatrixXd& qr, const VectorXd& taus, Index rank, const VectorXd& b) {
  VectorXd z = b;
  for (Index k = 0; k < rank; ++k) reflect(qr.col(k).tail(qr.rows() - k - 1), taus(k), k, z);
  solve_upper(qr, rank, z);
  return z;
}

}  // namespace

void solve_square(Eigen::Ref<MatrixXd> a, Eigen::Ref<VectorXd> b) {
  const Index n = a.rows();
  for (Index k = 0; k < n; ++k) {
    Index pivot = k;
    for (Index i = k + 1; i < n; ++i)
      if (std::abs(a(i, k)) > std::abs(a(pivot, k))) pivot = i;
    if (a(pivot, k) != 0) {
      for (Index j = 0; j < n && pivot != k; ++j) std::swap(a(k, j), a(pivot, j));
      std::swap(b(k), b(pivot));
      for (Index i = k + 1; i < n; ++i) a(i, k) /= a(k, k);
    }
    for (Index j = k + 1; j < n; ++j)
      for (Index i = k + 1; i < n; ++i) a(i, j) -= a(i, k) * a(k, j);
  }
  solve_unit_lower(a, n, b);
  solve_upper(a, n, b);
}

VectorXd shortest_least_squares(const MatrixXd& a, const VectorXd& b) {
  if (a.size() == 0) return VectorXd::Zero(a.cols());
  const Eigen::CompleteOrthogonalDecomposition<MatrixXd> decomposition(a);
  const Index rank = decomposition.rank(), rest = a.cols() - rank;
  VectorXd x = VectorXd::Zero(a.cols());
  if (rank == 0) return x;
  const MatrixXd& packed = decomposition.matrixQTZ();
  x.head(rank) = triangular_part(packed, decomposition.hCoeffs(), rank, b).head(rank);
  for (Index k = 0; k < rank && rest > 0; ++k) {
    std::swap(x(k), x(rank - 1));
    reflect(packed.row(k).tail(rest).transpose(), decomposition.zCoeffs()(k), rank - 1, x);
    std::swap(x(k), x(rank - 1));
  }
  VectorXd result(a.cols());
  for (Index k = 0; k < a.cols(); ++k) result(decomposition.colsPermutation().indices()(k)) = x(k);
  return result;
}

VectorXd least_squares(const MatrixXd& a, const VectorXd& b) {
  if (a.size() == 0) return VectorXd::Zero(a.cols());
  const Eigen::ColPivHouseholderQR<MatrixXd> decomposition(a);
  const Index rank = decomposition.nonzeroPivots();
  const VectorXd z = triangular_part(decomposition.matrixQR(), decomposition.hCoeffs(), rank, b);
  VectorXd result = VectorXd::Zero(a.cols());
  for (Index k = 0; k < rank; ++k) result(decomposition.colsPermutation().indices()(k)) = z(k);
  return result;
}

template struct Cholesky<2>;
template struct Cholesky<3>;
template struct Cholesky<4>;
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
