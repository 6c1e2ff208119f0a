// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/internal/cones/assembly/assembly_oracle.h>
#include <optional>

#include "answers/half_planes.h"

namespace vericone {

/// Where an agent and an assembly are nearest on the way; nothing where they meet.
std::optional<Passing> assembly_passing(const AssemblyOracle& oracle, const Eigen::Vector3d& w);

}  // namespace vericone
