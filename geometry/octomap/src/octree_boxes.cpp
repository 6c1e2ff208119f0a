// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/internal/octomap/kinds.h>
#include <vericone/octomap/read_octree.h>

#include <cmath>
#include <limits>

#include "octree_header.h"

namespace vericone::octomap {
namespace {

using Eigen::Vector3d;

Box cube(double resolution, const std::array<std::uint16_t, 3>& key, int depth) {
  constexpr int kOrigin = 1 << (kDepth - 1);
  if (depth < 0 || depth > kDepth)
    throw InputError("cell.depth", std::to_string(depth), "between 0 and " + std::to_string(kDepth));
  Box box;
  for (std::size_t i = 0; i < 3; ++i) {
    const int low = int(key[i]) - kOrigin;
    box.low(Eigen::Index(i)) = low * resolution;
    box.high(Eigen::Index(i)) = (low + (1 << (kDepth - depth))) * resolution;
  }
  return box;
}

bool has_volume(const Box& box) { return (box.low.array() < box.high.array()).all(); }

Box common(const Box& a, const Box& b) { return {a.low.cwiseMax(b.low), a.high.cwiseMin(b.high)}; }

bool is_within(const Box& a, const Box& b) {
  return (b.low.array() <= a.low.array()).all() && (a.high.array() <= b.high.array()).all();
}

void check(const OctreeMeaning& meaning) {
  if (!(meaning.occupied_above > 0 && meaning.occupied_above < 1))
    throw InputError("occupied_above", to_text(meaning.occupied_above),
                     "a probability between 0 and 1, both excluded");
  if (!meaning.region) return;
  for (int i = 0; i < 3; ++i) {
    const double low = meaning.region->low(i), high = meaning.region->high(i);
    if (!std::isfinite(low) || !std::isfinite(high) || !(low < high))
      throw InputError("region", "[" + to_text(low) + ", " + to_text(high) + "] on axis " + std::to_string(i),
                       "a box of finite size with volume (metres)");
  }
}

/// Whoever makes a tree by hand may make one that is none: its cells must fill the cube, depth first.
void check(const Octree& octree) {
  if (!(octree.resolution > 0) || !std::isfinite(octree.resolution))
    throw InputError("octree.resolution", to_text(octree.resolution), "a finite number above 0 (m)");
  std::uint64_t filled = 0;  // cells of the finest level
  for (const OctreeCell& cell : octree.cells) {
    const std::uint64_t volume = cell.depth > kDepth ? 0 : std::uint64_t(1) << (3 * (kDepth - cell.depth));
    if (volume == 0 || filled % volume != 0)
      throw InputError("octree.cells", "others", "children of a tree, depth first");
    filled += volume;
  }
  if (filled != std::uint64_t(1) << (3 * kDepth))
    throw InputError("octree.cells", std::to_string(octree.cells.size()) + " cells",
                     "all that fill the cube of the tree");
}

/// The part of the region outside of the cube of the tree: slabs before and behind it on x, then, between
/// those, on y, then on z.
void add_beyond(const Octree& octree, Box region, std::vector<Box>& boxes) {
  const Box all = cube(octree.resolution, {}, 0);
  for (int i = 0; i < 3; ++i) {
    Box before = region, behind = region;
    before.high(i) = std::min(before.high(i), all.low(i));
    behind.low(i) = std::max(behind.low(i), all.high(i));
    for (const Box& box : {before, behind})
      if (has_volume(box)) boxes.push_back(box);
    region.low(i) = std::max(region.low(i), all.low(i));
    region.high(i) = std::min(region.high(i), all.high(i));
    if (!has_volume(region)) return;
  }
}

/// Finds the largest cubes of the tree whose children all count.
class Merger {
 public:
  Merger(const Octree& octree, const OctreeMeaning& meaning, std::vector<Box>& boxes)
      : octree_(octree), meaning_(meaning), region_(meaning.region.value_or(octree.bounds)), boxes_(boxes) {}

  void run() { emit({}, 0, visit({}, 0)); }

 private:
  using Key = std::array<std::uint16_t, 3>;

  /// What is true of the obstacles in a cube, as bits: they fill it; they are what it has in common with the
  /// region, perhaps nothing. With neither, they have been added to the boxes.
  static constexpr unsigned kWhole = 1, kInRegion = 2;

  unsigned visit(const Key& key, int depth) {
    const OctreeCell& cell = octree_.cells[next_];
    if (cell.depth == depth) {
      ++next_;
      return state(cell);
    }
    std::array<Key, 8> keys;
    std::array<unsigned, 8> states{};
    unsigned all = kWhole | kInRegion;
    for (unsigned i = 0; i < 8; ++i) {
      keys[i] = key;
      for (unsigned axis = 0; axis < 3; ++axis)
        if (i >> axis & 1U) keys[i][axis] = std::uint16_t(keys[i][axis] + (1U << (kDepth - 1 - depth)));
      states[i] = visit(keys[i], depth + 1);
      all &= states[i];
    }
    if (all == 0)
      for (std::size_t i = 0; i < 8; ++i) emit(keys[i], depth + 1, states[i]);
    return all;
  }

  unsigned state(const OctreeCell& cell) const {
    const Box box = octree_.box(cell);
    const CellKind kind = kind_of(cell, meaning_);
    const bool counts = kind == CellKind::occupied  ? true
                        : kind == CellKind::unknown ? meaning_.unknown_occupied
                                                    : meaning_.free_occupied;
    if (!counts) return has_volume(common(box, region_)) ? 0 : kInRegion;
    const unsigned within = is_within(box, region_) ? kWhole | kInRegion : 0;
    return within | (kind == CellKind::unknown ? kInRegion : kWhole);
  }

  void emit(const Key& key, int depth, unsigned state) {
    if (state == 0) return;
    const Box whole = cube(octree_.resolution, key, depth);
    const Box box = state & kWhole ? whole : common(whole, region_);
    if (has_volume(box)) boxes_.push_back(box);
  }

  const Octree& octree_;
  const OctreeMeaning& meaning_;
  Box region_;
  std::vector<Box>& boxes_;
  std::size_t next_ = 0;
};

}  // namespace

Box Octree::box(const OctreeCell& cell) const { return cube(resolution, cell.key, cell.depth); }

CellKind kind_of(const OctreeCell& cell, const OctreeMeaning& meaning) {
  if (!cell.is_known) return CellKind::unknown;
  const double threshold = std::log(meaning.occupied_above / (1 - meaning.occupied_above));
  return cell.log_odds >= threshold ? CellKind::occupied : CellKind::free;
}

OctreeBoxes boxes_by_kind(const Octree& octree, const OctreeMeaning& meaning) {
  check(meaning);
  check(octree);
  const Box region = meaning.region.value_or(octree.bounds);
  OctreeBoxes boxes;
  for (const OctreeCell& cell : octree.cells) {
    const Box box = octree.box(cell);
    switch (kind_of(cell, meaning)) {
      case CellKind::occupied:
        boxes.occupied.push_back(box);
        break;
      case CellKind::free:
        boxes.free.push_back(box);
        break;
      case CellKind::unknown:
        if (const Box part = common(box, region); has_volume(part)) boxes.unknown.push_back(part);
    }
  }
  add_beyond(octree, region, boxes.unknown);
  return boxes;
}

std::vector<Box> obstacle_boxes(const Octree& octree, const OctreeMeaning& meaning) {
  check(meaning);
  check(octree);
  std::vector<Box> boxes;
  Merger(octree, meaning, boxes).run();
  if (meaning.unknown_occupied) add_beyond(octree, meaning.region.value_or(octree.bounds), boxes);
  return boxes;
}

}  // namespace vericone::octomap
