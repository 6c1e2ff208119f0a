// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vericone/geometry/ellipsoid.h>

#include <span>

namespace vericone::verify {

struct DistanceBounds {
  double low = 0, high = 0;
};

/// Euclidean distance of an ellipsoid, moved along the ray w (or not, w = 0), to the hull of some points: a
/// plane gives the lower bound, two points the upper one, both up to a few roundings of the coordinates.
/// Wolfe's search for the point of least norm, with the ray as a generator of its own.
DistanceBounds ellipsoid_distance(const Ellipsoid& agent, std::span<const Eigen::Vector3d> points,
                                  const Eigen::Vector3d& w);

}  // namespace vericone::verify
