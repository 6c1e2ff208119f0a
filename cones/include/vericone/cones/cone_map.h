// SPDX-License-Identifier: BSD-3-Clause
//
// Cones of any shape, holes included, as a map on the sphere of directions.
#pragma once

#include <vericone/cones/direction_cell.h>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace vericone {

struct ConeMapOptions {
  double resolution = 0.01;              // radians: cells are divided until their edges are shorter
  std::uint64_t most_cells = 2'000'000;  // asked about; then the rest stays undecided
  /// Told the share that is decided, 0 to 1; returns false to stop (the rest stays undecided).
  std::function<bool(double)> progress;
};

struct ConeMapCell {
  DirectionCell corners;
  Certified label = Certified::undecided;
};

/// The sphere of relative velocities' directions, cut into spherical triangles that collide (`in`), are safe
/// (`out`), or are undecided at this resolution.
struct ConeMap {
  std::vector<ConeMapCell> cells;                 // cover the sphere, overlap in edges only
  double colliding = 0, safe = 0, undecided = 0;  // steradian, 4 pi in all
  std::uint64_t asked = 0;                        // calls of the classifier
};

/// Starts from an icosahedron; each undecided triangle is cut into four at the middles of its edges.
/// The true solid angle is between `colliding` and `colliding + undecided`. Throws InputError naming
/// "resolution" or "most_cells".
ConeMap cone_map(const DirectionClassifier& classifier, const ConeMapOptions& options = {});

}  // namespace vericone
