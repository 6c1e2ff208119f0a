// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/geometry/assembly.h>
#include <vericone/geometry/pose.h>
#include <array>
#include <cstdint>
#include <vector>

namespace vericone {

/// A mesh as it stands in the world, rounded; equal points are one.
struct WorldMesh {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Requires a body of triangles.
WorldMesh world_mesh(const Assembly& pieces, const Pose& pose);

}  // namespace vericone
