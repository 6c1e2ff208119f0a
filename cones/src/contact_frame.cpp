// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/contact_frame.h>

#include <cmath>
#include <limits>

#include "scaled_inverse.h"

namespace vericone {
namespace {

/// One-sided Jacobi: G V = U diag(sigma). Small singular values keep their relative accuracy, which an
/// eigenvalue problem for G^T G would square away for thin bodies.
template <int D>
void left_singular_vectors(Eigen::Matrix<double, D, D> g, Eigen::Matrix<double, D, D>& u,
                           Eigen::Matrix<double, D, 1>& sigma) {
  constexpr double kTolerance = 2 * std::numeric_limits<double>::epsilon();
  for (int sweep = 0; sweep < 16; ++sweep) {
    bool rotated = false;
    for (int p = 0; p < D - 1; ++p)
      for (int q = p + 1; q < D; ++q) {
        const double pp = g.col(p).squaredNorm(), qq = g.col(q).squaredNorm(), pq = g.col(p).dot(g.col(q));
        if (!(std::abs(pq) > kTolerance * std::sqrt(pp) * std::sqrt(qq))) continue;
        rotated = true;
        const double zeta = (qq - pp) / (2 * pq);
        const double t = std::copysign(1.0, zeta) / (std::abs(zeta) + std::hypot(1.0, zeta));
        const double c = 1 / std::sqrt(1 + t * t), s = c * t;
        const Eigen::Matrix<double, D, 1> gp = g.col(p);
        g.col(p) = c * gp - s * g.col(q);
        g.col(q) = s * gp + c * g.col(q);
      }
    if (!rotated) break;
  }
  for (int i = 0; i < D; ++i) {
    sigma(i) = g.col(i).norm();
    u.col(i) = g.col(i) / sigma(i);
  }
}

}  // namespace

template <int D>
double maximise_contact(const Eigen::Matrix<double, D, 1>& center, const Eigen::Matrix<double, D, 1>& sigma) {
  // With x = lambda / (1 - lambda) and n_i = c_i / (1 + x sigma_i^2), f' = 0 reads x = rho_A(n) / rho_B(n),
  // so log x lies between -log max sigma and -log min sigma. phi(log x) = log(rho_A^2 / rho_B^2) - 2 log x
  // falls through its only root (f is concave): Newton, kept inside the bracket.
  double lo = -std::log(sigma.maxCoeff()), hi = -std::log(sigma.minCoeff());
  double u = 0.5 * (lo + hi);
  double x = std::exp(u);
  for (int iteration = 0; iteration < 80; ++iteration) {
    double aa = 0, bb = 0, aa_r = 0, bb_r = 0;
    for (int i = 0; i < D; ++i) {
      const double s2 = sigma(i) * sigma(i), d = 1 / (1 + x * s2), n = center(i) * d, r = x * s2 * d;
      const double n2 = n * n;
      aa += n2;
      bb += n2 * s2;
      aa_r += n2 * r;
      bb_r += n2 * s2 * r;
    }
    if (!(aa > 0) || !(bb > 0)) break;  // concentric bodies: f = 0 for every lambda
    const double phi = std::log(aa / bb) - 2 * u;
    (phi > 0 ? lo : hi) = u;
    const double slope = 2 * (bb_r / bb - aa_r / aa) - 2;
    double next = u - phi / slope;
    if (!(next >= lo && next <= hi)) next = 0.5 * (lo + hi);
    const double step = next - u;
    u = next;
    x = std::exp(u);
    // f is stationary here: an error of 1e-9 in log x changes f by 1e-18.
    if (std::abs(step) < 1e-9) break;
  }
  return x;
}

template <int D>
ContactFrame<D>::ContactFrame(const Matrix& factor_a, const Matrix& factor_b, const Vector& line)
    : center_line(line) {
  const Matrix inverse = scaled_inverse<D>(factor_a);
  Matrix u;
  left_singular_vectors<D>(inverse * factor_b, u, sigma);
  to_space = factor_a * u;
  to_frame = u.transpose() * inverse;
  center = to_frame * center_line;
  ratio = maximise_contact<D>(center, sigma);
  contact = contact_value<D>(ratio, center, sigma);
}

template struct ContactFrame<2>;
template struct ContactFrame<3>;
template double maximise_contact<2>(const Eigen::Vector2d&, const Eigen::Vector2d&);
template double maximise_contact<3>(const Eigen::Vector3d&, const Eigen::Vector3d&);

}  // namespace vericone
