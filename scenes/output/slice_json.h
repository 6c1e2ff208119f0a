// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/cones/planar/sector.h>
#include <vericone/cones/slices/slice_cone.h>

#include "json/json_forward.h"

namespace vericone {

/// The source's y (6.14) on the slice's plane through `axis`, of the velocities projected on it.
ConeFunction plane_function(const Slice& slice, const Eigen::Vector3d& axis,
                            const Eigen::Vector3d& agent_velocity, const Eigen::Vector3d& obstacle_velocity);

/// One plane's sector with the source's y (6.14) and the velocities projected on the line of sight and across
/// it (docs/reference/formats.md).
Json sector_json(const Slice& slice, const Eigen::Vector3d& axis, const Eigen::Vector3d& agent_velocity,
                 const Eigen::Vector3d& obstacle_velocity);

/// {"directions", "solid_angle", "cross_section_area"}.
Json polyhedral_json(const PolyhedralCone& cone);

}  // namespace vericone
