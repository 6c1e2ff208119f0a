// SPDX-License-Identifier: BSD-3-Clause
//
// Cells of a delimited body against the boxes and pieces of an obstacle.
#pragma once

#include <algorithm>
#include <vector>

#include "composite/state.h"

namespace vericone::composite {

struct CellPair {
  Cell cell;
  std::uint32_t node = 0;  // of the obstacle's hierarchy
  bool full = false;       // the cell is inside the body: it meets the obstacle or not, as it is
};

/// Whether the body meets the obstacle in some of the directions (none: now). `apart`: proves of a difference
/// of boxes that it does not. Cells are divided level by level, so that what can be seen coarsely is seen
/// first; a cell inside the body, or a point inside it, that surely meets a piece ends the search.
template <class Apart>
class CellSearch {
 public:
  static constexpr std::size_t kMostPairs = 400'000;

  /// `most_pairs`: of a cell and a box that are looked at. `all`: where given, three directions in each of
  /// which one cell inside the body has to meet one piece; nothing else counts.
  CellSearch(const State& state, const assembly::Directions& directions, const Apart& apart,
             std::size_t most_pairs = kMostPairs, const assembly::Directions (*all)[3] = nullptr)
      : CellSearch(state, directions, apart, most_pairs, all, nullptr, nullptr) {}

  /// On a stretch; `slabs` of it.
  CellSearch(const State& state, const Apart& apart, const Stretch& stretch, const assembly::Slabs& slabs)
      : CellSearch(state, kPlace, apart, kMostPairs, nullptr, &stretch, &slabs) {}

 private:
  static inline const assembly::Directions kPlace{};

  CellSearch(const State& state, const assembly::Directions& directions, const Apart& apart,
             std::size_t most_pairs, const assembly::Directions (*all)[3], const Stretch* stretch,
             const assembly::Slabs* slabs)
      : state_(state),
        cells_(*state.cells),
        directions_(directions),
        apart_(apart),
        most_pairs_(most_pairs),
        all_(all),
        stretch_(stretch),
        slabs_(slabs) {}

 public:
  /// `in`: they meet, interior to interior; `out`: they do not.
  Certified run() {
    later_.push_back({});
    bool open = false;
    for (std::uint32_t levels = 2; !later_.empty(); levels += 2) {
      stack_.swap(later_);
      later_.clear();
      levels_ = std::min(levels, cells_.most_levels());
      while (!stack_.empty()) {
        if (++asked_ > most_pairs_) return Certified::undecided;
        const CellPair pair = stack_.back();
        stack_.pop_back();
        const Outcome outcome = visit(pair);
        if (outcome == Outcome::met) return Certified::in;
        if (outcome == Outcome::open) open = true;
      }
    }
    return open ? Certified::undecided : Certified::out;
  }

 private:
  enum class Outcome { done, met, open };

  Outcome visit(const CellPair& pair) {
    const Hierarchy::Node& node = state_.obstacle.hierarchy().nodes()[pair.node];
    const Box cell = cells_.box(pair.cell), box = node.box();
    if (apart_(difference(cell, box))) return Outcome::done;
    const bool last = pair.cell.level == cells_.most_levels();
    if (!node.is_leaf() && (last || pair.full || size(box) >= size(cell))) {
      stack_.push_back({pair.cell, node.first + 1, pair.full});
      stack_.push_back({pair.cell, node.first, pair.full});
      return Outcome::done;
    }
    if (node.is_leaf()) {
      const Outcome outcome = against_pieces(pair, cell, node);
      if (outcome != Outcome::open) return outcome;
    }
    if (last) return Outcome::open;
    if (pair.cell.level >= levels_) {
      later_.push_back(pair);
    } else {
      cells_.divide(pair.cell, [&](const Cell& part) {
        stack_.push_back({part, pair.node, pair.full || cells_.full(part)});
      });
    }
    return Outcome::done;
  }

  /// open: some piece may be met.
  Outcome against_pieces(const CellPair& pair, const Box& cell, const Hierarchy::Node& node) {
    std::optional<assembly::Frame> own, inner;
    bool sought = false, any = false;
    for (std::uint32_t slot = node.first; slot < node.first + node.count; ++slot) {
      if (apart_(difference(cell, assembly::piece_box(state_.obstacle, slot)))) continue;
      if (!own) own = state_.frame(HullBody::box(cell.low, cell.high));
      const assembly::Core core = core_of(*own, slot, cell);
      const assembly::Gap found = gap(core);
      if (found.answer == assembly::Gap::Answer::apart) continue;
      if (pair.full && all_ != nullptr) {
        // What a cell does not meet in all directions, no part of it does.
        if (assembly::meets_all(core, *all_)) return Outcome::met;
        continue;
      }
      if (!pair.full && apart_by_quadrics(pair.cell, core)) continue;
      any = true;
      if (pair.full && found.answer == assembly::Gap::Answer::met) return Outcome::met;
      if (pair.full || all_ != nullptr) continue;
      if (!sought)
        if (const auto point = cells_.witness(pair.cell)) inner = state_.frame(HullBody({*point}));
      sought = true;
      if (!inner) continue;
      if (gap(core_of(*inner, slot, cell)).answer == assembly::Gap::Answer::met) return Outcome::met;
    }
    return any ? Outcome::open : Outcome::done;
  }

  /// A piece about a part of the body, on the stretch if there is one.
  assembly::Core core_of(const assembly::Frame& part, std::uint32_t slot, const Box& cell) const {
    assembly::Core core = assembly::piece_core(part, state_.obstacle, slot);
    if (stretch_ == nullptr) return core;
    const Stretch near =
        slabs_->clipped(*stretch_, difference(cell, assembly::piece_box(state_.obstacle, slot)));
    core.stretch(near.way(near.from), near.way(near.until));
    return core;
  }
  assembly::Gap gap(const assembly::Core& core) const {
    return assembly::gap(core, directions_,
                         stretch_ != nullptr ? core.away() : first_normal(core, directions_));
  }

  /// Whether the piece is above a plane that the quadrics hold the body below.
  bool apart_by_quadrics(const Cell& cell, const assembly::Core& core) const {
    Eigen::Vector3d normals[3];
    const int count = cells_.normals(cell, normals);
    for (int i = 0; i < count; ++i) {
      Eigen::Vector3d n = normals[i];
      // Twice, so that what rounding leaves along the ray is less than what planes are forgiven.
      if (directions_.count > 0 || stretch_ != nullptr) {
        const Eigen::Vector3d along = stretch_ != nullptr
                                          ? Eigen::Vector3d((stretch_->v_a - stretch_->v_b).normalized())
                                          : directions_.middle;
        for (int k = 0; k < 2; ++k) n -= std::max(0.0, n.dot(along)) * along;
      }
      const double length = n.norm();
      if (!(length > 0)) continue;
      n /= length;
      if (beyond_plane(core, directions_, n, cells_.room(cell, n)) > 0) return true;
    }
    return false;
  }

  const State& state_;
  const CellTree& cells_;
  const assembly::Directions& directions_;
  const Apart& apart_;
  std::vector<CellPair> stack_, later_;
  std::uint32_t levels_ = 0;
  std::size_t asked_ = 0, most_pairs_;
  const assembly::Directions (*all_)[3];
  const Stretch* stretch_;
  const assembly::Slabs* slabs_;
};

}  // namespace vericone::composite
