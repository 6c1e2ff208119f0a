// SPDX-License-Identifier: BSD-3-Clause
#include "surface/report.h"

#include <vericone/geometry/error.h>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "dense_eigen.h"

namespace vericone::fitting {
namespace {

using Eigen::Matrix3d, Eigen::MatrixXd, Eigen::Vector3d, Eigen::VectorXd;

std::string direction_text(const Vector3d& d) {
  char text[64];
  std::snprintf(text, sizeof text, "(%.2f, %.2f, %.2f)", d.x() + 0.0, d.y() + 0.0, d.z() + 0.0);
  return text;
}

/// The direction of two that are the same up to sign whose largest entry is positive.
Vector3d upright(const Vector3d& d) {
  Eigen::Index largest = 0;
  d.cwiseAbs().maxCoeff(&largest);
  return d(largest) < 0 ? Vector3d(-d) : d;
}

}  // namespace

std::vector<Vector3d> directions(int count, bool planar) {
  const double turn = std::numbers::pi * (3 - std::sqrt(5.0));
  std::vector<Vector3d> all;
  for (int k = 0; k < count; ++k) {
    const double height = planar ? 0 : 1 - (2 * k + 1.0) / count, r = std::sqrt(1 - height * height);
    const double angle = planar ? 2 * std::numbers::pi * k / count : turn * k;
    all.emplace_back(r * std::cos(angle), r * std::sin(angle), height);
  }
  return all;
}

double effective_points(const Cloud& cloud) {
  double squares = 0;
  for (const double w : cloud.weights) squares += w * w;
  return squares > 0 ? 1 / squares : 0;
}

double least_squares_noise(const SurfaceModel& model, const Parameters& parameters, const Cloud& cloud) {
  const VectorXd r = residuals(model, parameters, cloud);
  double sum = 0;
  for (std::size_t i = 0; i < cloud.weights.size(); ++i)
    sum += cloud.weights[i] * r(static_cast<Eigen::Index>(i)) * r(static_cast<Eigen::Index>(i));
  const double n = effective_points(cloud), left = n - model.size();
  return std::sqrt(left > 0.5 ? sum * n / left : sum);
}

// Gross points that lie near the surface by chance count like others, and one on an unseen side pulls the
// surface to itself, so that what is left of its residual tells nothing. As in the jackknife, each residual
// is taken as it would be if the point had not been used: over 1 minus its leverage.
MatrixXd covariance(const FittedSurface& fit, const Cloud& cloud) {
  constexpr double kLeast = 1e-3;  // of 1 - leverage: a point that alone determines a parameter
  const int n = fit.model.size();
  std::vector<int> free;
  for (int i = 0; i < n; ++i)
    if (!fit.solution.fixed[static_cast<std::size_t>(i)]) free.push_back(i);
  const MatrixXd h = fit.solution.curvature(free, free);
  const MatrixXd inverse = h.inverse();
  const Surfaces surfaces(fit.model, fit.solution.parameters);
  MatrixXd b = MatrixXd::Zero(h.rows(), h.cols());
  VectorXd all(n);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (i % 256 == 0) checkpoint();
    const double r = surfaces.distance(cloud.points[i], all.data()), w = cloud.weights[i];
    const VectorXd row = all(free);
    double variance = fit.noise * fit.noise;
    if (fit.cutoff > 0) {
      const double square = r * r / (fit.cutoff * fit.cutoff), u = std::max(0.0, 1 - square);
      const double leverage = w * u * (1 - 5 * square) * row.dot(inverse * row);
      variance = std::pow(r * u * u / std::clamp(1 - leverage, kLeast, 1.0), 2);
    }
    b += w * w * variance * row * row.transpose();
  }
  MatrixXd result = MatrixXd::Zero(n, n);
  result(free, free) = inverse * b * inverse;
  return result;
}

double seen_share(const FittedSurface& fit, const Cloud& cloud) {
  const bool planar = fit.model.planar;
  const Surfaces surfaces(fit.model, fit.solution.parameters);
  const Surfaces::Surface& ellipsoid = surfaces.all()[0];
  const Vector3d axes = ellipsoid.eigenvalues.cwiseMax(1e-12).cwiseSqrt().cwiseInverse();
  const int count = std::clamp(static_cast<int>(cloud.points.size()) / 8, 12, planar ? 100 : 400);
  // Where the ellipsoid is the unit ball: the points as unit vectors, the cells as caps of the radius that a
  // square cell has sides.
  const double width = planar ? 2 * std::numbers::pi / count : std::sqrt(4 * std::numbers::pi / count);
  const double limit = std::cos(width);
  std::vector<Vector3d> points;
  for (const Vector3d& x : cloud.points) {
    if (std::abs(surfaces.distance(x, nullptr)) > 3 * fit.noise + 1e-9) continue;
    Vector3d u = ellipsoid.axes.transpose() * (x - surfaces.center());
    u = u.cwiseQuotient(axes);
    if (planar) u(0) = 0;  // the axis of the cylinder has eigenvalue 0, the first
    if (u.norm() > 0) points.push_back(u.normalized());
  }
  double seen = 0, all = 0;
  for (const Vector3d& g : directions(count, planar)) {
    checkpoint();
    const Vector3d d = planar ? Vector3d(0, g.x(), g.y()) : g;
    // Area of the ellipsoid's surface over that of the ball: |F^-T d| det F; plane: |F tangent|.
    const double area = planar ? std::hypot(axes(1) * d.z(), axes(2) * d.y()) : d.cwiseQuotient(axes).norm();
    all += area;
    if (std::any_of(points.begin(), points.end(), [&](const Vector3d& u) { return u.dot(d) >= limit; }))
      seen += area;
  }
  return seen / all;
}

void report(const FittedSurface& fit, const Cloud& cloud, const Matrix3d& axes, double scale,
            SurfaceFit& result) {
  const Surfaces surfaces(fit.model, fit.solution.parameters);
  const int d = fit.model.center_size();
  result.converged = fit.solution.converged;
  result.iterations = fit.solution.iterations;
  result.noise = fit.noise;
  if (fit.cutoff > 0) {
    const VectorXd r = residuals(fit.model, fit.solution.parameters, cloud);
    result.inliers = 0;
    for (std::size_t i = 0; i < cloud.weights.size(); ++i)
      if (std::abs(r(static_cast<Eigen::Index>(i))) <= 3 * fit.noise + 1e-12)
        result.inliers += cloud.weights[i];
    result.inliers = std::min(result.inliers, 1.0);
  }
  result.seen = seen_share(fit, cloud);
  if (!result.converged) return;

  constexpr double kUnknown = 0.05;
  const MatrixXd c = covariance(fit, cloud);
  const MatrixXd j = surfaces.semi_axes_derivative();
  result.center_covariance.topLeftCorner(d, d) = c.topLeftCorner(d, d);
  result.center_error = result.center_covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  result.axes_error = (j * c * j.transpose()).diagonal().cwiseMax(0.0).cwiseSqrt();
  const Vector3d a = surfaces.semi_axes();
  const auto solver = dense_eigen(result.center_covariance.topLeftCorner(d, d));
  for (int k = d - 1; k >= 0; --k) {
    Vector3d along = Vector3d::Zero();
    along.head(d) = solver.vectors.col(k);
    const double error = std::sqrt(std::max(0.0, solver.values(k)));
    const double extent = 1 / std::sqrt(along.dot(surfaces.all()[0].matrix * along));
    if (!(error > kUnknown * extent)) continue;
    const Vector3d world = upright(axes * along);
    result.unknown.push_back(
        {"center along " + direction_text(world), scale * surfaces.center().dot(along), scale * error});
  }
  for (int k = 0; k < d; ++k)
    if (result.axes_error(k) > kUnknown * a(k))
      result.unknown.push_back(
          {"semi-axis " + std::to_string(k + 1), scale * a(k), scale * result.axes_error(k)});
}

}  // namespace vericone::fitting
