// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/quadric.h>
#include <vericone/internal/geometry/requires.h>

#include <vericone/geometry/error.h>
#include <vericone/geometry/exact/rational.h>

namespace vericone {
namespace {

using exact::Rational;

struct Inertia {
  int positive = 0, negative = 0, zero = 0;
};

/// Numbers of positive, negative and zero eigenvalues by symmetric elimination (Sylvester's law of inertia).
template <int N>
Inertia inertia(exact::RationalMatrix<N> m) {
  Inertia result;
  std::array<bool, N> done{};
  for (int step = 0; step < N; ++step) {
    int pivot = -1;
    for (int i = 0; i < N && pivot < 0; ++i)
      if (!done[i] && m[i][i] != 0) pivot = i;
    if (pivot < 0) {
      // All remaining diagonal entries vanish: adding row and column j to i makes entry ii equal 2 m_ij.
      for (int i = 0; i < N && pivot < 0; ++i)
        for (int j = 0; j < N && pivot < 0; ++j)
          if (!done[i] && !done[j] && i != j && m[i][j] != 0) {
            for (int k = 0; k < N; ++k) m[i][k] += m[j][k];
            for (int k = 0; k < N; ++k) m[k][i] += m[k][j];
            pivot = i;
          }
    }
    if (pivot < 0) {
      for (int i = 0; i < N; ++i) result.zero += !done[i];
      return result;
    }
    (m[pivot][pivot].sign() > 0 ? result.positive : result.negative)++;
    done[pivot] = true;
    for (int i = 0; i < N; ++i) {
      if (done[i] || m[i][pivot] == 0) continue;
      const Rational f = m[i][pivot] / m[pivot][pivot];
      for (int j = 0; j < N; ++j)
        if (!done[j]) m[i][j] -= f * m[pivot][j];
    }
  }
  return result;
}

}  // namespace

template <int D>
BasicQuadric<D>::BasicQuadric(const Matrix& matrix) : matrix_(matrix) {
  for (int i = 0; i <= D; ++i)
    for (int j = 0; j <= D; ++j) {
      const std::string entry = "quadric[" + std::to_string(i) + "][" + std::to_string(j) + "]";
      if (!std::isfinite(matrix(i, j))) throw InputError(entry, to_text(matrix(i, j)), "a finite number");
      if (matrix(i, j) != matrix(j, i))
        throw InputError(entry, to_text(matrix(i, j)), "equal to its mirror entry " + to_text(matrix(j, i)));
    }
  if (matrix.isZero(0)) throw InputError("quadric", "0", "not zero");
}

template <int D>
double BasicQuadric<D>::value(const Vector& x) const {
  return x.homogeneous().dot(matrix_ * x.homogeneous());
}

template <int D>
QuadricKind BasicQuadric<D>::kind() const {
  const Inertia whole = inertia<D + 1>(exact::to_rational<D + 1>(matrix_));
  if (whole.zero > 0) return QuadricKind::degenerate;
  const Inertia part =
      inertia<D>(exact::to_rational<D>(Eigen::Matrix<double, D, D>(matrix_.template topLeftCorner<D, D>())));
  if (part.zero > 0) return QuadricKind::paraboloid;
  const bool definite = part.positive == D || part.negative == D;
  if (definite)
    return whole.positive == D + 1 || whole.negative == D + 1 ? QuadricKind::imaginary_ellipsoid
                                                              : QuadricKind::ellipsoid;
  if (D == 2) return QuadricKind::two_sheet_hyperboloid;
  return whole.positive == 2 ? QuadricKind::one_sheet_hyperboloid : QuadricKind::two_sheet_hyperboloid;
}

template class BasicQuadric<2>;
template class BasicQuadric<3>;

Conic section(const Quadric& quadric, const PlaneFrame& plane) {
  VERICONE_REQUIRES(plane.origin.allFinite() && plane.x_axis.allFinite() && plane.y_axis.allFinite(), "plane",
                    "a number that is not finite", "finite");
  Eigen::Matrix<double, 4, 3> p;
  p << plane.x_axis, plane.y_axis, plane.origin, 0, 0, 1;
  const Eigen::Matrix3d m = p.transpose() * quadric.matrix() * p;
  // Rounding may leave the two halves of a symmetric matrix one ulp apart.
  Eigen::Matrix3d symmetric = m;
  symmetric.triangularView<Eigen::StrictlyUpper>() = m.transpose();
  return Conic(symmetric);
}

}  // namespace vericone
