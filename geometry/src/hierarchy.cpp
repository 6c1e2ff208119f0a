// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/geometry/hierarchy.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

namespace vericone {
namespace {

constexpr int kBins = 16;
constexpr std::uint32_t kMostInLeaf = 4;
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

class Builder {
 public:
  Builder(std::span<const Box> boxes, std::vector<Hierarchy::Node>& nodes, std::vector<std::uint32_t>& order)
      : nodes_(nodes), order_(order), extents_(boxes.size()), middles_(boxes.size()) {
    for (std::size_t i = 0; i < boxes.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        extents_[i].low[k] = rounded_down(boxes[i].low(k));
        extents_[i].high[k] = rounded_up(boxes[i].high(k));
        middles_[i][k] = 0.5f * extents_[i].low[k] + 0.5f * extents_[i].high[k];
      }
  }

  int build() {
    order_.resize(extents_.size());
    std::iota(order_.begin(), order_.end(), 0u);
    nodes_.reserve(extents_.size());
    nodes_.resize(1);
    struct Task {
      std::uint32_t node, first, last;
      int depth;
    };
    int deepest = 0;
    std::vector<Task> tasks{{0, 0, std::uint32_t(extents_.size()), 0}};
    while (!tasks.empty()) {
      const Task task = tasks.back();
      tasks.pop_back();
      deepest = std::max(deepest, task.depth);
      Extent all;
      for (std::uint32_t i = task.first; i < task.last; ++i) all.include(extents_[order_[i]]);
      Hierarchy::Node& node = nodes_[task.node];
      std::copy(all.low, all.low + 3, node.low);
      std::copy(all.high, all.high + 3, node.high);
      const std::uint32_t middle = split(task.first, task.last, task.depth, all);
      if (middle == task.first) {
        node.first = task.first;
        node.count = task.last - task.first;
        continue;
      }
      const auto child = static_cast<std::uint32_t>(nodes_.size());
      node.first = child;
      node.count = 0;
      nodes_.resize(nodes_.size() + 2);
      tasks.push_back({child + 1, middle, task.last, task.depth + 1});
      tasks.push_back({child, task.first, middle, task.depth + 1});
    }
    nodes_.shrink_to_fit();
    return deepest;
  }

 private:
  /// Where the second half begins after reordering, or `first` for a leaf.
  std::uint32_t split(std::uint32_t first, std::uint32_t last, int depth, const Extent& all) {
    const std::uint32_t count = last - first;
    if (count == 1) return first;
    float low[3], high[3];
    for (int k = 0; k < 3; ++k) {
      low[k] = std::numeric_limits<float>::infinity();
      high[k] = -low[k];
    }
    for (std::uint32_t i = first; i < last; ++i)
      for (int k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], middles_[order_[i]][k]);
        high[k] = std::max(high[k], middles_[order_[i]][k]);
      }
    int best_axis = -1, best_bin = 0;
    double best_cost = std::numeric_limits<double>::infinity();
    float best_scale = 0;
    if (depth < kDeepestBySurface) {
      for (int k = 0; k < 3; ++k) {
        const float scale = kBins / (high[k] - low[k]);
        if (!(high[k] > low[k]) || !std::isfinite(scale)) continue;
        Extent bins[kBins];
        std::uint32_t counts[kBins] = {};
        for (std::uint32_t i = first; i < last; ++i) {
          const int b = bin(order_[i], k, low[k], scale);
          bins[b].include(extents_[order_[i]]);
          ++counts[b];
        }
        double right_area[kBins];
        Extent right;
        for (int b = kBins - 1; b > 0; --b) {
          right.include(bins[b]);
          right_area[b] = right.half_area();
        }
        Extent left;
        std::uint32_t left_count = 0;
        for (int b = 1; b < kBins; ++b) {
          left.include(bins[b - 1]);
          left_count += counts[b - 1];
          if (left_count == 0 || left_count == count) continue;
          const double cost = left.half_area() * left_count + right_area[b] * (count - left_count);
          if (cost < best_cost) {
            best_cost = cost;
            best_axis = k;
            best_bin = b;
            best_scale = scale;
          }
        }
      }
      const double area = all.half_area();
      if (best_axis >= 0 && count <= kMostInLeaf && best_cost + kNodeCost * area >= area * count)
        return first;
    }
    const auto begin = order_.begin() + first, end = order_.begin() + last;
    if (best_axis >= 0) {
      const auto middle = std::partition(begin, end, [&](std::uint32_t i) {
        return bin(i, best_axis, low[best_axis], best_scale) < best_bin;
      });
      return first + std::uint32_t(middle - begin);
    }
    if (count <= kMostInLeaf) return first;
    // All in one place, or too deep: halve by number.
    int axis = 0;
    for (int k = 1; k < 3; ++k)
      if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
    const auto middle = begin + count / 2;
    std::nth_element(begin, middle, end, [&](std::uint32_t a, std::uint32_t b) {
      return middles_[a][axis] != middles_[b][axis] ? middles_[a][axis] < middles_[b][axis] : a < b;
    });
    return first + count / 2;
  }

  int bin(std::uint32_t piece, int axis, float low, float scale) const {
    return std::clamp(int((middles_[piece][axis] - low) * scale), 0, kBins - 1);
  }

  std::vector<Hierarchy::Node>& nodes_;
  std::vector<std::uint32_t>& order_;
  std::vector<Extent> extents_;
  std::vector<std::array<float, 3>> middles_;
};

}  // namespace

Hierarchy::Hierarchy(std::span<const Box> boxes) {
  if (boxes.empty()) return;
  depth_ = Builder(boxes, nodes_, order_).build();
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
      require(node.first > i && node.first + 1 < nodes_.size() && level[node.first] < 0 &&
                  level[node.first + 1] < 0,
              "children of node " + std::to_string(i), "children after their one parent");
      level[node.first] = level[node.first + 1] = level[i] + 1;
    }
  }
  require(depth_ <= kDeepest, "a tree of " + std::to_string(depth_) + " levels", "at most 120 levels");
  require(slots == order_.size(), std::to_string(slots) + " slots in leaves", "each slot in one leaf");
}

}  // namespace vericone
