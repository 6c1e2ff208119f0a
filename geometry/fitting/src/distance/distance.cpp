// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/fitting/fit.h>
#include <vericone/internal/fitting/signed_distance.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "distance/body_distance.h"

namespace vericone::fitting {

using Eigen::Vector2d, Eigen::Vector3d;

double signed_distance(const CombinedEllipsoid& body, const Vector3d& point) {
  return BodyDistance(body, BodyDistance::Rims::when_needed)(point);
}

double signed_distance(const Ellipse& body, const Vector2d& point) {
  // With any third axis at all: no foot in the plane depends on it.
  const Vector2d semi_axes = body.semi_axes();
  const double unit = std::ldexp(1.0, std::ilogb(semi_axes(0)));
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  axes.topLeftCorner<2, 2>() = body.axis_directions();
  const CenteredQuadric surface =
      CenteredQuadric::ellipsoid(axes, Vector3d(semi_axes(0), semi_axes(1), semi_axes(0)) / unit);
  const Vector2d d = (point - body.center()) / unit;
  const Vector3d x(d.x(), d.y(), 0);
  const double distance = surface.nearest(x).distance * unit;
  return surface.value(x) > 0 ? distance : -distance;
}

double signed_distance(const std::vector<Piece>& pieces, const Vector3d& point) {
  double least = std::numeric_limits<double>::infinity();
  for (const Piece& p : pieces)
    least = std::min(
        least, p.footprint ? signed_distance(*p.footprint, point.head<2>()) : signed_distance(p.body, point));
  return least;
}

}  // namespace vericone::fitting
