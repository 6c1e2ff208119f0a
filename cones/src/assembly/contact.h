// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "assembly/scene.h"

namespace vericone::assembly {

/// First contact along w, in the obstacle's frame and not zero, for bodies that are disjoint now; nothing
/// where no piece is met.
std::optional<AssemblyContact> first_contact(const Scene& scene, const Eigen::Vector3d& w, Effort& effort);

/// Least distance from now on; `space`: the agent in space (Frame::in_space).
AssemblyMiss miss_distance(const Scene& scene, const Frame& space, const Eigen::Vector3d& w, double tolerance,
                           Effort& effort);

}  // namespace vericone::assembly
