// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "certificate/stated.h"

namespace vericone::simulation::certified {

/// Boxes as the cells of an octree, which is stated in some four characters a cell.
struct Octree {
  Eigen::Vector3d low;     // m, of its cube
  double cell;             // m, edge of the smallest cells
  int depth;               // the cube's edge is cell 2^(depth+1)
  std::string tree;        // as the format's page says
  std::vector<Box> boxes;  // the cells, in their order
  double rounding;         // m, no point of the boxes is farther from the cells
};

/// Nothing where their faces are not on the grid of the smallest.
[[nodiscard]] std::optional<Octree> octree_of(const std::vector<Box>& boxes);

}  // namespace vericone::simulation::certified
