// SPDX-License-Identifier: BSD-3-Clause
//
// Connected regions of a cone map: the orifice cones of windows are its connected safe regions.
#pragma once

#include <vericone/cones/map/cone_map.h>
#include <cstdint>
#include <optional>
#include <vector>

namespace vericone {

/// Cells of one label connected by edges, parts of edges or corners.
///
/// Proved: all of the region has its label and is one piece, so it lies in one connected component of the set
/// of all safe (or colliding) directions. That component lies within the possible region: all that edges
/// connect with it when undecided cells are taken to have the same label.
struct ConeMapRegion {
  Certified label = Certified::out;  // in or out
  std::vector<std::uint32_t> cells;  // indices, increasing
  double solid_angle = 0;            // steradian: the component has at least this
  double most_solid_angle = 0;       // and at most this: the possible region's
  /// Number of the possible region. Regions of one label with different numbers are proved to be apart: no
  /// way leads from one to the other. With the same number a way through undecided cells may.
  std::uint32_t possible = 0;
  /// No other region of the label has that number.
  bool surely_separate = false;
  /// Closed polygons of directions (as in ConeMap::corners), the region to their left: counter-clockwise
  /// around it, clockwise around its holes. The longest, in radians, comes first. Empty for the whole sphere.
  std::vector<std::vector<Eigen::Vector3d>> boundary;
};

/// All regions, safe and colliding, the largest first. Time n log n in the number of cells.
[[nodiscard]] std::vector<ConeMapRegion> regions(const ConeMap& map);

/// The region that contains a direction != 0: with an agent before a window and the direction through it, the
/// window's orifice cone. Nothing where the direction is in an undecided cell. Same cost.
[[nodiscard]] std::optional<ConeMapRegion> region_around(const ConeMap& map,
                                                         const Eigen::Vector3d& direction);

}  // namespace vericone
