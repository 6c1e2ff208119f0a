// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pairs of disjoint ellipsoids to try the cones in space on.
#pragma once

#include <vericone/geometry/ellipsoid.h>
#include <array>
#include <cstdint>
#include <utility>

namespace vericone::verify {

/// Unless said otherwise: semi-axes in [1, 10], rotations uniform, centre of A within 10 of the origin in
/// each coordinate, and with c = d e, e a uniform direction, d = 1.5 to 3 times rho_A(e) + rho_B(e).
enum class SpatialFamily {
  regular,
  spheres,
  thin,             // needles and discs, axis ratio 100 : 1, one body or both
  sideways,         // two long crossed bodies side by side; the line of centres meets the overlap of their
                    // widths: e does not separate them
  nearly_touching,  // 1 + 1e-6 times the distance along e at which the bodies touch
  distant,          // 1e3 to 1e6 times rho_A(e) + rho_B(e)
};

inline constexpr std::array kAllSpatialFamilies = {
    SpatialFamily::regular,  SpatialFamily::spheres,         SpatialFamily::thin,
    SpatialFamily::sideways, SpatialFamily::nearly_touching, SpatialFamily::distant};

/// The name of the enumerator.
[[nodiscard]] const char* name(SpatialFamily family);

/// Pair number `index` of a family; depends on nothing but the arguments. About 0.02 ms.
[[nodiscard]] std::pair<Ellipsoid, Ellipsoid> spatial_pair(SpatialFamily family, std::uint64_t seed,
                                                           std::uint64_t index);

}  // namespace vericone::verify
