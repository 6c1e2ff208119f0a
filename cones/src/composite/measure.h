// SPDX-License-Identifier: BSD-3-Clause
//
// The least time, or the least distance, over all parts of two bodies: what both questions share. Parts are
// looked at in the order of what they could give at best.
#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <vector>

#include "assembly/contact.h"
#include "composite/pieces.h"

namespace vericone::composite {

/// A number and where it is attained, in the obstacle's frame.
struct Found {
  double least = std::numeric_limits<double>::infinity(), most = least, best = least;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();    // of the obstacle
  Eigen::Vector3d other = Eigen::Vector3d::UnitX();   // contact: the normal; distance: the agent's point
  double time = 0;                                    // distance: when
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();  // of the plane that proves `least`
  std::uint32_t agent_slot = 0, slot = 0;
};

/// When the agent meets the obstacle; times in multiples of 1 / scale.
class ContactMeasure {
 public:
  ContactMeasure(const State& state, const Eigen::Vector3d& w)
      : state_(state),
        slabs_(state.zero, difference(state.agent_bounds(), state.obstacle.bounds()), w),
        d_(w / slabs_.scale()) {}

  double scale() const { return slabs_.scale(); }
  double of_box(const Box& difference) const {
    return slabs_.enter(difference.low.data(), difference.high.data());
  }
  /// `exact_time`: asked where doubles do not tell when.
  using Seconds = std::optional<std::pair<double, double>>;
  Found of_piece(const assembly::Frame& frame, const assembly::Core& core, double limit,
                 const std::function<Seconds()>& exact_time = {}) const;
  /// What the plane with unit normal n says at least, see beyond_plane().
  double by_plane(const assembly::Core& core, const Eigen::Vector3d& n, double room) const {
    const double above = beyond_plane(core, {}, n, room),
                 closing = n.dot(d_) + 8 * assembly::kUlp * d_.norm();
    if (!(above > 0)) return 0;
    return closing > 0 ? above / closing * (1 - 8 * assembly::kUlp) : std::numeric_limits<double>::infinity();
  }

 private:
  const State& state_;
  assembly::Slabs slabs_;
  Eigen::Vector3d d_;
};

/// How near the agent comes from now on; w may be zero.
class MissMeasure {
 public:
  MissMeasure(const State& state, const Eigen::Vector3d& w, double tolerance);
  MissMeasure(const MissMeasure&) = delete;  // the test refers to the directions

  double of_box(const Box& difference) const {
    return std::max(0.0, test_.distance(difference.low, difference.high));
  }
  Found of_piece(const assembly::Frame& frame, const assembly::Core& core, double limit) const;
  double by_plane(const assembly::Core& core, const Eigen::Vector3d& n, double room) const {
    return beyond_plane(core, directions_, n, room);
  }

 private:
  const State& state_;
  double speed_, tolerance_;
  assembly::Directions directions_;
  assembly::BoxTest<assembly::RayResidual> test_;
};

/// Over all cells and pieces: until the least and the most are `width` apart, no cell is left to be divided,
/// or the search has become too long; what is returned is proved in any case. `known`: begins with it.
/// `least` is infinite where nothing is attained.
template <class Measure>
class CellDescent {
 public:
  static constexpr std::size_t kMostItems = 100'000, kMoreItems = 2'000;

  CellDescent(const State& state, const Measure& measure, double width, const Found& known)
      : state_(state), cells_(*state.cells), measure_(measure), width_(width), best_(known) {}

  Found run() {
    push_node({}, 0, 0, false);
    std::size_t stop = kMostItems;
    for (std::size_t asked = 0; !heap_.empty(); ++asked) {
      std::pop_heap(heap_.begin(), heap_.end(), later);
      const Item item = heap_.back();
      heap_.pop_back();
      if (item.least >= best_.most) break;
      if (item.least >= best_.most - width_ || asked > stop) return ended(item);
      if (item.slot == kNone) {
        divide_node(item);
      } else if (item.cell.level < cells_.most_levels()) {
        divide_cell(item);
      } else {
        // The least is what it is now; for the most it is worth looking a little further.
        if (std::isinf(floor_)) place_ = item;
        floor_ = std::min(floor_, item.least);
        stop = std::min(stop, asked + kMoreItems);
      }
    }
    if (std::isinf(best_.most) && std::isfinite(floor_)) return ended(place_);
    best_.least = std::min(best_.most, floor_);
    return best_;
  }

 private:
  static constexpr std::uint32_t kNone = ~0u;
  struct Item {
    double least;
    Cell cell;
    std::uint32_t node, slot;  // slot: of a piece, then the node does not count
    bool full;                 // the cell is inside the body
  };
  static bool later(const Item& a, const Item& b) { return a.least > b.least; }

  void push(const Item& item) {
    if (!(item.least < best_.most)) return;
    heap_.push_back(item);
    std::push_heap(heap_.begin(), heap_.end(), later);
  }
  void push_node(const Cell& cell, std::uint32_t node, double at_least, bool full) {
    const Box box = state_.obstacle.hierarchy().nodes()[node].box();
    const double least = measure_.of_box(difference(cells_.box(cell), box));
    push({std::max(least, at_least), cell, node, kNone, full});
  }
  void push_piece(const Cell& cell, std::uint32_t slot, double at_least, bool full) {
    const Box box = cells_.box(cell);
    const double rough = measure_.of_box(difference(box, assembly::piece_box(state_.obstacle, slot)));
    if (!(rough < best_.most)) return;
    const assembly::Frame frame = state_.frame(HullBody::box(box.low, box.high));
    const assembly::Core core = assembly::piece_core(frame, state_.obstacle, slot);
    Found found = measure_.of_piece(frame, core, best_.most);
    if (std::isinf(found.least)) return;
    if (!full) {
      found.least =
          std::max(found.least, measure_.by_plane(core, found.normal, cells_.room(cell, found.normal)));
      if (!(found.least < best_.most)) return;
    }
    if (full) {
      take(found, slot);
      // Known as well as can be: nothing is learned from its parts.
      if (std::isfinite(found.most)) {
        floor_ = std::min(floor_, found.least);
        return;
      }
    } else if (const auto point = cells_.witness(cell)) {
      const assembly::Frame inner = state_.frame(HullBody({*point}));
      take(measure_.of_piece(inner, assembly::piece_core(inner, state_.obstacle, slot), best_.most), slot);
    }
    push({std::max({found.least, rough, at_least}), cell, 0, slot, full});
  }

  void divide_node(const Item& item) {
    const Hierarchy::Node& node = state_.obstacle.hierarchy().nodes()[item.node];
    const Box cell = cells_.box(item.cell);
    const bool divide_cell =
        !item.full && item.cell.level < cells_.most_levels() && size(cell) > size(node.box());
    if (divide_cell) {
      cells_.divide(item.cell,
                    [&](const Cell& part) { push_node(part, item.node, item.least, cells_.full(part)); });
    } else if (!node.is_leaf()) {
      push_node(item.cell, node.first, item.least, item.full);
      push_node(item.cell, node.first + 1, item.least, item.full);
    } else {
      for (std::uint32_t slot = node.first; slot < node.first + node.count; ++slot)
        push_piece(item.cell, slot, item.least, item.full);
    }
  }
  void divide_cell(const Item& item) {
    cells_.divide(item.cell, [&](const Cell& part) {
      push_piece(part, item.slot, item.least, item.full || cells_.full(part));
    });
  }

  /// Of something that is part of the body.
  void take(const Found& found, std::uint32_t slot) {
    if (!(found.most < best_.most)) return;
    best_ = found;
    best_.slot = slot;
  }
  Found ended(const Item& item) {
    if (std::isinf(best_.most)) take_place(std::isfinite(floor_) ? place_ : item);
    best_.least = std::min(item.least, floor_);
    return best_;
  }
  /// Where it may be, if it is at all.
  void take_place(const Item& item) {
    const double least = item.least;
    const Box box = cells_.box(item.cell);
    const assembly::Frame frame = state_.frame(HullBody::box(box.low, box.high));
    const std::uint32_t slot =
        item.slot != kNone ? item.slot : state_.obstacle.hierarchy().nodes()[item.node].first;
    const double never = std::numeric_limits<double>::infinity();
    best_ = measure_.of_piece(frame, assembly::piece_core(frame, state_.obstacle, slot), never);
    best_.best = least;
    best_.most = never;
    best_.slot = slot;
  }

  const State& state_;
  const CellTree& cells_;
  const Measure& measure_;
  double width_;
  double floor_ = std::numeric_limits<double>::infinity();  // of what is not looked at again
  Found best_;
  Item place_{};  // that of the first cell that could not be divided
  std::vector<Item> heap_;
};

}  // namespace vericone::composite
