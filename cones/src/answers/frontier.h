// SPDX-License-Identifier: BSD-3-Clause
//
// Frontiers come back from callers: what is in them is looked at before it is used as an index.
#pragma once

#include <vericone/geometry/error.h>
#include <vericone/internal/cones/direction_cell.h>
#include <algorithm>
#include <string>

namespace vericone {

inline void require_frontier(bool holds, const Frontier& parent) {
  if (!holds)
    throw InputError("parent", std::to_string(parent.size()) + " numbers",
                     "start(), or what classify() or misses() gave for a cell that has this one");
}
/// All below `count`.
inline void require_indices(const Frontier& parent, std::size_t count) {
  require_frontier(std::ranges::all_of(parent, [&](std::uint32_t i) { return i < count; }), parent);
}

}  // namespace vericone
