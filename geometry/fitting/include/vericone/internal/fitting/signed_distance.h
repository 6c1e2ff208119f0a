// SPDX-License-Identifier: BSD-3-Clause
//
// Distances from a hull.
#pragma once

#include <vericone/fitting/fit.h>
#include <vector>

namespace vericone::fitting {

/// Distance from a point to the boundary of a body, metres: negative inside. Relative error 1e-10 or so.
/// Inside it is the least of the distances to the surfaces; outside the distance to the nearest point of the
/// body, on a surface or on a rim.
[[nodiscard]] double signed_distance(const CombinedEllipsoid& body, const Eigen::Vector3d& point);

/// The same to an ellipse, in the plane, unit of the body.
[[nodiscard]] double signed_distance(const Ellipse& body, const Eigen::Vector2d& point);

/// To a union, unit of the body: the least over the pieces; inside a lower bound of the depth where pieces
/// overlap. For footprints the horizontal distance.
[[nodiscard]] double signed_distance(const std::vector<Piece>& pieces, const Eigen::Vector3d& point);

}  // namespace vericone::fitting
