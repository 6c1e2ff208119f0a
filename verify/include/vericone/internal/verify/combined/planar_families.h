// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pairs of planar combined quadrics to try sectors on.
#pragma once

#include <vericone/geometry/combined.h>
#include <array>
#include <cstdint>
#include <utility>

namespace vericone::verify {

/// Unless said otherwise: A an ellipse; semi-axes of ellipses in [1, 10], of hyperbolas in [0.3, 8], axes
/// turned at random; centres apart by 1 to 4 times the sum of the bodies' radii along the line between them.
enum class CombinedPlanarFamily {
  one_hyperbola,  // B an ellipse with any one hyperbola
  several,        // B with two or three
  dented,         // B the source's conic (5.5), any k
  pinched,        // the same with k = 1
  waist,          // B cut by a second ellipse, every other one by a hyperbola besides; so may sections be
  both,           // A and B any of the above
  mouth,          // A small and in B's mouth, 0.2 to 1.2 of the way out; A an ellipse or dented itself
  interlocked,    // both dented, moved along the line of centres to a gap of 1e-3 to 1e-1 of the distance:
                  // often in each other's mouths
  thin,           // as both, axes 10 to 1000 : 1 times as thin; moved likewise, 0.01 to 3
  far,            // centres apart by 1e2 to 1e6, otherwise as both
  near_touching,  // as both or interlocked, then moved to a gap of 1e-2 to 1e-9 of the distance, or to as
                  // deep an overlap
};

inline constexpr std::array kAllCombinedPlanarFamilies = {
    CombinedPlanarFamily::one_hyperbola, CombinedPlanarFamily::several,      CombinedPlanarFamily::dented,
    CombinedPlanarFamily::pinched,       CombinedPlanarFamily::waist,        CombinedPlanarFamily::both,
    CombinedPlanarFamily::mouth,         CombinedPlanarFamily::interlocked,  CombinedPlanarFamily::thin,
    CombinedPlanarFamily::far,           CombinedPlanarFamily::near_touching};

/// The name of the enumerator.
[[nodiscard]] const char* name(CombinedPlanarFamily family);

/// Pair number `index` of a family; depends on nothing but the arguments, but for the last bits of the
/// machine's sine and cosine.
[[nodiscard]] std::pair<CombinedEllipse, CombinedEllipse> combined_planar_pair(CombinedPlanarFamily family,
                                                                               std::uint64_t seed,
                                                                               std::uint64_t index);

}  // namespace vericone::verify
