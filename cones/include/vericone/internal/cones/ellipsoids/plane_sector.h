// SPDX-License-Identifier: BSD-3-Clause
//
// Sectors of two ellipsoids on planes through the line of centres, with rates of changing shapes.
#pragma once

#include <vericone/cones/ellipsoids/predicates.h>
#include <vericone/cones/plane_sector.h>
#include <vericone/geometry/combined.h>

namespace vericone {

/// `across`: any vector not parallel to the line of centres; with it spans the plane. Throws InputError
/// naming "across", or "bodies" where they are not disjoint. Cost: about 1 us, 2 us where bodies are near
/// each other.
[[nodiscard]] PlaneSector true_sector(const Ellipsoid& a, const Ellipsoid& b, const Eigen::Vector3d& across);

/// Two bodies prepared for sectors on many planes. No allocation.
class SectorPlanes {
 public:
  SectorPlanes(const Ellipsoid& a, const Ellipsoid& b);

  /// Certified; false also of bodies so near each other that rounding could matter (true_sector() then asks
  /// integers).
  [[nodiscard]] bool disjoint() const { return disjoint_; }

  /// As true_sector(), which it asks integers for where disjoint() is false.
  [[nodiscard]] PlaneSector on(const Eigen::Vector3d& across) const;

 private:
  Ellipsoid a_, b_;
  Eigen::Vector3d c_, line_of_sight_, separating_ = Eigen::Vector3d::Zero();
  bool disjoint_ = false;
};

/// `sector`: of a and b. Throws InputError naming "sector" for a default-constructed one, which has no plane,
/// and "bodies" for bodies with the same centre.
[[nodiscard]] PlaneSectorRates true_sector_rates(const PlaneSector& sector, const Ellipsoid& a,
                                                 const Ellipsoid& b, const SpatialMotion& motion);

}  // namespace vericone
