// SPDX-License-Identifier: BSD-3-Clause
#include "input/assembly_body.h"

#include <vericone/internal/octomap/kinds.h>
#include <vericone/octomap/read_octree.h>
#include <algorithm>

#include "input/stopwatch.h"

namespace vericone::input {

bool have_octrees() { return true; }

OctreePieces read_octree_pieces(const OctreeFields& fields, const std::string& name,
                                const std::filesystem::path& file, double scale) {
  const octomap::OctreeMeaning meaning{fields.occupied_above, fields.free_occupied, fields.unknown_occupied,
                                       fields.region};
  const auto start = Clock::now();
  const auto read = [&] {
    try {
      return octomap::read_octree(file);
    } catch (const InputError& e) {
      throw InputError("octree", name + ": " + e.value(), e.requirement());
    }
  };
  const octomap::Octree tree = read();
  scenes::Reading reading{tree.format};
  reading.map = scenes::Reading::Map{scale * tree.resolution, tree.nodes, meaning.unknown_occupied,
                                     std::ranges::any_of(tree.cells, [&](const octomap::OctreeCell& cell) {
                                       return octomap::kind_of(cell, meaning) == octomap::CellKind::free;
                                     })};
  reading.seconds_read = seconds_since(start);
  const auto built = Clock::now();
  std::vector<Box> boxes = octomap::obstacle_boxes(tree, meaning);
  if (boxes.empty())
    throw InputError("", "no cell that is an obstacle",
                     "a map with occupied cells, or unknown space in its region");
  if (scale != 1)
    for (Box& box : boxes) box = {scale * box.low, scale * box.high};
  Assembly pieces = Assembly::boxes(std::move(boxes));
  reading.seconds_built = seconds_since(built);
  return {std::move(pieces), std::move(reading)};
}

}  // namespace vericone::input
