// SPDX-License-Identifier: BSD-3-Clause
//
// Cones of any shape, holes included, as a map on the sphere of directions (docs/explanation/cone-map.md).
#pragma once

#include <vericone/internal/cones/direction_cell.h>
#include <vericone/internal/geometry/requires.h>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace vericone {

struct ConeMapOptions {
  double resolution = 0.01;              // radians: cells are divided until their edges are shorter
  std::uint64_t most_cells = 2'000'000;  // asked about; then the rest stays undecided, largest cells first
  int threads = 1;                       // the map does not depend on it; 0: as many as the machine has
  /// Told the share of the sphere that is decided, 0 to 1; returns false to stop (the rest stays undecided).
  std::function<bool(double)> progress;
};

struct ConeMapCell {
  std::array<std::uint32_t, 3> corners{};  // of the map's, counter-clockwise seen from outside
  Certified label = Certified::undecided;
};

/// The sphere of relative velocities' directions, cut into spherical triangles that collide (`in`), are safe
/// (`out`), or are undecided at this resolution.
struct ConeMap {
  /// Directions, not of unit length: |x| is between 0.79 and 1. Coordinates are multiples of a power of two
  /// for which the middle of two corners is exact; so the cells cover every direction, and have no more than
  /// edges in common, without any rounding.
  std::vector<Eigen::Vector3d> corners;
  /// The two corners that a corner is the middle of; for the first twelve, twice itself.
  std::vector<std::array<std::uint32_t, 2>> between;
  std::vector<ConeMapCell> cells;  // neighbours may be of different sizes

  double colliding = 0, safe = 0, undecided = 0;  // steradian, 4 pi in all, to 1e-12
  std::uint64_t asked = 0;                        // calls of the classifier
  bool complete = true;                           // false: stopped before the resolution was reached

  [[nodiscard]] DirectionCell cell(std::size_t i) const {
    VERICONE_REQUIRES(
        i < cells.size() && std::ranges::all_of(cells[i].corners, [&](auto k) { return k < corners.size(); }),
        "i", "no such cell, or corners that the map does not have",
        "a cell of a map as cone_map() returns it");
    const auto& c = cells[i].corners;
    return {corners[c[0]], corners[c[1]], corners[c[2]]};
  }
};

/// Starts from an icosahedron; each undecided triangle is cut into four at the middles of its edges, level by
/// level; four parts of the same label are one cell again. The true solid angle is between `colliding` and
/// `colliding + undecided`. Cost: calls of the classifier; 8 bytes a call and what the classifier keeps of
/// one level. Throws InputError naming "resolution", "most_cells" or "threads", and what the classifier does.
[[nodiscard]] ConeMap cone_map(const DirectionClassifier& classifier, const ConeMapOptions& options = {});

/// Steradian; of any lengths. Accurate to rounding for the smallest cells too.
[[nodiscard]] double solid_angle(const DirectionCell& cell);

// Connected regions of a cone map: the orifice cones of windows are its connected safe regions.

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
