// SPDX-License-Identifier: BSD-3-Clause
//
// Triangles of directions, and who can say of all the directions in one whether they collide.
#pragma once

#include <vericone/cones/answers.h>
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace vericone {

/// All directions a d0 + b d1 + c d2, a, b, c >= 0, not all zero: a spherical triangle. Vectors of lengths
/// between 0.7 and 1 (with unit vectors the parts of a cell would not be exactly the cell), less than a right
/// angle apart, det(d0, d1, d2) > 0.
using DirectionCell = std::array<Eigen::Vector3d, 3>;

/// What a classifier learned about a cell and need not learn again for the parts of it: indices of its own.
using Frontier = std::vector<std::uint32_t>;

/// The closed set of colliding directions of one agent and one body, asked cell by cell.
class DirectionClassifier {
 public:
  virtual ~DirectionClassifier() = default;

  /// What a whole sphere starts with.
  [[nodiscard]] virtual Frontier start() const { return {}; }

  /// `in`: every direction of the cell collides; `out`: none does; both are proved. `undecided`: the cell is
  /// mixed, or could not be proved to be either. `parent`: that of a cell that contains this one, or start();
  /// `own`: receives this cell's where it is undecided. Throws InputError naming "parent" where it is
  /// neither. May be called by several threads at once.
  virtual Certified classify(const DirectionCell& cell, const Frontier& parent, Frontier& own) const = 0;

  /// Whether classify() would say `out`. Where bodies have many parts, proving `in` is half of its cost.
  virtual bool misses(const DirectionCell& cell, const Frontier& parent, Frontier& own) const {
    return classify(cell, parent, own) == Certified::out;
  }
};

}  // namespace vericone
