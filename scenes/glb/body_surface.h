// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/geometry/body.h>
#include <vericone/geometry/world_body.h>

#include "glb/glb_file.h"

namespace vericone::glb {

/// The surface of a body of any kind less `origin` (m), in its own frame, inscribed where it is round:
/// corners and edges are met, and vertices lie on the surface to rounding. A union is all surfaces of its
/// parts, also within one another; balls of radius 0, and more than 2,000 others, are points.
Drawn body_surface(const Body& body, const Eigen::Vector3d& origin);

/// The same of a planar body: what it covers of z = 0.
Drawn flat_surface(const CombinedEllipse& body);

/// The same of convex outlines, less `origin`.
Drawn flat_surface(const std::vector<std::vector<Eigen::Vector2d>>& outlines, const Eigen::Vector3d& origin);

/// The body in its own frame about `origin`, m.
Drawn world_surface(const WorldBody& body, const Eigen::Vector3d& origin);

}  // namespace vericone::glb
