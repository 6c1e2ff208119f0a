// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/internal/cones/ellipsoids/contact_frame.h>

#include <cmath>
#include <limits>

#include <vericone/internal/geometry/lengths.h>

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
        const double t = std::copysign(1.0, zeta) / (std::abs(zeta) + std::sqrt(1 + zeta * zeta));
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

/// Logarithm and exponential for a Newton iteration: relative error below 1e-3 for large arguments, falling
/// like the fifth power of small ones.
double quick_log(double y) {
  const double z = (y - 1) / (y + 1), z2 = z * z;
  return z2 < 0.1 ? 2 * z * (1 + z2 * (1.0 / 3 + z2 / 5)) : std::log(y);
}
double quick_exp(double u) {
  const double even = 1 + u * u / 12;
  return std::abs(u) < 0.7 ? (even + u / 2) / (even - u / 2) : std::exp(u);
}

}  // namespace

template <int D>
double maximise_contact(const Eigen::Matrix<double, D, 1>& center, const Eigen::Matrix<double, D, 1>& sigma) {
  // With x = lambda / (1 - lambda) and n_i = c_i / (1 + x sigma_i^2), f' = 0 reads x = rho_A(n) / rho_B(n),
  // so x lies between 1 / max sigma and 1 / min sigma. phi(log x) = log(rho_A^2 / rho_B^2) - 2 log x falls
  // through its only root (f is concave): Newton in log x, kept inside the bracket.
  double lo = 1 / sigma.maxCoeff(), hi = 1 / sigma.minCoeff();
  double x = std::sqrt(lo) * std::sqrt(hi);
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
    const double phi = quick_log(aa / bb / x / x);
    (phi > 0 ? lo : hi) = x;
    const double step = -phi / (2 * (bb_r / bb - aa_r / aa) - 2);
    const double next = x * quick_exp(step);
    // f is stationary here: an error of 1e-9 in log x changes f by 1e-18, and Newton squares the last step.
    const bool settled = std::abs(step) < 1e-5;
    if (settled || (next >= lo && next <= hi)) {
      x = next;
      if (settled) break;
    } else {
      x = std::sqrt(lo) * std::sqrt(hi);
    }
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
