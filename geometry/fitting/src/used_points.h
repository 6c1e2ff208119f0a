// SPDX-License-Identifier: BSD-3-Clause
//
// What of a sample is to be inside, and a point in its middle.
#pragma once

#include <vericone/fitting/sample.h>
#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace vericone::fitting {

/// Indices, increasing: all points of a cloud; of a mesh those that triangles use. Throws InputError naming
/// "points[i]" where one of them is not finite and "triangles[i]" for an index that is no point.
std::vector<std::uint32_t> used_points(const Sample& sample);

/// Of the box about the points; zero without points.
Eigen::Vector3d middle(const Sample& sample, const std::vector<std::uint32_t>& points);

}  // namespace vericone::fitting
