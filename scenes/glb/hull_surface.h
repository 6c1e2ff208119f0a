// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "glb/glb_file.h"

namespace vericone::glb {

/// The surface of the convex hull of one or more points, for pictures: by doubles, of more than 2,000 points
/// the hull of those that are farthest in some thousands of directions. Of points in a plane their polygon,
/// on a line a line, of one point that.
Drawn hull_surface(const std::vector<Eigen::Vector3d>& points);

}  // namespace vericone::glb
