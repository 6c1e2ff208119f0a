// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pairs of combined quadrics to try the cones in space on.
#pragma once

#include <vericone/geometry/combined.h>
#include <vericone/internal/verify/combined/truth.h>

#include <array>
#include <cstdint>

namespace vericone::verify {

/// Unless said otherwise: semi-axes in [1, 10], rotations uniform, one body an ellipsoid (which one
/// alternates), apart along the line of centres by 1.05 to 3 times what their ellipsoids need. Centres are
/// multiples of 2^-20, so that CombinedTruth can be asked.
enum class CombinedFamily {
  biconcave,        // two dents along an axis of the body
  biconvex,         // a waist around an axis of the body
  star,             // two to four hyperboloids of any kind at any orientation
  mixed,            // both bodies combined, of any of these kinds
  shallow,          // both combined; surfaces that take off less than 3 % of an extent
  deep,             // both combined; surfaces within 2 to 10 % of the centre, some through it (level 0)
  thin,             // axis ratios up to 1000
  mouth,            // A, an ellipsoid or combined, inside a dent of B
  nearly_touching,  // both combined; a gap of 1e-4 to 1e-1 along a random direction
  distant,          // both combined; 1e2 to 1e3 times as far apart
};

inline constexpr std::array kAllCombinedFamilies = {
    CombinedFamily::biconcave,       CombinedFamily::biconvex, CombinedFamily::star, CombinedFamily::mixed,
    CombinedFamily::shallow,         CombinedFamily::deep,     CombinedFamily::thin, CombinedFamily::mouth,
    CombinedFamily::nearly_touching, CombinedFamily::distant};

/// The name of the enumerator.
[[nodiscard]] const char* name(CombinedFamily family);

struct CombinedPair {
  CombinedEllipsoid a, b;
};

/// Pair number `index` of a family; depends on nothing but the arguments. Pairs of `mouth` and
/// `nearly_touching` are placed by samples and may overlap now and then.
[[nodiscard]] CombinedPair combined_pair(CombinedFamily family, std::uint64_t seed, std::uint64_t index);

/// The direction w with the greatest coordinate kGreatestDirection, rounded to whole numbers.
[[nodiscard]] GridVector grid_direction(const Eigen::Vector3d& w);
/// The same as doubles, which hold it without rounding.
[[nodiscard]] Eigen::Vector3d as_vector(const GridVector& w);

}  // namespace vericone::verify
