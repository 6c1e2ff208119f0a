// SPDX-License-Identifier: BSD-3-Clause
//
// Cells of a map by what they hold.
#pragma once

#include <vericone/octomap/read_octree.h>

namespace vericone::octomap {

[[nodiscard]] CellKind kind_of(const OctreeCell& cell, const OctreeMeaning& meaning);

[[nodiscard]] OctreeBoxes boxes_by_kind(const Octree& octree, const OctreeMeaning& meaning);

}  // namespace vericone::octomap
