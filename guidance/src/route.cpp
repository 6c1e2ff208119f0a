// SPDX-License-Identifier: BSD-3-Clause
//
// The search of Hart, Nilsson and Raphael (1968) on cells that are looked at when they are come to.
#include "route.h"

#include <algorithm>
#include <cmath>

namespace vericone::guidance::courses {

using Eigen::Vector3d;

namespace {

constexpr int kCellsACall = 500, kStepsACall = 1500;
constexpr std::size_t kMostCells = 400'000;
constexpr double kCoarse = 0.4, kFine = 0.2;  // of the radius: the width of a cell
constexpr double kGreedy = 1.2;               // the way may be longer by this, and is found sooner
constexpr double kSeekAgain = 2;              // s, at least, from one search to the next
constexpr int kSightsACall = 8;               // straight lines that are tried along the way

constexpr int kMiddle = 1 << 20;

}  // namespace

std::uint64_t Cells::key_of(const Index& at) {
  std::uint64_t key = 0;
  for (int i = 0; i < 3; ++i)
    key = key << 21 | std::uint64_t(std::clamp(at[i] + kMiddle, 0, 2 * kMiddle - 1));
  return key;
}

Cells::Index Cells::at_of(std::uint64_t key) {
  Index at;
  for (int i = 2; i >= 0; --i, key >>= 21) at[i] = int(key & (2 * kMiddle - 1)) - kMiddle;
  return at;
}

Cells::Cell& Cells::at(const Index& at) {
  const Index within(at.x() & 3, at.y() & 3, at.z() & 3);
  const auto [found, is_new] = where_.try_emplace(key_of(at - within), used_);
  if (is_new) {
    if (used_ == blocks_.size()) blocks_.emplace_back();
    blocks_[used_++].fill({});
  }
  return blocks_[found->second][std::size_t(within.x() << 4 | within.y() << 2 | within.z())];
}

void Cells::clear() {
  where_.clear();
  used_ = known = 0;
}

void Route::start(const Vector3d& goal, const Vector3d& position, double cell) {
  goal_ = goal;
  from_ = position;
  cell_ = cell;
  more_ = std::sqrt(radius_ * radius_ + 0.75 * cell_ * cell_) - radius_;
  sought_ = looking_ = true;
  cells_.clear();
  open_ = {};
  way_.clear();
  at_ = 0;
  nearest_ = Cells::key_of(Index::Zero());
  cells_.at(Index::Zero()).known = true;
  open_.push({left(Index::Zero()), nearest_});
}

bool Route::is_fine() const { return cell_ < 0.5 * (kCoarse + kFine) * radius_; }

void Route::advance(bool planar, const Clear& clear) {
  int looked = 0;
  for (int step = 0; looked < kCellsACall && step < kStepsACall; ++step) {
    if (open_.empty() || cells_.known > kMostCells) {
      if (is_fine() || !open_.empty()) return finish(nearest_, false);
      return start(goal_, from_, kFine * radius_);  // narrow places need smaller cells
    }
    const std::uint64_t key = open_.top().key;
    open_.pop();
    const Index here = Cells::at_of(key);
    Cells::Cell& cell = cells_.at(here);
    if (cell.done) continue;
    cell.done = true;
    if (left(here) < left(Cells::at_of(nearest_))) nearest_ = key;
    if (left(here) <= 0.87 * cell_) return finish(key, true);  // half a diagonal
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dz = planar ? 0 : -1; dz <= (planar ? 0 : 1); ++dz) {
          const Index beside(dx, dy, dz);
          if (beside.isZero()) continue;
          const Index at = here + beside;
          Cells::Cell& neighbour = cells_.at(at);
          const double cost = cell.cost + cell_ * beside.cast<double>().norm();
          if (!neighbour.known) {
            neighbour.known = true;
            ++cells_.known;
            neighbour.blocked = !clear(center(at), center(at), more_);
            ++looked;
          } else if (neighbour.done || cost >= neighbour.cost) {
            continue;
          }
          if (neighbour.blocked) continue;
          neighbour.cost = cost;
          neighbour.before = key;
          open_.push({cost + kGreedy * left(at), Cells::key_of(at)});
        }
  }
}

void Route::finish(std::uint64_t last, bool arrived) {
  looking_ = false;
  if (arrived) way_.push_back(goal_);
  const std::uint64_t first = Cells::key_of(Index::Zero());
  for (std::uint64_t key = last; key != first; key = cells_.at(Cells::at_of(key)).before)
    way_.push_back(center(Cells::at_of(key)));
  std::reverse(way_.begin(), way_.end());
}

Vector3d Route::towards(const Vector3d& goal, const Vector3d& position, double radius, bool planar,
                        double time, const Clear& clear) {
  if (clear(position, goal, 0)) return goal;
  const bool other = !sought_ || (goal - goal_).norm() > cell_;
  if (other) {
    radius_ = radius;
    started_ = time;
    start(goal, position, kCoarse * radius);
  }
  if (looking_) advance(planar, clear);
  if (looking_ || way_.empty()) return goal;
  // The farthest in sight, by steps that grow.
  bool seen = clear(position, way_[at_], 0);
  std::size_t step = 1;
  for (int i = 0; i < kSightsACall && at_ + 1 < way_.size(); ++i) {
    const std::size_t next = std::min(at_ + step, way_.size() - 1);
    if (clear(position, way_[next], 0)) {
      at_ = next;
      seen = true;
      step *= 2;
    } else if (step == 1) {
      break;
    } else {
      step = 1;
    }
  }
  if (!seen && time - started_ > kSeekAgain) sought_ = false;  // lost: again from here
  return way_[at_];
}

}  // namespace vericone::guidance::courses
