// SPDX-License-Identifier: BSD-3-Clause
//
// The part of a mesh that lidars can see, whatever their beams.
#pragma once

#include <vericone/lidar/lidar.h>
#include <vericone/lidar/mesh_scene.h>
#include <vector>

namespace vericone::lidar {

struct SurfacePart {
  std::vector<Eigen::Vector3d> points;  // m
  std::vector<Triangle> triangles;      // pieces of the mesh's triangles, not joined
  double area = 0;                      // m^2
};

/// Pieces of triangles whose corners and middle are within the field of view and the ranges of some lidar and
/// not hidden from it; triangles seen in part are quartered until their edges are below `resolution` metres
/// (eight times at most), and the last ones kept where their middle is seen. So the rim of the part is right
/// to `resolution`; what is smaller than the triangles and hides less than the points asked may be missed.
/// The field of view is that between the outermost beams, or all around. `scene` holds `points` (m, world)
/// and `triangles`; `agent` takes the lidars' poses to the world. Cost: up to four rays a lidar for each
/// piece looked at. What is seen is the source's assumption of full knowledge of the side that faces the
/// agent (section 6.3.3).
[[nodiscard]] SurfacePart visible_part(const MeshScene& scene, const std::vector<Eigen::Vector3d>& points,
                                       const std::vector<Triangle>& triangles,
                                       const std::vector<Lidar>& lidars, const Eigen::Isometry3d& agent,
                                       double resolution);

}  // namespace vericone::lidar
