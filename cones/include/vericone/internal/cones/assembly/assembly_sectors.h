// SPDX-License-Identifier: BSD-3-Clause
//
// Sectors of an agent and an assembly.
#pragma once

#include <vericone/cones/plane_sector.h>
#include <vericone/internal/cones/assembly/assembly_oracle.h>
#include <optional>

namespace vericone {

/// The line of sight is from `from` to `to`, points in the world; e is perpendicular to it, unit. Nothing
/// where the bodies are not apart or the plane misses the cone. Edges are proved to 1e-9 rad where pieces do
/// not graze the plane within rounding. Cost: two or three extreme directions and two misses.
[[nodiscard]] std::optional<PlaneSector> assembly_sector(const AssemblyOracle& oracle,
                                                         const Eigen::Vector3d& from,
                                                         const Eigen::Vector3d& to, const Eigen::Vector3d& e);

}  // namespace vericone
