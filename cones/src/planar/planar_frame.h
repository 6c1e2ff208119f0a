// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/internal/cones/ellipsoids/contact_frame.h>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace vericone {

/// Affine coordinates in which two disjoint ellipses are an ordinary pair: the centres at (0, 0) and (1, 0),
/// the Minkowski sum inside a unit-sized ellipse. Inner tangents are mapped to inner tangents.
struct PlanarFrame {
  Eigen::Matrix2d to_space;         // columns: images of the frame's axes
  Eigen::Matrix2d normal_to_space;  // inverse transpose: maps normals
  Eigen::Matrix2d shape_a, shape_b;

  explicit PlanarFrame(const ContactFrame<2>& contact) {
    // First K into the unit disc about the image of c, then c onto (L, 0), then x by 1/L: for distant bodies
    // the line of centres shrinks to the size of the bodies.
    const Eigen::Vector2d s = contact.bounding_shape().cwiseSqrt();
    const Eigen::Vector2d c = contact.center.cwiseQuotient(s);
    const double length = c.norm(), cx = c.x() / length, cy = c.y() / length;
    Eigen::Matrix2d rotation;  // columns: frame axes in whitened coordinates
    rotation << cx, -cy, cy, cx;
    const Eigen::Vector2d stretch(length, 1);
    to_space = contact.to_space * s.asDiagonal() * rotation * stretch.asDiagonal();
    normal_to_space = contact.to_frame.transpose() * s.cwiseInverse().asDiagonal() * rotation *
                      stretch.cwiseInverse().asDiagonal();
    const auto map_shape = [&](const Eigen::Vector2d& diagonal) -> Eigen::Matrix2d {
      const Eigen::Matrix2d f =
          stretch.cwiseInverse().asDiagonal() * rotation.transpose() * diagonal.cwiseQuotient(s).asDiagonal();
      return f * f.transpose();
    };
    shape_a = map_shape(Eigen::Vector2d::Ones());
    shape_b = map_shape(contact.sigma);
  }
};

/// The slope t of the normal (1, t) of the inner tangent on the given side (+1 or -1), in the frame: the root
/// of 1 - rho_A - rho_B, by Newton. The function is concave with its maximum at t = 0 and still positive at
/// the start, so the first step overshoots at most to the outside and the rest come down monotonically.
inline double support_tangent_slope(const PlanarFrame& frame, const ContactFrame<2>& contact, double side) {
  // Of distant bodies the root is about 1, and Newton from 1e16 times as far would lose all its digits.
  constexpr double kFarthest = 0x1p20;
  double t = side * std::min(std::sqrt(std::max(contact.contact - 1, 0.0)), kFarthest);
  for (int iteration = 0; iteration < 60; ++iteration) {
    const auto rho = [&](const Eigen::Matrix2d& s, double& slope) {
      const double r = std::sqrt(s(0, 0) + 2 * t * s(0, 1) + t * t * s(1, 1));
      slope = (s(0, 1) + t * s(1, 1)) / r;
      return r;
    };
    double slope_a = 0, slope_b = 0;
    const double value = 1 - rho(frame.shape_a, slope_a) - rho(frame.shape_b, slope_b);
    const double step = value / (slope_a + slope_b);
    if (!std::isfinite(step)) break;
    t += step;
    if (std::abs(step) <= 4e-16 * std::abs(t)) break;
  }
  return t;
}

}  // namespace vericone
