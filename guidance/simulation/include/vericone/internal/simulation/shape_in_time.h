// SPDX-License-Identifier: BSD-3-Clause
//
// Shapes at an instant and over an interval, for tracks and their proofs.
#pragma once

#include <vericone/simulation/track.h>

namespace vericone::simulation {

/// At time t, centre (reference point) at `position`, turned by `rotation`. Of planar shapes the rotation
/// about z counts.
[[nodiscard]] WorldBody shape_at(const ShapeInTime& shape, double t, const Eigen::Vector3d& position,
                                 const Eigen::Matrix3d& rotation);

/// Rates at time t in world axes, beyond turning.
[[nodiscard]] BodyRate shape_rate_at(const ShapeInTime& shape, double t, const Eigen::Matrix3d& rotation);

/// A shape that contains the body at every time of [from, to]: (5.5) with the ellipse of the largest k and
/// the hyperbola of the least. Posed like shape_at.
[[nodiscard]] WorldBody shape_over(const ShapeInTime& shape, double from, double to,
                                   const Eigen::Vector3d& position, const Eigen::Matrix3d& rotation);

}  // namespace vericone::simulation
