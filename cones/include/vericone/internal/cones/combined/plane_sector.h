// SPDX-License-Identifier: BSD-3-Clause
//
// Sectors of two combined quadrics on planes through the line of centres.
#pragma once

#include <vericone/cones/plane_sector.h>
#include <vericone/internal/cones/combined/cone.h>
#include <optional>

namespace vericone {

/// The sector on the plane of the line of centres and e, a unit vector perpendicular to it. Edges are proved
/// to `width` radians; where one is not decided, its angle errs to the safe side. Nothing where the bodies
/// are not known to be apart. Cost: two calls of CombinedOracle::edge().
[[nodiscard]] std::optional<PlaneSector> combined_sector_on(const CombinedOracle& oracle,
                                                            const Eigen::Vector3d& e, double width,
                                                            EdgeMemory* memory = nullptr);

}  // namespace vericone
