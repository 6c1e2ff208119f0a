// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/internal/geometry/rotation.h>
#include <vericone/internal/simulation/shape_in_time.h>
#include <vericone/simulation/track.h>

#include <vericone/geometry/error.h>
#include <vericone/geometry/pose.h>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace vericone::simulation {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// Below this the hyperboloid cuts off less than rounding tells.
constexpr double kPlain = 1e-12;
/// Lengths are rounded up by this.
constexpr double kUp = 1 + 1e-14;

/// x_1^2 / a_1^2 - (the other terms) <= 1 in turned axes.
template <int D>
Eigen::Matrix<double, D, D> dents(const Eigen::Matrix<double, D, 1>& semi_axes,
                                  const Eigen::Matrix<double, D, D>& rotation) {
  Eigen::Matrix<double, D, 1> d = -semi_axes.cwiseAbs2().cwiseInverse();
  d(0) = -d(0);
  const Eigen::Matrix<double, D, D> m = d.asDiagonal();
  return turned<D>(rotation, m);
}

/// (5.5) and its counterpart: the ellipsoid of the largest k, the hyperboloid of the least.
template <int D>
BasicCombined<D> dented(const Eigen::Matrix<double, D, 1>& semi_axes, double least, double most,
                        const Vector3d& position, const Matrix3d& rotation) {
  const Eigen::Matrix<double, D, D> r = orthonormal<D>(rotation_of<D>(rotation));
  least = std::clamp(least, 0.0, 1.0);
  most = std::clamp(most, 0.0, 1.0);
  const auto ellipsoid = BasicEllipsoid<D>::from_axes(position.head<D>(), semi_axes * std::sqrt(1 + most), r);
  if (least + most < 2 * kPlain) return ellipsoid;
  return BasicCombined<D>::trusted(ellipsoid, {{dents<D>(semi_axes, r), 1 - least}});
}

/// Bounds of k over all times.
Oscillation::Range always(const Oscillation& k) {
  if (k.rate == 0) return k.range(0, 0);
  const double size = std::abs(k.amplitude), low = k.offset - size, high = k.offset + size;
  if (!k.absolute) return {low, high};
  return {low > 0 ? low : high < 0 ? -high : 0, std::max(std::abs(low), std::abs(high))};
}

void require_positive(double x, const std::string& field) {
  if (!std::isfinite(x) || !(x > 0)) throw InputError(field, to_text(x), "a positive finite number (metres)");
}

void check_k(const Oscillation& k) {
  for (const auto& [name, x] : {std::pair("offset", k.offset), std::pair("amplitude", k.amplitude),
                                std::pair("rate", k.rate), std::pair("phase", k.phase)})
    if (!std::isfinite(x)) throw InputError(std::string("k.") + name, to_text(x), "a finite number");
  constexpr double kRounding = 1e-12;
  const Oscillation::Range all = always(k);
  if (!(all.low >= -kRounding) || !(all.high <= 1 + kRounding))
    throw InputError("k", "[" + to_text(all.low) + ", " + to_text(all.high) + "]",
                     "between 0 and 1 at every time");
}

void require_about_origin(const Eigen::VectorXd& center) {
  if (!center.isZero(0))
    throw InputError("center", to_text(center.norm()) + " m from the origin",
                     "the origin of the body's own frame");
}

/// Largest distance of a dented body from its centre: where squares of the coordinates are the unknowns, both
/// surfaces are planes and the distance is linear, so it is largest at (a, b sqrt(k)) or b sqrt(1 + k).
double dented_reach(double a, double b, const Oscillation& k) {
  const double most = std::min(always(k).high * kUp, 1.0);
  // A plain ellipsoid is not cut.
  return std::sqrt(std::max(a * a * (1 + 2 * kPlain) + b * b * most, b * b * (1 + most))) * kUp;
}

/// A dented body with the ellipse of one k and the hyperbola of another.
WorldBody dented(const ShapeInTime& shape, double least, double most, const Vector3d& position,
                 const Matrix3d& rotation) {
  const Vector3d& axes = shape.semi_axes();
  if (planar(shape)) return dented<2>(Vector2d(axes.head<2>()), least, most, position, rotation);
  return dented<3>(axes, least, most, position, rotation);
}

}  // namespace

void check(const ShapeInTime& shape) {
  const Vector3d& axes = shape.semi_axes();
  if (const WorldBody* body = shape.rigid()) {
    if (body->flat()) require_about_origin(body->flat()->center());
    if (body->quadric()) require_about_origin(body->quadric()->center());
    return;
  }
  if (planar(shape)) {
    require_positive(axes.x(), "a_c");
    require_positive(axes.y(), "b_c");
  } else {
    for (int i = 0; i < 3; ++i) require_positive(axes(i), "semi_axes[" + std::to_string(i) + "]");
  }
  check_k(*shape.k());
}

bool planar(const ShapeInTime& shape) { return shape.rigid_ ? shape.rigid_->planar() : shape.flat_; }

WorldBody shape_at(const ShapeInTime& shape, double t, const Vector3d& position, const Matrix3d& rotation) {
  if (shape.rigid()) return shape.rigid()->posed(position, rotation);
  const double k = shape.k()->at(t);
  return dented(shape, k, k, position, rotation);
}

BodyRate shape_rate_at(const ShapeInTime& shape, double t, const Matrix3d& rotation) {
  BodyRate rate;
  if (shape.rigid()) return rate;
  const Matrix3d squares = shape.semi_axes().cwiseAbs2().asDiagonal();
  if (planar(shape)) {
    const Matrix2d flat = squares.topLeftCorner<2, 2>();
    rate.shape.topLeftCorner<2, 2>() = turned<2>(rotation_of<2>(rotation), flat);
  } else {
    rate.shape = turned<3>(rotation, squares);
  }
  // S = (1 + k) R diag(a^2) R^T, level = 1 - k.
  const double slope = shape.k()->rate_at(t);
  rate.shape *= slope;
  if (shape.k()->at(t) >= kPlain) rate.delimiters.push_back({Matrix3d::Zero(), -slope});
  return rate;
}

WorldBody shape_over(const ShapeInTime& shape, double from, double to, const Vector3d& position,
                     const Matrix3d& rotation) {
  if (shape.rigid()) return shape_at(shape, from, position, rotation);
  const Oscillation::Range k = shape.k()->range(from, to);
  return dented(shape, k.low, k.high, position, rotation);
}

double reach(const ShapeInTime& shape) {
  if (shape.rigid()) return shape.rigid()->reach();
  const Vector3d& axes = shape.semi_axes();
  return dented_reach(axes(0), planar(shape) ? axes(1) : axes.tail<2>().maxCoeff(), *shape.k());
}

}  // namespace vericone::simulation
