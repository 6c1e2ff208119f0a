// SPDX-License-Identifier: BSD-3-Clause
//
// The part of a mesh that lidars can see, whatever their beams.
#pragma once

#include <vericone/lidar/lidar.h>
#include <vericone/lidar/mesh_scene.h>
#include <vector>

namespace vericone::scanning {

struct SurfacePart {
  std::vector<Eigen::Vector3d> points;
  std::vector<lidar::Triangle> triangles;  // pieces of the mesh's triangles, not joined
  double area = 0;                         // m^2
};

/// Pieces of triangles whose corners and middle are within the field of view and the ranges of some lidar and
/// not hidden from it; triangles seen in part are quartered until their edges are below `resolution` metres,
/// and the last ones kept where their middle is seen. What is smaller than the triangles and hides less than
/// the points asked may be missed. The field of view is that between the outermost beams.
SurfacePart visible_part(const lidar::MeshScene& scene, const std::vector<Eigen::Vector3d>& points,
                         const std::vector<lidar::Triangle>& triangles,
                         const std::vector<lidar::Lidar>& lidars, const Eigen::Isometry3d& agent,
                         double resolution);

}  // namespace vericone::scanning
