// SPDX-License-Identifier: BSD-3-Clause
//
// Sectors of an ellipsoid and a hull of points on many planes.
#pragma once

#include <vericone/cones/plane_sector.h>
#include <vericone/internal/cones/hulls/hull_oracle.h>
#include <optional>

namespace vericone {

/// Each edge is that of the agent against a corner or between two, found by a search for the plane that turns
/// farthest, and asked of the exact oracle. Refers to the bodies
/// and to their oracle.
class HullSectors {
 public:
  static constexpr double kEdge = 1e-9;  // rad, to which edges are proved

  HullSectors(const Ellipsoid& agent, const HullBody& hull, const HullOracle& oracle);

  /// The line of sight ends at the hull's reference point, which need not be in it; e is perpendicular to it,
  /// unit. Nothing where the bodies are not apart, the line of sight is outside the cone, or the search's
  /// edges are denied: ask assembly_sector() of assembly_sectors.h then. Cost: 2 us for 12 points.
  [[nodiscard]] std::optional<PlaneSector> on(const Eigen::Vector3d& reference,
                                              const Eigen::Vector3d& e) const;

 private:
  [[nodiscard]] std::optional<GrazingEdge> edge(const Eigen::Vector3d& reference, const Eigen::Vector3d& u,
                                                const Eigen::Vector3d& side) const;

  const Ellipsoid& agent_;
  const HullBody& hull_;
  const HullOracle& oracle_;
  Eigen::Matrix3d inverse_;  // of the agent's factor
};

}  // namespace vericone
