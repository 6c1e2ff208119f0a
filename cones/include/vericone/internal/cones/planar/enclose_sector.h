// SPDX-License-Identifier: BSD-3-Clause
//
// Intervals that contain the numbers of a sector, proved as those of ellipsoids/clearance.h are.
#pragma once

#include <vericone/cones/planar/sector.h>
#include <vericone/geometry/interval.h>
#include <optional>

namespace vericone {

/// A direction in the plane between two others, both exact: it lies counter-clockwise from `from` and
/// clockwise from `to`, or on one of them; less than half a turn between.
struct DirectionEnclosure {
  Eigen::Vector2d from, to;  // about unit length
};

/// The sector of two disjoint ellipses.
struct SectorEnclosure {
  DirectionEnclosure left, right;  // its edges
  Interval psi;                    // radians
  Interval theta_b;                // radians; of the values 2 pi apart, the one whose middle is in (-pi, pi]
};

/// Nothing for bodies that touch (psi = pi exactly) or overlap (2 pi). Width of psi on ordinary pairs: 6e-15
/// rad. Cost: about 13 us; integers are asked for the last bits.
[[nodiscard]] std::optional<SectorEnclosure> enclose_sector(const Ellipse& a, const Ellipse& b);

}  // namespace vericone
