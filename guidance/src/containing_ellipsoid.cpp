// SPDX-License-Identifier: BSD-3-Clause
#include "containing_ellipsoid.h"

#include <vericone/geometry/decompositions.h>
#include <vericone/geometry/requires.h>
#include <algorithm>

namespace vericone::guidance {
namespace {

template <int D>
BasicEllipsoid<D> containing(const BasicCombined<D>& body) {
  return body.is_ellipsoid() ? body.ellipsoid() : body.bounding_ellipsoid();
}

Ellipsoid containing(const HullBody& hull) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& x : hull.points()) mean += x / double(hull.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& x : hull.points())
    covariance += (x - mean) * (x - mean).transpose() / double(hull.size());
  // Flat hulls, and single points, get a little thickness.
  const double thickness = 1e-6 * covariance.trace() + 1e-24;
  covariance += thickness * Eigen::Matrix3d::Identity();
  const Cholesky<3> factors = cholesky<3>(covariance);
  double most = 0;
  for (const Eigen::Vector3d& x : hull.points())
    most = std::max(most, factors.half_solve(x - mean).squaredNorm());
  const Eigen::Matrix3d shape = covariance * (most * (1 + 1e-12) + 1e-12);
  return Ellipsoid::from_shape(mean, (shape + shape.transpose()) / 2);
}

}  // namespace

Ellipse containing_ellipse(const BodyState& body) {
  VERICONE_REQUIRES(body.planar());
  return containing(std::get<CombinedEllipse>(body.shape));
}

Ellipsoid containing_ellipsoid(const BodyState& body) {
  VERICONE_REQUIRES(!body.planar());
  if (const auto* combined = std::get_if<CombinedEllipsoid>(&body.shape)) return containing(*combined);
  if (const auto* hull = std::get_if<HullBody>(&body.shape)) return containing(*hull);
  return placed(body.shape).containing_ellipsoid();
}

}  // namespace vericone::guidance
