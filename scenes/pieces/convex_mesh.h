// SPDX-License-Identifier: BSD-3-Clause
//
// Convex bodies as triangles, for pictures; nothing else is computed with them.
#pragma once

#include <vericone/geometry/convex.h>
#include <array>
#include <vector>

namespace vericone {

/// The surface between the points farthest along the directions of a grid of `rings` by 2 `rings` about z:
/// straight edges, rims and corners are met, round parts cut off by chords. World coordinates.
std::vector<std::array<Eigen::Vector3d, 3>> convex_mesh(const Convex& body, const Pose& pose, int rings = 24);

}  // namespace vericone
