// SPDX-License-Identifier: BSD-3-Clause
//
// The rims of an open mesh of triangles: its outer edge, and the windows in it.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace vericone {

/// The edges of one triangle alone, joined to closed loops of indices into `points`; each loop goes through a
/// point once, the last back to the first. Where loops touch in a point they are parted there. The longest
/// (metres) comes first: of a wall with windows that is its outer edge. A loop runs as its first edge does in
/// its triangle, so of a mesh whose triangles agree the surface is to its left, seen from where they turn
/// counterclockwise. Points are the same by index, not by place: merge equal ones first
/// (files::MeshOptions::merge_equal_points). Empty for a closed mesh. n log n in the triangles.
///
/// Throws InputError naming "triangles[i][k]" for an index without a point.
[[nodiscard]] std::vector<std::vector<std::uint32_t>> boundary_loops(
    const std::vector<Eigen::Vector3d>& points, const std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace vericone
