// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/internal/geometry/hierarchy.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

namespace vericone {
namespace {

constexpr int kBins = 16;
constexpr std::uint32_t kMostInLeaf = 4;
/// Nodes of as many pieces ask whether to stop: all that is below one of fewer takes a millisecond.
constexpr std::size_t kWorthAsking = 4096;
/// Beyond this the pieces are halved by number, whatever their places: no tree is deeper than twice this.
constexpr int kDeepestBySurface = 48;
/// What those who descend leave room for.
constexpr int kDeepest = 120;
/// What looking at a node costs in units of looking at a piece.
constexpr double kNodeCost = 0.3;

struct Extent {
  float low[3], high[3];
  Extent() {
    std::fill(low, low + 3, std::numeric_limits<float>::infinity());
    std::fill(high, high + 3, -std::numeric_limits<float>::infinity());
  }
  void include(const Extent& other) {
    for (int k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], other.low[k]);
      high[k] = std::max(high[k], other.high[k]);
    }
  }
  double half_area() const {
    const double x = double(high[0]) - low[0], y = double(high[1]) - low[1], z = double(high[2]) - low[2];
    return x < 0 ? 0 : x * y + y * z + z * x;
  }
};

float rounded_down(double x) {
  const float f = static_cast<float>(x);
  return double(f) > x ? std::nextafterf(f, -std::numeric_limits<float>::infinity()) : f;
}
float rounded_up(double x) { return -rounded_down(-x); }

/// A piece on its way through the tree; moved about itself, since looking it up elsewhere costs more.
struct Item {
  Extent extent;
  std::uint32_t piece;
  float middle(int axis) const { return 0.5f * extent.low[axis] + 0.5f * extent.high[axis]; }
};

class Builder {
 public:
  Builder(std::span<const Box> boxes, std::vector<Hierarchy::Node>& nodes)
      : nodes_(nodes), items_(boxes.size()) {
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      if (i % kWorthAsking == 0) checkpoint();
      items_[i].piece = static_cast<std::uint32_t>(i);
      for (int k = 0; k < 3; ++k) {
        items_[i].extent.low[k] = rounded_down(boxes[i].low(k));
        items_[i].extent.high[k] = rounded_up(boxes[i].high(k));
      }
    }
  }

  /// The depth of the tree.
  int build() {
    nodes_.reserve(items_.size());
    nodes_.resize(1);
    struct Task {
      std::uint32_t node, first, last;
      int depth;
    };
    int deepest = 0;
    std::vector<Task> tasks{{0, 0, std::uint32_t(items_.size()), 0}};
    while (!tasks.empty()) {
      const Task task = tasks.back();
      tasks.pop_back();
      deepest = std::max(deepest, task.depth);
      const std::span<Item> items(items_.data() + task.first, task.last - task.first);
      if (items.size() >= kWorthAsking) checkpoint();
      Extent all, middles;
      for (const Item& item : items) {
        all.include(item.extent);
        for (int k = 0; k < 3; ++k) {
          middles.low[k] = std::min(middles.low[k], item.middle(k));
          middles.high[k] = std::max(middles.high[k], item.middle(k));
        }
      }
      Hierarchy::Node& node = nodes_[task.node];
      std::copy(all.low, all.low + 3, node.low);
      std::copy(all.high, all.high + 3, node.high);
      const auto half = static_cast<std::uint32_t>(split(items, task.depth, all, middles));
      if (half == 0) {
        node.first = task.first;
        node.count = task.last - task.first;
        continue;
      }
      const auto child = static_cast<std::uint32_t>(nodes_.size());
      node.first = child;
      node.count = 0;
      nodes_.resize(nodes_.size() + 2);
      tasks.push_back({child + 1, task.first + half, task.last, task.depth + 1});
      tasks.push_back({child, task.first, task.first + half, task.depth + 1});
    }
    nodes_.shrink_to_fit();
    return deepest;
  }

  std::vector<std::uint32_t> order() const {
    std::vector<std::uint32_t> pieces;
    pieces.reserve(items_.size());
    for (const Item& item : items_) pieces.push_back(item.piece);
    return pieces;
  }

 private:
  /// Where bins begin along an axis, and how wide they are.
  struct Binning {
    float low = 0, scale = 0;  // scale 0: nothing to part along this axis
    int operator()(float middle) const { return std::clamp(int((middle - low) * scale), 0, kBins - 1); }
  };
  struct Bin {
    Extent extent;
    std::uint32_t count = 0;
  };

  /// How many of the items are in the first half after reordering; 0 for a leaf.
  static std::size_t split(std::span<Item> items, int depth, const Extent& all, const Extent& middles) {
    if (items.size() == 1) return 0;
    Binning binning[3];
    int best_axis = -1, best_bin = 0;
    if (depth < kDeepestBySurface) {
      double best_cost = std::numeric_limits<double>::infinity();
      Bin bins[3][kBins];
      for (int k = 0; k < 3; ++k) {
        const float scale = kBins / (middles.high[k] - middles.low[k]);
        if (middles.high[k] > middles.low[k] && std::isfinite(scale)) binning[k] = {middles.low[k], scale};
      }
      for (const Item& item : items)
        for (int k = 0; k < 3; ++k) {
          Bin& bin = bins[k][binning[k](item.middle(k))];
          bin.extent.include(item.extent);
          ++bin.count;
        }
      for (int k = 0; k < 3; ++k) {
        double right_area[kBins];
        Extent right;
        for (int b = kBins - 1; b > 0; --b) {
          right.include(bins[k][b].extent);
          right_area[b] = right.half_area();
        }
        Extent left;
        std::size_t left_count = 0;
        for (int b = 1; b < kBins; ++b) {
          left.include(bins[k][b - 1].extent);
          left_count += bins[k][b - 1].count;
          if (left_count == 0 || left_count == items.size()) continue;
          const double cost =
              left.half_area() * double(left_count) + right_area[b] * double(items.size() - left_count);
          if (cost < best_cost) {
            best_cost = cost;
            best_axis = k;
            best_bin = b;
          }
        }
      }
      const double area = all.half_area();
      if (best_axis >= 0 && items.size() <= kMostInLeaf &&
          best_cost + kNodeCost * area >= area * double(items.size()))
        return 0;
    }
    if (best_axis >= 0) {
      const auto half = std::partition(items.begin(), items.end(), [&](const Item& item) {
        return binning[best_axis](item.middle(best_axis)) < best_bin;
      });
      return std::size_t(half - items.begin());
    }
    if (items.size() <= kMostInLeaf) return 0;
    // All in one place, or too deep: halve by number.
    int axis = 0;
    for (int k = 1; k < 3; ++k)
      if (middles.high[k] - middles.low[k] > middles.high[axis] - middles.low[axis]) axis = k;
    const auto half = items.begin() + std::ptrdiff_t(items.size() / 2);
    std::nth_element(items.begin(), half, items.end(), [&](const Item& a, const Item& b) {
      const float x = a.middle(axis), y = b.middle(axis);
      return x != y ? x < y : a.piece < b.piece;
    });
    return items.size() / 2;
  }

  std::vector<Hierarchy::Node>& nodes_;
  std::vector<Item> items_;
};

}  // namespace

Hierarchy::Hierarchy(std::span<const Box> boxes) {
  if (boxes.empty()) return;
  Builder builder(boxes, nodes_);
  depth_ = builder.build();
  order_ = builder.order();
}

Hierarchy::Hierarchy(std::vector<Node> nodes, std::vector<std::uint32_t> order)
    : nodes_(std::move(nodes)), order_(std::move(order)) {
  const auto require = [](bool holds, const std::string& value, const char* requirement) {
    if (!holds) throw InputError("nodes", value, requirement);
  };
  std::vector<bool> piece_seen(order_.size(), false);
  for (const std::uint32_t i : order_) {
    require(i < order_.size() && !piece_seen[i], "piece " + std::to_string(i), "in one slot each");
    piece_seen[i] = true;
  }
  if (nodes_.empty()) {
    require(order_.empty(), "none", "one node at least for any piece");
    return;
  }
  std::vector<int> level(nodes_.size(), -1);
  std::vector<bool> covered(order_.size(), false);
  level[0] = 0;
  std::size_t slots = 0;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    require(level[i] >= 0, "node " + std::to_string(i) + " of no parent", "children after their one parent");
    depth_ = std::max(depth_, level[i]);
    if (node.is_leaf()) {
      require(node.first <= order_.size() && node.count <= order_.size() - node.first,
              "slots from " + std::to_string(node.first), "slots that exist");
      for (std::uint32_t s = node.first; s < node.first + node.count; ++s) {
        require(!covered[s], "slot " + std::to_string(s) + " twice", "each slot in one leaf");
        covered[s] = true;
        ++slots;
      }
    } else {
      require(node.first > i && std::size_t{node.first} + 1 < nodes_.size() && level[node.first] < 0 &&
                  level[node.first + 1] < 0,
              "children of node " + std::to_string(i), "children after their one parent");
      level[node.first] = level[node.first + 1] = level[i] + 1;
    }
  }
  require(depth_ <= kDeepest, "a tree of " + std::to_string(depth_) + " levels", "at most 120 levels");
  require(slots == order_.size(), std::to_string(slots) + " slots in leaves", "each slot in one leaf");
}

}  // namespace vericone
