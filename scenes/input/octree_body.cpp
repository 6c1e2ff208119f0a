// SPDX-License-Identifier: BSD-3-Clause
#include "input/octree_body.h"

#include <vericone/internal/octomap/kinds.h>
#include <vericone/octomap/read_octree.h>
#include <algorithm>

#include "input/fields.h"
#include "input/stopwatch.h"
#include "json/json_value.h"

namespace vericone::input {
namespace {

bool read_occupied(const Json& value, const std::string& path, const char* field, bool otherwise) {
  if (!value.contains(field)) return otherwise;
  const Json& word = value[field];
  if (word != "occupied" && word != "free")
    throw InputError(path + "." + field, quoted(word), "\"occupied\" or \"free\"");
  return word == "occupied";
}

Box read_region(const Json& value, const std::string& path) {
  if (!value.is_array() || value.size() != 2)
    throw InputError(path, quoted(value),
                     "two opposite corners [[x, y, z], [x, y, z]] (metres, of the file)");
  const Box region{read_vector<3>(value[0], at(path, 0), " (metres)"),
                   read_vector<3>(value[1], at(path, 1), " (metres)")};
  if (!(region.low.array() < region.high.array()).all())
    throw InputError(path, quoted(value), "the lower corner, then the upper one, each coordinate larger");
  return region;
}

octomap::OctreeMeaning read_meaning(const Json& value, const std::string& path) {
  octomap::OctreeMeaning meaning;
  meaning.unknown_occupied = read_occupied(value, path, "unknown", true);
  meaning.free_occupied = read_occupied(value, path, "free", false);
  if (value.contains("occupied_above")) {
    const double p = read_number(value["occupied_above"], path + ".occupied_above", "");
    if (!(p > 0 && p < 1))
      throw InputError(path + ".occupied_above", to_text(p), "a probability between 0 and 1, both excluded");
    meaning.occupied_above = p;
  }
  if (value.contains("region")) meaning.region = read_region(value["region"], path + ".region");
  return meaning;
}

}  // namespace

bool have_octrees() { return true; }

OctreePieces read_octree_pieces(const Json& value, const std::string& path, const std::filesystem::path& file,
                                double scale) {
  const octomap::OctreeMeaning meaning = read_meaning(value, path);
  const auto start = Clock::now();
  const auto read = [&] {
    try {
      return octomap::read_octree(file);
    } catch (const InputError& e) {
      throw InputError(path + ".octree", value["octree"].get<std::string>() + ": " + e.value(),
                       e.requirement());
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
    throw InputError(path, "no cell that is an obstacle",
                     "a map with occupied cells, or unknown space in its region");
  if (scale != 1)
    for (Box& box : boxes) box = {scale * box.low, scale * box.high};
  Assembly pieces = Assembly::boxes(std::move(boxes));
  reading.seconds_built = seconds_since(built);
  return {std::move(pieces), std::move(reading)};
}

}  // namespace vericone::input
