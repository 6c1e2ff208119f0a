// SPDX-License-Identifier: BSD-3-Clause
//
// Cells of a map by their direction.
#pragma once

#include <vericone/cones/map/cone_map.h>
#include <cstddef>

namespace vericone {

/// The index of the cell that contains a direction (of any one on an edge). Linear in the cells. Throws
/// InputError naming "map.cells" where there are none, or "direction" where it is zero or not finite.
[[nodiscard]] std::size_t cell_at(const ConeMap& map, const Eigen::Vector3d& direction);

}  // namespace vericone
