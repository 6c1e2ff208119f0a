// SPDX-License-Identifier: BSD-3-Clause
//
// Tangents from a point to an ellipse as the source has them: poles and polars, (5.6) and (5.7).
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

namespace vericone {

/// A line t^T (x, y, 1) = 0 and where it touches.
struct PolarTangent {
  double gamma = 0;      // direction of the line, radians
  Eigen::Vector3d line;  // t(gamma) = (-sin gamma, cos gamma, u sin gamma - v cos gamma)
  Eigen::Vector2d point;
};

/// Both tangents from (u, v) to the conic whose dual matrix is `dual` = C_1 = F_1^{-1}; (5.6) as corrected
/// (errata, 3.5): K_0 with a' and v, and the arctangent of both arguments. Nothing from inside.
std::optional<std::array<PolarTangent, 2>> tangents_by_polar(const Eigen::Matrix3d& dual,
                                                             const Eigen::Vector2d& from);

}  // namespace vericone
