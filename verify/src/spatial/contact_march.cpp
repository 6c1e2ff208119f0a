// SPDX-License-Identifier: GPL-3.0-or-later
#include <vericone/internal/verify/spatial/contact_march.h>

#include <vericone/internal/geometry/decompositions.h>
#include <Eigen/LU>
#include <cmath>
#include <stdexcept>

namespace vericone::verify {

using Eigen::Vector3d;

ContactMarch::ContactMarch(const Ellipsoid& a, const Ellipsoid& b) {
  to_ball_ = b.factor().inverse();
  line_of_centers_ = a.center() - b.center();
  center_ = to_ball_ * line_of_centers_;
  const LeftSingular<3> svd = left_singular<3>(to_ball_ * a.factor());
  if (!svd.values.allFinite()) throw std::logic_error("ContactMarch: no singular values");
  axes_ = svd.u;
  squares_ = svd.values.cwiseAbs2();
}

BallDistance ContactMarch::distance(const Vector3d& shift) const {
  // The origin seen from A's centre, along A's axes.
  const Vector3d center = center_ + to_ball_ * shift, z = -(axes_.transpose() * center);
  // The nearest point x minimises |x - z|^2 subject to sum x_i^2 / q_i = 1: x_i = q_i z_i / (q_i + tau), with
  // tau >= 0 the root of the falling convex function sum q_i z_i^2 / (q_i + tau)^2 - 1.
  if (z.cwiseAbs2().cwiseQuotient(squares_).sum() <= 1) return {};
  double tau = 0;
  for (int iteration = 0; iteration < 100; ++iteration) {
    const Vector3d shifted = squares_.array() + tau;
    const Vector3d term = squares_.cwiseProduct(z.cwiseAbs2()).cwiseQuotient(shifted.cwiseAbs2());
    const double value = term.sum(), slope = -2 * term.cwiseQuotient(shifted).sum();
    // Newton on value^{-1/2}, nearly linear in tau; it stays below the root as value^{-1/2} is concave.
    const double step = 2 * value * (1 - std::sqrt(value)) / slope;
    tau = std::max(tau + step, 0.0);
    if (!(std::abs(step) > 1e-16 * tau)) break;
  }
  const Vector3d x = squares_.cwiseProduct(z).cwiseQuotient(Vector3d(squares_.array() + tau));
  // z - x = tau z / (q + tau) without the difference.
  const Vector3d apart = tau * z.cwiseQuotient(Vector3d(squares_.array() + tau));
  return {apart.norm(), center + axes_ * x};
}

double ContactMarch::resolution(const Vector3d& shift) const {
  const Vector3d coordinates = line_of_centers_.cwiseAbs() + shift.cwiseAbs();
  return (to_ball_.cwiseAbs() * coordinates).norm() + squares_.cwiseSqrt().maxCoeff();
}

ContactMarch::Result ContactMarch::first_contact(const Vector3d& w) const {
  Result result;
  const Vector3d speed = to_ball_ * w;
  result.closest = distance(Vector3d::Zero()).distance;
  for (double t = 0; result.steps < 10000; ++result.steps) {
    const BallDistance d = distance(t * w);
    result.closest = std::min(result.closest, d.distance);
    // Overlapping at the start, or past the surface by a rounding.
    if (d.distance <= 1) {
      result.time = t;
      return result;
    }
    const double rate = d.nearest.dot(speed) / d.distance;
    if (!(rate < 0)) return result;
    result.closing = -rate / speed.norm();
    const double step = (1 - d.distance) / rate;
    t += step;
    if (step <= 4e-16 * t) {
      result.time = t;
      return result;
    }
  }
  return result;
}

}  // namespace vericone::verify
