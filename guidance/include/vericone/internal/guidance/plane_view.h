// SPDX-License-Identifier: BSD-3-Clause
//
// What a view of an engagement on a plane is made of.
#pragma once

#include <vericone/guidance/plane_view.h>

namespace vericone::guidance {

/// The states alone. `across`: any vector not parallel to the line of sight; planar bodies take the plane
/// z = 0 with e = (-u_y, u_x, 0), whatever it is. Requires different centres and a vector not parallel.
[[nodiscard]] PlaneView plane_states(const BodyState& a, const BodyState& b, const Eigen::Vector3d& across,
                                     double plane_spin = 0);

/// Of bodies of these kinds (plane_cones.h).
[[nodiscard]] inline bool has_sectors(const BodyState& a, const BodyState& b, SectorMethod method) {
  return vericone::has_sectors(a.shape, b.shape, method);
}

/// The cone at `view`, filled in; false where the bodies are not apart (on the plane, for slices) or an
/// oracle does not decide, and nothing is written.
///
/// Closed-form rates: planar bodies; slices of combined bodies; true sectors, from the contacts at their
/// edges. Differenced are slices of hulls and edges of which no contact is known. B's own acceleration is not
/// known here: where B turns with its heading, only its omega counts. Edges of combined bodies' true sectors
/// are proved to 1e-7 rad; what cannot be decided counts as in. Cost with rates: true sectors of ellipsoids
/// 0.9 us, slices 2.6 us, of hulls of 12 points 7 us; true sectors of hulls of 12 points 7 us, of combined
/// bodies 10 us where the edges of the step before are remembered, else some 40 to 100 us, of two stars 1 ms,
/// of meshes, clouds and maps by Pair::sector (docs/reference/pairs.md).
bool fill_cone(PlaneView& view, const BodyState& a, const BodyState& b, SectorMethod method, RateMethod rates,
               EdgeMemory* memory = nullptr);

/// The body a moment `dt` later along its momentary motion: moved, turned by omega (and its heading by
/// `acceleration` where it turns with it), its shape changed at its rate.
[[nodiscard]] BodyState advanced(const BodyState& body, double dt,
                                 const Eigen::Vector3d& acceleration = Eigen::Vector3d::Zero());

/// Angular velocity, rad/s: omega, and v x a / |v|^2 where it turns with its heading.
[[nodiscard]] Eigen::Vector3d angular_velocity(const BodyState& body, const Eigen::Vector3d& acceleration);

}  // namespace vericone::guidance
