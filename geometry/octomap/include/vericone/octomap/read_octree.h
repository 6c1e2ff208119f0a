// SPDX-License-Identifier: BSD-3-Clause
//
// Octree maps of OctoMap: cells that are occupied, free or unknown, and the boxes that a caller takes for
// obstacles.
#pragma once

#include <vericone/geometry/pose.h>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace vericone::octomap {

/// A cube of the tree that is not divided: a leaf of the map, or a child that an inner node does not have.
struct OctreeCell {
  /// Its lowest corner in cells of the finest level; 2^15 is the origin.
  std::array<std::uint16_t, 3> key{};

  /// Its side is 2^(16 - depth) cells of the finest level: 0 is the whole cube of the tree.
  std::uint8_t depth = 0;

  /// Whether the map says anything about it.
  bool is_known = false;

  /// Logarithm of p / (1 - p), p the probability that it is occupied. Infinite in a .bt file, which keeps
  /// only what its writer decided. 0 where unknown.
  float log_odds = 0;
};

struct Octree {
  /// "OcTree binary" for .bt, else the kind of the tree: "OcTree", "ColorOcTree" or "OcTreeStamped".
  std::string format;

  /// Side of the smallest cell, metres.
  double resolution = 0;

  /// Nodes of the tree, inner ones included.
  std::size_t nodes = 0;

  /// They fill the cube of the tree, [-2^15, 2^15]^3 times the resolution, without overlap, depth first: the
  /// eight children of a node follow each other, x changing fastest, then y, then z.
  std::vector<OctreeCell> cells;

  /// Bounding box of the known cells.
  Box bounds;

  /// Metres. The coordinates are whole multiples of the resolution, rounded once.
  [[nodiscard]] Box box(const OctreeCell& cell) const;
};

/// Reads .bt and .ot files, of trees of occupancy (OcTree, ColorOcTree without its colours, OcTreeStamped).
///
/// Throws InputError whose field is the path and whose message is one line: for a file that is missing,
/// empty, truncated or longer than its tree, of another kind of tree, whose header and tree have different
/// numbers of nodes, or that is malformed anywhere. Time and memory are linear in the size of the file.
[[nodiscard]] Octree read_octree(const std::filesystem::path& path);

/// What the cells of a map mean to the caller.
struct OctreeMeaning {
  /// A known cell is occupied where its probability is this or more, free otherwise; between 0 and 1, both
  /// excluded. The cells of a .bt file are what its writer decided, whatever this says.
  double occupied_above = 0.5;

  /// Whether free cells are obstacles.
  bool free_occupied = false;

  /// Whether space that the map says nothing about is an obstacle.
  bool unknown_occupied = true;

  /// **Where unknown space counts; known cells count everywhere.** Left out, it is the bounding box of the
  /// known cells, Octree::bounds: what lies beyond the map is then NOT part of the body, though nothing is
  /// known about it. A larger region adds the space around the map, a smaller one forgets unknown space
  /// within it.
  std::optional<Box> region;
};

enum class CellKind { occupied, free, unknown };

/// A box for each cell, by its kind. Unknown ones are clipped to the region and left out where nothing is
/// left of them; with a region that reaches out of the cube of the tree, up to six more are added. The boxes
/// do not overlap; those of the three kinds fill a region that contains the map. Throws InputError for a
/// threshold or a region that is none. Linear time.
struct OctreeBoxes {
  std::vector<Box> occupied, free, unknown;
};

/// The part of space that is an obstacle, as boxes that do not overlap: those of boxes_by_kind() that count,
/// but one box where the eight children of a node count entirely. Throws and costs what boxes_by_kind() does.
[[nodiscard]] std::vector<Box> obstacle_boxes(const Octree& octree, const OctreeMeaning& meaning);

}  // namespace vericone::octomap
