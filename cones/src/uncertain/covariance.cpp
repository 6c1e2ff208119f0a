// SPDX-License-Identifier: BSD-3-Clause
#include "uncertain/covariance.h"

#include <vericone/geometry/error.h>
#include <vericone/internal/geometry/decompositions.h>
#include <string>

namespace vericone::gaussian {
namespace {

template <int N>
using Square = Eigen::Matrix<double, N, N>;

/// What is left of an eigenvalue that is clipped, as a part of the largest: above the rounding of the
/// product, so that the result is positive definite as it stands.
constexpr double kFloor = 0x1p-48;

/// Gauss's elimination, largest pivot first: whether no eigenvalue is negative, rounding included.
template <int N>
bool surely_semidefinite(const Square<N>& m) {
  Square<N> rest = m;
  const double size = m.cwiseAbs().maxCoeff();
  for (int step = 0; step < N; ++step) {
    Eigen::Index k = 0;
    const double pivot = rest.diagonal().maxCoeff(&k);
    if (!(pivot > kFloor * size)) return rest.isZero(0);
    const auto column = rest.col(k).eval();
    rest -= column * column.transpose() / pivot;
    rest.row(k).setZero();
    rest.col(k).setZero();
  }
  return true;
}

/// Symmetrises and clips `m`, and says by how much; or what is wrong with it.
template <int N>
std::string mend(Square<N>& m, double& clipped) {
  if (!m.allFinite()) return "a number that is not finite";
  const double size = m.cwiseAbs().maxCoeff();
  if (size == 0) return "";
  const Square<N> unit = m / size;
  Square<N> half = 0.5 * (unit + unit.transpose());
  Eigen::Index i = 0, j = 0;
  const double asymmetry = (unit - unit.transpose()).cwiseAbs().maxCoeff(&i, &j);
  if (asymmetry > kClipped) return to_text(m(i, j)) + " beside " + to_text(m(j, i)) + " across the diagonal";
  if (asymmetry > 0) m = (0.5 * (m + m.transpose())).eval();
  clipped = std::max(clipped, 0.5 * asymmetry);
  if (surely_semidefinite<N>(half)) return "";
  const SymmetricEigen<N> solved = symmetric_eigen<N>(half);
  const auto& values = solved.values;
  const double largest = values.maxCoeff(), least = values.minCoeff();
  if (!(least >= -kClipped))
    return "the eigenvalue " + to_text(size * least) + " beside " + to_text(size * largest);
  if (least >= 0) return "";
  const auto raised = values.cwiseMax(kFloor * largest).eval();
  const Square<N>& vectors = solved.vectors;
  const Square<N> psd = vectors * raised.asDiagonal() * vectors.transpose();
  half = 0.5 * (psd + psd.transpose());
  clipped = std::max(clipped, (half - unit).cwiseAbs().maxCoeff());
  m = size * half;
  return "";
}

const char* const kRequired =
    "a symmetric matrix without negative eigenvalues, but for 1e-8 of its largest entry";

}  // namespace

Covariance::Covariance(const Eigen::Matrix3d& given, const char* field) : matrix(given) {
  const std::string wrong = mend<3>(matrix, clipped);
  if (!wrong.empty()) throw InputError(field, wrong, kRequired);
}

JointCovariance::JointCovariance(const Eigen::Matrix3d& of_position, const Eigen::Matrix3d& of_velocity,
                                 const Eigen::Matrix3d& between) {
  const Covariance p(of_position, "position_covariance"), v(of_velocity, "velocity_covariance");
  position = p.matrix, velocity = v.matrix, cross = between;
  clipped = std::max(p.clipped, v.clipped);
  if (cross.isZero(0)) return;
  // In units of the deviations; what does not vary has the unit 1, and must not vary with anything.
  Eigen::Matrix<double, 6, 1> unit;
  unit << position.diagonal(), velocity.diagonal();
  unit = unit.cwiseMax(0).cwiseSqrt().eval();
  unit = (unit.array() > 0).select(unit, 1).eval();
  Square<6> all;
  all << position, cross, cross.transpose(), velocity;
  const Square<6> scale = unit * unit.transpose();
  all = all.cwiseQuotient(scale).eval();
  const std::string wrong = mend<6>(all, clipped);
  if (!wrong.empty())
    throw InputError("cross_covariance",
                     "with position and velocity " + wrong + ", in units of the deviations", kRequired);
  all = all.cwiseProduct(scale).eval();
  position = all.topLeftCorner<3, 3>();
  velocity = all.bottomRightCorner<3, 3>();
  cross = all.topRightCorner<3, 3>();
}

}  // namespace vericone::gaussian
