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

/// Pieces of triangles, however large these are. They are quartered until they look no wider than
/// neighbouring beams are apart. Pieces whose corners and middle are within the field of view and the ranges
/// of some lidar and not hidden from it are seen; those seen in part are quartered until their edges are
/// below `resolution` metres (eight times at most), and the last ones kept where their middle is seen or a
/// beam hits them. So all that beams hit is there, the rim of the part is right to `resolution`, and what
/// hides less than lies between beams may be missed. Four pieces that are seen become one again. The field of
/// view is that between the outermost beams, or all around. `scene` holds `points` (m, world) and
/// `triangles`; `agent` takes the lidars' poses to the world. Cost: a ray for each beam, and up to four rays
/// a lidar for each piece looked at, of which there are about as many as beams. What is seen is the source's
/// assumption of full knowledge of the side that faces the agent (section 6.3.3).
[[nodiscard]] SurfacePart visible_part(const MeshScene& scene, const std::vector<Eigen::Vector3d>& points,
                                       const std::vector<Triangle>& triangles,
                                       const std::vector<Lidar>& lidars, const Eigen::Isometry3d& agent,
                                       double resolution);

}  // namespace vericone::lidar
