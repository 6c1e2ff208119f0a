// SPDX-License-Identifier: BSD-3-Clause
//
// Sections of both bodies by one plane through their line of sight: the source's way to cones in space
// (6.3.1-6.3.3), with the rates it leaves to numerical differences.
#pragma once

#include <vericone/geometry/combined.h>
#include <vericone/geometry/hull_body.h>
#include <vericone/internal/cones/combined/sector.h>
#include <vericone/internal/cones/ellipsoids/plane_sector.h>
#include <optional>

namespace vericone {

/// Sections of combined bodies by the plane of both centres, that of A about the origin and that of B about
/// (distance, 0).
struct Sections {
  CombinedEllipse a, b;
  CombinedSector sector;

  bool disjoint() const { return sector.sector.relation == Relation::disjoint; }
};
Sections sections_of(const CombinedEllipsoid& a, const CombinedEllipsoid& b, const Eigen::Vector3d& u,
                     const Eigen::Vector3d& e);

/// Closed form, theta_b against fixed axes. Requires disjoint sections.
SectorRates section_rates(const Sections& sections, const CombinedEllipsoid& a, const CombinedEllipsoid& b,
                          const Eigen::Vector3d& u, const Eigen::Vector3d& e, const SpatialMotion& motion);

/// The sector of the sections of a hull and of the agent; nothing where the plane misses the hull or the
/// agent's section reaches into it.
std::optional<Sector> hull_section(const Ellipsoid& agent, const HullBody& hull, const Eigen::Vector3d& u,
                                   const Eigen::Vector3d& e);

}  // namespace vericone
