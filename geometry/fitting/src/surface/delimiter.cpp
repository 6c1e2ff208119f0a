// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/internal/fitting/convex_hull.h>
#include <vericone/internal/geometry/decompositions.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "surface/robust_scale.h"
#include "surface/start.h"

namespace vericone::fitting {

using Eigen::Matrix3d, Eigen::Vector3d;

namespace {

/// Axes with `first` the first and the two others along the principal axes of the section across it.
Matrix3d axes_about(const Vector3d& first, const Matrix3d& matrix) {
  Eigen::Index least = 0;
  first.cwiseAbs().minCoeff(&least);
  Eigen::Matrix<double, 3, 2> across;
  across.col(0) = first.cross(Vector3d::Unit(least)).normalized();
  across.col(1) = first.cross(across.col(0));
  const auto solver = symmetric_eigen<2>(across.transpose() * matrix * across);
  across = (across * solver.vectors).eval();
  Matrix3d axes;
  axes << first, across;
  if (axes.determinant() < 0) axes.col(2) *= -1;
  return axes;
}

double radius(const Matrix3d& matrix, const Vector3d& direction) {
  return 1 / std::sqrt(direction.dot(matrix * direction));
}

/// How far most of the points reach from the centre on both sides of each axis.
Vector3d extents(const Cloud& cloud, const Vector3d& center, const Matrix3d& axes) {
  constexpr double kMost = 0.97;
  Vector3d result;
  for (int k = 0; k < 3; ++k) {
    std::vector<Residual> reach(cloud.points.size());
    for (std::size_t i = 0; i < reach.size(); ++i)
      reach[i] = {std::abs(axes.col(k).dot(cloud.points[i] - center)), cloud.weights[i]};
    result(k) = std::max(weighted_quantile(reach, kMost), 1e-3);
  }
  return result;
}

std::vector<Vector3d> directions(const Matrix3d& ellipsoid_axes, const Cloud& near, int sheets,
                                 const Vector3d& deepest) {
  constexpr double kApart = 0.95;  // cosine
  std::vector<Vector3d> all;
  const auto add = [&](const Vector3d& d) {
    if (std::all_of(all.begin(), all.end(), [&](const Vector3d& e) { return std::abs(e.dot(d)) < kApart; }))
      all.push_back(d);
  };
  if (sheets == 2 && deepest.norm() > 0) add(deepest);
  for (int i = 0; i < 3; ++i) {
    // A waist is across the direction of what is deepest.
    const Vector3d d = ellipsoid_axes.col(i), across = d - d.dot(deepest) * deepest;
    if (sheets == 1 && across.norm() > 0.5) add(across.normalized());
    add(d);
  }
  Vector3d mean = Vector3d::Zero();
  for (const Vector3d& x : near.points) mean += x / double(near.points.size());
  Matrix3d covariance = Matrix3d::Zero();
  for (const Vector3d& x : near.points) covariance += (x - mean) * (x - mean).transpose();
  const auto solver = symmetric_eigen<3>(covariance);
  for (int i = 0; i < 3; ++i) add(solver.vectors.col(i));
  return all;
}

}  // namespace

std::vector<SurfaceStart> delimited_starts(const SurfaceModel& model, const Parameters& parameters,
                                           int sheets, const Cloud& near, const Vector3d& deepest) {
  const Surfaces surfaces(model, parameters);
  const Matrix3d& ellipsoid = surfaces.all()[0].matrix;
  std::vector<SurfaceStart> starts;
  for (const Vector3d& d : directions(surfaces.all()[0].axes, near, sheets, deepest)) {
    const Matrix3d axes = axes_about(d, ellipsoid);
    SurfaceStart base{model, parameters};
    Vector3d radii;
    if (model.delimiters.empty()) {
      // The nearest ellipsoid lies between the rims and the ground of the dents, and a waist may stretch it
      // to a cylinder: what the points reach tells more. Dents hide its ends, a waist its girdle.
      radii = extents(near, surfaces.center(), axes);
      radii = radii.cwiseProduct(sheets == 2 ? Vector3d(1.3, 1.05, 1.05) : Vector3d(1.05, 1.3, 1.3));
      base.parameters = ellipsoid_parameters(
          false, surfaces.center(), axes * radii.cwiseAbs2().cwiseInverse().asDiagonal() * axes.transpose());
    } else {
      for (int i = 0; i < 3; ++i) radii(i) = radius(ellipsoid, axes.col(i));
    }
    for (const double depth : {0.45, 0.75}) {
      SurfaceStart s = base;
      const Vector3d factors = sheets == 2 ? Vector3d(depth, 0.8, 0.8) : Vector3d(0.8, depth, depth);
      append_delimiter(s.model, s.parameters, sheets, radii.cwiseProduct(factors), axes);
      starts.push_back(s);
    }
  }
  return starts;
}

Vector3d deepest_direction(const Cloud& cloud, const Vector3d& center) {
  ConvexHull hull;
  try {
    hull = convex_hull(cloud.points);
  } catch (const InputError&) {
    return Vector3d::Zero();
  }
  double most = 0;
  Vector3d direction = Vector3d::Zero();
  for (const Vector3d& x : cloud.points) {
    double depth = std::numeric_limits<double>::infinity();
    for (const auto& t : hull.triangles) {
      const Vector3d& a = cloud.points[t[0]];
      const Vector3d n = (cloud.points[t[1]] - a).cross(cloud.points[t[2]] - a);
      if (n.norm() > 0) depth = std::min(depth, n.normalized().dot(a - x));
      if (depth <= most) break;
    }
    if (depth > most && std::isfinite(depth) && (x - center).norm() > 1e-6) {
      most = depth;
      direction = (x - center).normalized();
    }
  }
  return direction;
}

}  // namespace vericone::fitting
