// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/octree.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <span>

namespace vericone::simulation::certified {
namespace {

using Eigen::Vector3d;
using Cells = Eigen::Matrix<std::int64_t, 3, 1>;

constexpr double kNear = 1e-9;  // of a cell: what rounding may have moved a box's faces by
constexpr std::int64_t kFarthest = 1 << 20, kMostCells = 1 << 22,
                       kAligned = 64;  // larger cells of the map stay whole

/// Smallest cells first to last of each axis, without last.
struct Block {
  Cells first, last;
};

/// The bits of a cell's place, interleaved: the order of the tree's cells.
std::uint64_t code_of(const Cells& cell) {
  std::uint64_t code = 0;
  for (int bit = 0; bit < 21; ++bit)
    for (int i = 0; i < 3; ++i) code |= static_cast<std::uint64_t>(cell(i) >> bit & 1) << (3 * bit + i);
  return code;
}
Cells cell_of(std::uint64_t code) {
  Cells cell = Cells::Zero();
  for (int bit = 0; bit < 21; ++bit)
    for (int i = 0; i < 3; ++i) cell(i) |= static_cast<std::int64_t>(code >> (3 * bit + i) & 1) << bit;
  return cell;
}

/// The edge of the smallest boxes, from the whole extent of all, in few digits.
double edge_of(const std::vector<Box>& boxes, const Box& all) {
  double least = std::numeric_limits<double>::infinity();
  for (const Box& box : boxes) least = std::min(least, (box.high - box.low).minCoeff());
  if (!(least > 0)) return 0;
  const double extent = (all.high - all.low).maxCoeff(), count = std::round(extent / least);
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.12g", extent / count);
  return std::strtod(digits, nullptr);
}

/// The cells that the boxes are, of a grid through `origin`; none where a face is between them.
std::vector<Block> blocks_of(const std::vector<Box>& boxes, double edge, const Vector3d& origin) {
  std::vector<Block> blocks;
  std::int64_t cells = 0;
  for (const Box& box : boxes) {
    Block block;
    for (int i = 0; i < 3; ++i) {
      const double low = (box.low(i) - origin(i)) / edge, high = (box.high(i) - origin(i)) / edge;
      if (!(std::abs(low) < kFarthest && std::abs(high) < kFarthest)) return {};
      block.first(i) = std::llround(low);
      block.last(i) = std::llround(high);
      if (!(std::abs(low - static_cast<double>(block.first(i))) < kNear)) return {};
      if (!(std::abs(high - static_cast<double>(block.last(i))) < kNear)) return {};
    }
    cells += (block.last - block.first).prod();
    if (cells > kMostCells) return {};
    blocks.push_back(block);
  }
  return blocks;
}

std::vector<std::uint64_t> codes_of(const std::vector<Block>& blocks, const Cells& corner) {
  std::vector<std::uint64_t> codes;
  for (const Block& block : blocks)
    for (std::int64_t x = block.first.x(); x < block.last.x(); ++x)
      for (std::int64_t y = block.first.y(); y < block.last.y(); ++y)
        for (std::int64_t z = block.first.z(); z < block.last.z(); ++z)
          codes.push_back(code_of(Cells(x, y, z) - corner));
  std::sort(codes.begin(), codes.end());
  codes.erase(std::unique(codes.begin(), codes.end()), codes.end());
  return codes;
}

/// The text of a node, from the codes in it; its eighths have the edge 2^level. `whole`: called with the
/// first code and the level of each cell.
template <typename Whole>
void write(std::span<const std::uint64_t> codes, int level, std::string& tree, const Whole& whole) {
  const std::size_t here = tree.size();
  tree.append(8, '.');
  while (!codes.empty()) {
    const std::uint64_t eighth = codes.front() >> (3 * level);
    const auto end = std::find_if(codes.begin(), codes.end(),
                                  [&](std::uint64_t code) { return code >> (3 * level) != eighth; });
    const auto count = static_cast<std::size_t>(end - codes.begin());
    const bool full = count == std::uint64_t{1} << (3 * level);
    tree[here + (eighth & 7)] = full ? '#' : '+';
    if (full)
      whole(codes.front(), level);
    else
      write(codes.first(count), level - 1, tree, whole);
    codes = codes.subspan(count);
  }
}

/// How far a face of a box is from that of its cells, at most.
double off(const Box& box, const Block& block, const Vector3d& low, double edge) {
  double most = 0;
  for (int i = 0; i < 3; ++i) {
    const auto at = [&](std::int64_t cells) {
      return static_cast<long double>(low(i)) +
             static_cast<long double>(edge) * static_cast<long double>(cells);
    };
    most = std::max({most, static_cast<double>(std::abs(at(block.first(i)) - box.low(i))),
                     static_cast<double>(std::abs(at(block.last(i)) - box.high(i)))});
  }
  return most;
}

}  // namespace

std::optional<Octree> octree_of(const std::vector<Box>& boxes) {
  if (boxes.size() < 2) return std::nullopt;
  Box all = boxes.front();
  for (const Box& box : boxes) all.include(box);
  const double edge = edge_of(boxes, all);
  if (!(edge > 0)) return std::nullopt;
  Vector3d origin = Vector3d::Zero();
  std::vector<Block> blocks = blocks_of(boxes, edge, origin);
  if (blocks.empty()) blocks = blocks_of(boxes, edge, origin = all.low);
  if (blocks.empty()) return std::nullopt;

  Cells first = blocks.front().first, last = blocks.front().last;
  for (const Block& block : blocks) {
    first = first.cwiseMin(block.first).eval();
    last = last.cwiseMax(block.last).eval();
  }
  for (int i = 0; i < 3; ++i) first(i) -= (first(i) % kAligned + kAligned) % kAligned;
  Octree octree{origin + edge * first.cast<double>(), edge, 0, {}, {}, 0};
  while (std::int64_t{2} << octree.depth < (last - first).maxCoeff()) ++octree.depth;
  if (octree.depth > 19) return std::nullopt;
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    const Block block{blocks[k].first - first, blocks[k].last - first};
    octree.rounding = std::max(octree.rounding, 2 * off(boxes[k], block, octree.low, edge));
  }
  const std::vector<std::uint64_t> codes = codes_of(blocks, first);
  write(codes, octree.depth, octree.tree, [&](std::uint64_t code, int level) {
    const Vector3d low = octree.low + edge * cell_of(code).cast<double>();
    octree.boxes.push_back({low, low + Vector3d::Constant(std::ldexp(edge, level))});
  });
  return octree;
}

}  // namespace vericone::simulation::certified
