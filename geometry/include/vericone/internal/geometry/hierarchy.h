// SPDX-License-Identifier: BSD-3-Clause
//
// A tree of boxes over many pieces, flat in memory: what culls the pieces of meshes, clouds and maps.
#pragma once

#include <vericone/geometry/pose.h>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace vericone {

/// A binary tree of bounding boxes. The pieces themselves are elsewhere; order() says which piece stands in
/// which slot, and a leaf covers a range of slots.
class Hierarchy {
 public:
  /// 32 bytes, two in a cache line. The box is that of the pieces rounded outwards to floats.
  struct Node {
    float low[3];
    std::uint32_t first;  // inner: its children are `first` and `first + 1`; leaf: its first slot
    float high[3];
    std::uint32_t count;  // leaf: number of slots; 0 for an inner node

    [[nodiscard]] bool is_leaf() const { return count > 0; }
    [[nodiscard]] Box box() const { return {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}}; }
  };

  Hierarchy() = default;

  /// Over one box a piece, finite, low <= high. Splits by the surface area heuristic in 16 bins; the tree
  /// depends on the boxes alone. Time n log n (docs/measured/benchmarks.md), memory linear.
  explicit Hierarchy(std::span<const Box> boxes);

  /// A tree made elsewhere. Throws InputError naming "nodes" unless every slot is in exactly one leaf,
  /// children come after their parents, and `order` is a permutation. The boxes are the caller's promise.
  Hierarchy(std::vector<Node> nodes, std::vector<std::uint32_t> order);

  /// Node 0 is the root; empty where there is no piece.
  [[nodiscard]] std::span<const Node> nodes() const { return nodes_; }
  /// The piece in each slot.
  [[nodiscard]] std::span<const std::uint32_t> order() const { return order_; }
  /// Levels below the root.
  [[nodiscard]] int depth() const { return depth_; }

 private:
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
  int depth_ = 0;
};

}  // namespace vericone
