// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/internal/cones/assembly/assembly_sectors.h>

#include "assembly/passing.h"

namespace vericone {

using Eigen::Vector3d;

std::optional<Passing> assembly_passing(const AssemblyOracle& oracle, const Vector3d& w) {
  const AssemblyMiss miss = oracle.miss_distance(w, 1e-13);
  if (!(miss.most > 0) || miss.normal.isZero(0)) return std::nullopt;
  const Vector3d way = miss.time * w + 0.5 * (miss.least + miss.most) * miss.normal;
  return Passing{miss.point - way, miss.point, miss.normal};
}

std::optional<PlaneSector> assembly_sector(const AssemblyOracle& oracle, const Vector3d& from,
                                           const Vector3d& to, const Vector3d& e) {
  constexpr double kEdge = 1e-9;
  if (oracle.relation() != Relation::disjoint) return std::nullopt;
  const auto reach = [&](const Vector3d& axis, const Vector3d& side) -> HalfPlaneReach {
    const ExtremeDirection found = oracle.extreme(axis, side, kEdge);
    return {found.any, found.low, found.high};
  };
  const auto passing = [&](const Vector3d& direction) { return assembly_passing(oracle, direction); };
  return sector_of_half_planes(from, to, e, reach, passing);
}

}  // namespace vericone
