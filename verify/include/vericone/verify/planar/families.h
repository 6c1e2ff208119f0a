// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pairs of ellipses to try a planar method on, from easy to as hard as doubles allow.
#pragma once

#include <vericone/geometry/ellipsoid.h>
#include <array>
#include <cstdint>
#include <utility>

namespace vericone::verify {

/// Unless said otherwise: semi-axes in [1, 10], axes turned at random, centre of A within 10 of the origin,
/// centres apart by 1.2 to 5 times the distance at which the bodies would touch in that direction.
enum class PlanarFamily {
  regular,
  congruent,        // the same shape matrix, bit for bit
  proportional,     // shape of B is a multiple of the shape of A, exactly
  common_axes,      // exactly parallel axes; every other pair also has its centres on a common axis, exactly
  circles,          // some of them of the same radius
  thin,             // axis ratio 1e6 : 1, one body or both
  far_from_origin,  // both centres about 1e9 from the origin
  far_apart,        // distance 1e9 times the size
  nearly_touching,  // gap of 1e-3 to 1e-12 of the touching distance; every fourth pair overlaps by as much
                    // instead
  within_rounding,  // at the touching distance to a few eps: only an exact decision tells separated from
                    // overlapping
  thin_touching,    // axis ratio 10 to 1e6 : 1 and a gap of 1e-3 to 1e-10 of the touching distance; for the
                    // thinnest with the smallest gaps only an exact decision tells the side
  symmetric,        // one coordinate axis is an axis of both bodies, exactly: tangents are mirror images
  mixed_scale,      // one body 1e6 times larger
};

inline constexpr std::array kAllPlanarFamilies = {
    PlanarFamily::regular,         PlanarFamily::congruent,     PlanarFamily::proportional,
    PlanarFamily::common_axes,     PlanarFamily::circles,       PlanarFamily::thin,
    PlanarFamily::far_from_origin, PlanarFamily::far_apart,     PlanarFamily::nearly_touching,
    PlanarFamily::within_rounding, PlanarFamily::thin_touching, PlanarFamily::symmetric,
    PlanarFamily::mixed_scale};

/// The name of the enumerator.
[[nodiscard]] const char* name(PlanarFamily family);

/// Pair number `index` of a family. Depends on nothing but the arguments, and uses only operations that IEEE
/// 754 rounds correctly: the same bits on every machine. About 0.05 ms.
[[nodiscard]] std::pair<Ellipse, Ellipse> planar_pair(PlanarFamily family, std::uint64_t seed,
                                                      std::uint64_t index);

}  // namespace vericone::verify
