// SPDX-License-Identifier: BSD-3-Clause
//
// The sector of any pair on a plane.
#pragma once

#include <vericone/cones/plane_sector.h>
#include <Eigen/Core>
#include <optional>

#include "answers/half_planes.h"

namespace vericone::pairs {

class Family;

/// Between points of the agent and the obstacle, in the world, metres.
struct SightLine {
  Eigen::Vector3d from, to;

  Eigen::Vector3d direction() const { return (to - from).normalized(); }
};

/// By cells of directions, whatever the bodies are: arcs are proved to miss from the outermost inwards, until
/// one is found whose middle is proved to collide.
std::optional<PlaneSector> sector_by_arcs(const Family& family, const SightLine& line,
                                          const Eigen::Vector3d& e);

/// Of -w, with the bodies exchanged: `sector` is that of the exchanged pair on -u, -e.
PlaneSector mirror_image(PlaneSector sector);

}  // namespace vericone::pairs
