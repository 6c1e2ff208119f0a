// SPDX-License-Identifier: GPL-3.0-or-later
//
// The quadrics of a combined body as they are defined: in rationals, and as whole numbers with a bound of
// what rounding them to whole numbers changed.
#pragma once

#include <gmpxx.h>
#include <vericone/geometry/combined.h>

#include <array>
#include <cstdint>
#include <vector>

namespace vericone::verify {

__extension__ using Int128 = __int128;

/// { y : y^T m y <= level } about the centre of the body.
struct RationalRegion {
  std::array<std::array<mpq_class, 3>, 3> m;
  mpq_class level;
};

/// The ellipsoid's region first, from the matrix that defines it.
std::vector<RationalRegion> rational_regions(const CombinedEllipsoid& body);

/// The same for y in units of 2^unit: |y^T q y - (y^T m y)| <= error_factor(y)^2 in its own scale, where
/// error_factor is the sum of the coordinates' magnitudes.
struct GridRegion {
  std::array<std::array<std::int64_t, 3>, 3> q;
  Int128 level_floor, level_ceil;
};

std::vector<GridRegion> grid_regions(const CombinedEllipsoid& body, int unit);

}  // namespace vericone::verify
