// SPDX-License-Identifier: BSD-3-Clause
#include "to_world.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace vericone::fitting {

Piece to_world(const Piece& piece, const Frame& frame) {
  if (piece.footprint) return piece;
  Piece result = piece;
  const Ellipsoid& body = piece.body.ellipsoid();
  Eigen::Matrix3d axes = frame.axes * body.axis_directions();
  if (axes.determinant() < 0) axes.col(2) = -axes.col(2);
  std::vector<Delimiter<3>> delimiters;
  for (const Delimiter<3>& d : piece.body.delimiters()) {
    const Eigen::Matrix3d form = frame.axes * d.matrix * frame.axes.transpose() / (frame.scale * frame.scale);
    delimiters.push_back({(form + form.transpose()) / 2, d.level});
  }
  result.body = CombinedEllipsoid::trusted(
      Ellipsoid::from_axes(frame.to_world(body.center()), frame.scale * body.semi_axes(), axes),
      std::move(delimiters));
  return result;
}

SurfaceFit to_world(const SurfaceFit& fit, const Frame& frame) {
  if (fit.piece.footprint) return fit;
  SurfaceFit result = fit;
  result.piece = to_world(fit.piece, frame);
  result.noise *= frame.scale;
  result.axes_error *= frame.scale;
  result.center_covariance =
      frame.axes * fit.center_covariance * frame.axes.transpose() * (frame.scale * frame.scale);
  result.center_error = result.center_covariance.diagonal().cwiseMax(0).cwiseSqrt();
  return result;
}

}  // namespace vericone::fitting
