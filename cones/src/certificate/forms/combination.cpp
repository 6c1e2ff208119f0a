// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/forms/combination.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <limits>

namespace vericone::certificates {

/// All pivots of the elimination above zero.
bool is_positive(Form<Rational> m, int size) {
  for (int k = 0; k < size; ++k) {
    if (m[k][k].sign() <= 0) return false;
    for (int r = k + 1; r < size; ++r) {
      if (m[r][k].is_zero()) continue;
      const Rational by = m[r][k] / m[k][k];
      for (int c = k + 1; c < size; ++c) m[r][c] -= by * m[k][c];
    }
  }
  return true;
}

/// Multipliers >= 0 of matrices, of sum 1, so that the sum is positive definite; empty where none are found.
/// By Newton's method along the central path of: the least s for which the sum and s times the identity is.
std::vector<double> positive_combination(const std::vector<Matrix5>& forms, int size) {
  const int m = static_cast<int>(forms.size());
  Eigen::VectorXd x = Eigen::VectorXd::Constant(m, 1.0 / m);
  const auto sum = [&](const Eigen::VectorXd& of) {
    Eigen::MatrixXd p = Eigen::MatrixXd::Zero(size, size);
    for (int i = 0; i < m; ++i) p += of(i) * forms[i].topLeftCorner(size, size);
    return p;
  };
  const auto least = [&](const Eigen::MatrixXd& p) {
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(p, Eigen::EigenvaluesOnly).eigenvalues()(0);
  };
  double s = 0.1 - std::min(0.0, least(sum(x)));
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(size, size);
  // Unknowns: all but the last multiplier, and s.
  const auto value = [&](const Eigen::VectorXd& at, double shift, double weight) {
    if (at.minCoeff() <= 0) return std::numeric_limits<double>::infinity();
    const Eigen::LLT<Eigen::MatrixXd> root(sum(at) + shift * identity);
    if (root.info() != Eigen::Success) return std::numeric_limits<double>::infinity();
    return weight * shift - 2 * root.matrixLLT().diagonal().array().log().sum() - at.array().log().sum();
  };
  for (double weight = 10; weight < 1e9; weight *= 4) {
    for (int step = 0; step < 12; ++step) {
      const Eigen::MatrixXd inverse = (sum(x) + s * identity).inverse();
      std::vector<Eigen::MatrixXd> slopes;
      for (int i = 0; i + 1 < m; ++i)
        slopes.push_back(inverse * (forms[i] - forms[m - 1]).topLeftCorner(size, size));
      slopes.push_back(inverse);
      Eigen::VectorXd gradient(m);
      Eigen::MatrixXd curvature(m, m);
      for (int i = 0; i < m; ++i) {
        gradient(i) = -slopes[i].trace();
        for (int j = 0; j <= i; ++j) curvature(i, j) = curvature(j, i) = (slopes[i] * slopes[j]).trace();
      }
      for (int i = 0; i + 1 < m; ++i) {
        gradient(i) += 1 / x(m - 1) - 1 / x(i);
        curvature(i, i) += 1 / (x(i) * x(i));
        for (int j = 0; j + 1 < m; ++j) curvature(i, j) += 1 / (x(m - 1) * x(m - 1));
      }
      gradient(m - 1) += weight;
      const Eigen::VectorXd move = -curvature.ldlt().solve(gradient);
      if (!move.allFinite()) break;
      Eigen::VectorXd way = Eigen::VectorXd::Zero(m);
      way.head(m - 1) = move.head(m - 1);
      way(m - 1) = -move.head(m - 1).sum();
      const double before = value(x, s, weight), slope = gradient.dot(move);
      double length = 1;
      while (length > 1e-6 &&
             !(value(x + length * way, s + length * move(m - 1), weight) <= before + 0.1 * length * slope))
        length /= 2;
      if (!(length > 1e-6)) break;
      x += length * way;
      s += length * move(m - 1);
      if (-slope < 1e-3) break;
    }
    // Deep enough inside to be cut to few digits.
    const double depth = least(sum(x));
    if (depth > 0 && depth > 0.3 / weight * size) return {x.data(), x.data() + m};
    if (s > 0 && weight * s > 50 * (m + size)) return {};
  }
  if (least(sum(x)) > 0) return {x.data(), x.data() + m};
  return {};
}

}  // namespace vericone::certificates
