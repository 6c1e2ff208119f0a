// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/fitting/fit.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/fitting/fit_surface.h>
#include <vericone/internal/geometry/decompositions.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "dense_eigen.h"
#include "surface/search.h"

namespace vericone::fitting {
namespace {

using Eigen::Matrix2d, Eigen::Matrix3d, Eigen::Vector2d, Eigen::Vector3d;

/// Coordinates in which a footprint is fitted: about the mean, along the principal axes, within the unit
/// disc. In units of the sample's frame: the frame may be turned, the vertical is the world's.
struct PlanarFrame {
  Vector2d origin = Vector2d::Zero();
  Matrix2d axes = Matrix2d::Identity();
  double scale = 1;
};

PlanarFrame to_plane(const CanonicalSample& sample, Cloud& cloud) {
  PlanarFrame frame;
  for (std::size_t i = 0; i < sample.points.size(); ++i) {
    cloud.points[i] = sample.frame.axes * sample.points[i];
    frame.origin += cloud.weights[i] * cloud.points[i].head<2>();
  }
  Matrix2d covariance = Matrix2d::Zero();
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const Vector2d d = cloud.points[i].head<2>() - frame.origin;
    covariance += cloud.weights[i] * d * d.transpose();
  }
  const auto solver = symmetric_eigen<2>(covariance);
  frame.axes = solver.vectors.rowwise().reverse();
  for (int k = 0; k < 2; ++k) {
    double third = 0;
    for (std::size_t i = 0; i < cloud.points.size(); ++i)
      third +=
          cloud.weights[i] * std::pow(frame.axes.col(k).dot(cloud.points[i].head<2>() - frame.origin), 3);
    if (third < 0) frame.axes.col(k) *= -1;
  }
  if (frame.axes.determinant() < 0) frame.axes.col(1) *= -1;
  double reach = 0;
  for (const Vector3d& x : cloud.points) reach = std::max(reach, (x.head<2>() - frame.origin).norm());
  if (reach > 0) frame.scale = reach;
  for (Vector3d& x : cloud.points) {
    x.head<2>() = (frame.axes.transpose() * (x.head<2>() - frame.origin) / frame.scale).eval();
    x.z() = 0;
  }
  return frame;
}

/// Refuses points that no ellipsoid (ellipse) can be told from.
void require_extent(const Cloud& cloud, bool planar) {
  const Eigen::VectorXd squares = spread(cloud, planar);
  const double most = squares(squares.size() - 1);
  const auto flat = (squares.array() < 1e-18 * most).count();
  if (flat == 0 && most > 0) return;
  if (planar) throw InputError("points", "points whose footprint is on one line", "spread over the xy plane");
  throw InputError("points", flat >= 2 ? "points on one line" : "points in one plane", "spread in space");
}

/// How far the body reaches from its centre along each of its ellipsoid's axes: of places all over the
/// ellipsoid, its ends too, which even directions miss where it is long.
Vector3d reach_along_axes(const CombinedEllipsoid& body, const Matrix3d& axes, const Vector3d& semi_axes) {
  Vector3d reach = Vector3d::Zero();
  std::vector<Vector3d> places = directions(400, false);
  for (int k = 0; k < 3; ++k)
    for (const double side : {1.0, -1.0}) places.emplace_back(side * Vector3d::Unit(k));
  for (const Vector3d& u : places) {
    const Vector3d along = semi_axes.cwiseProduct(u);
    reach = reach.cwiseMax(along.cwiseAbs() / std::max(1.0, body.gauge(axes * along)));
  }
  return reach;
}

/// Of points that no closed surface explains better than a plane (a line): how thick they are beside what the
/// best surface leaves over.
InputError flat_points(const FittedSurface& fit, const Cloud& cloud) {
  const bool planar = fit.model.planar;
  const std::string surface = planar ? "ellipse" : "ellipsoid", flat = planar ? "line" : "plane";
  const double times = std::sqrt(std::max(0.0, spread(cloud, planar)(0))) / fit.noise;
  char ratio[32] = "less than 0.1";
  if (times >= 0.1) std::snprintf(ratio, sizeof ratio, "%.2g", times);
  return {"points", "points hardly nearer to any " + surface + " than to a " + flat,
          std::string("on several sides of ") + (planar ? "a footprint" : "a body") +
              " like it: their thickness is " + ratio + " times what the best " + surface +
              " misses them by, too little to tell two sides"};
}

/// Refuses what is no closed surface near the points but the limit of some.
void require_closed(const FittedSurface& fit, const Cloud& cloud) {
  constexpr double kLong = 10;
  const bool planar = fit.model.planar;
  const int d = planar ? 2 : 3;
  const Vector3d a = Surfaces(fit.model, fit.solution.parameters).semi_axes();
  const std::string wanted = planar ? "near an ellipse" : "near an ellipsoid";
  if (is_flat(fit, cloud)) throw flat_points(fit, cloud);
  if (!is_open(fit)) return;
  const auto open = (a.head(d).array() > kLong).count();
  const std::string found = planar      ? (open == 1 ? "a parabola or two parallel lines" : "a straight line")
                            : open == 1 ? "a paraboloid or a cylinder"
                                        : "a plane or a parabolic cylinder";
  throw InputError("points", "points near " + found, wanted);
}

std::optional<Overreach> overreach(const FittedSurface& fit, const Cloud& cloud, const SurfaceFit& told,
                                   double unit) {
  constexpr double kFar = 1.5, kFarUndetermined = 1.25, kUndetermined = 0.05;
  const bool planar = fit.model.planar;
  const int first = planar ? 1 : 0, d = 3 - first;
  const Surfaces surfaces(fit.model, fit.solution.parameters);
  const Surfaces::Surface& ellipsoid = surfaces.all()[0];
  Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Vector3d& x : cloud.points) {
    if (fit.cutoff > 0 && std::abs(surfaces.distance(x, nullptr)) > 3 * fit.noise + 1e-9) continue;
    const Vector3d along = ellipsoid.axes.transpose() * (x - surfaces.center());
    low = low.cwiseMin(along);
    high = high.cwiseMax(along);
  }
  const Vector3d a = surfaces.semi_axes();
  Vector3d reach = Vector3d::Zero();
  if (planar)
    reach.head<2>() = a.head<2>();
  else
    reach = reach_along_axes(surfaces.body(), ellipsoid.axes, a);
  for (int k = 0; k < d; ++k) {
    const double width = high(first + k) - low(first + k);
    const bool undetermined = told.axes_error(k) > kUndetermined * a(k);
    if (!(reach(k) > (undetermined ? kFarUndetermined : kFar) * width)) continue;
    return Overreach{unit * reach(k), unit * width};
  }
  return std::nullopt;
}

void require_cut(const FittedSurface& fit) {
  const CombinedEllipsoid body = Surfaces(fit.model, fit.solution.parameters).body();
  try {
    const CombinedEllipsoid checked(body.ellipsoid(), body.delimiters());
  } catch (const InputError&) {
    throw InputError("points", "points near an ellipsoid without dents and waists",
                     "near the shape asked for");
  }
}

FittedSurface fit_shape(const Cloud& cloud, Shape shape, const SurfaceFitOptions& options) {
  const bool plain = shape == Shape::ellipse || shape == Shape::ellipsoid;
  FittedSurface fit =
      plain ? fit_ellipsoid(cloud, shape == Shape::ellipse, options) : base_ellipsoid(cloud, options);
  if (shape == Shape::star)
    fit = fit_star(fit, cloud, options);
  else if (!plain)
    fit = add_delimiter(fit, cloud, shape == Shape::biconcave ? 2 : 1, options);
  require_closed(fit, cloud);
  if (!plain) require_cut(fit);
  return fit;
}

/// A footprint and what is told of it, in the world.
void to_world(const Surfaces& surfaces, const PlanarFrame& plane, const CanonicalSample& sample,
              SurfaceFit& result) {
  const Ellipse e = surfaces.footprint();
  const double to_frame = plane.scale, to_metres = sample.frame.scale;
  const Vector2d center =
      sample.frame.origin.head<2>() + to_metres * (plane.origin + to_frame * (plane.axes * e.center()));
  result.piece.footprint = Ellipse::from_axes(center, to_metres * to_frame * e.semi_axes(), [&] {
    Matrix2d axes = plane.axes * e.axis_directions();
    if (axes.determinant() < 0) axes.col(1) *= -1;
    return axes;
  }());
  result.piece.low = std::numeric_limits<double>::infinity();
  result.piece.high = -result.piece.low;
  for (const Vector3d& y : sample.points) {
    const double z = sample.frame.to_world(y).z();
    result.piece.low = std::min(result.piece.low, z);
    result.piece.high = std::max(result.piece.high, z);
  }
  const double unit = to_metres * to_frame;
  Matrix3d axes = Matrix3d::Identity();
  axes.topLeftCorner<2, 2>() = plane.axes;
  result.noise *= unit;
  result.axes_error *= unit;
  result.center_covariance = unit * unit * (axes * result.center_covariance * axes.transpose()).eval();
  result.center_error = result.center_covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
}

}  // namespace

SurfaceFit fit_surface(const CanonicalSample& sample, Shape shape, const SurfaceFitOptions& options) {
  const bool planar = shape == Shape::ellipse;
  const int needed = parameters(shape);
  if (sample.points.size() < static_cast<std::size_t>(needed))
    throw InputError(
        "points", std::to_string(sample.points.size()) + " different points",
        "at least " + std::to_string(needed) + ", the parameters of a surface of shape " + to_string(shape));
  if (sample.weights.size() != sample.points.size())
    throw InputError("weights", std::to_string(sample.weights.size()) + " numbers",
                     "one a point, " + std::to_string(sample.points.size()));
  Cloud cloud{sample.points, sample.weights};
  PlanarFrame plane;
  if (planar) plane = to_plane(sample, cloud);
  require_extent(cloud, planar);

  const FittedSurface fit = fit_shape(cloud, shape, options);
  const Surfaces surfaces(fit.model, fit.solution.parameters);
  SurfaceFit result;
  Matrix3d axes = sample.frame.axes;
  double unit = sample.frame.scale;
  if (planar) {
    axes.setIdentity();
    axes.topLeftCorner<2, 2>() = plane.axes;
    unit *= plane.scale;
  }
  report(fit, cloud, axes, unit, result);
  if (result.converged) result.overreach = overreach(fit, cloud, result, unit);
  if (planar)
    to_world(surfaces, plane, sample, result);
  else
    result.piece.body = surfaces.body();
  return result;
}

}  // namespace vericone::fitting
