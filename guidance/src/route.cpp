// SPDX-License-Identifier: BSD-3-Clause
//
// The search of Hart, Nilsson and Raphael (1968) on cells that are looked at when they are come to.
#include "route.h"

#include <algorithm>
#include <cmath>

namespace vericone::guidance::courses {

using Eigen::Vector3d;

namespace {

constexpr int kCellsACall = 500;
constexpr std::size_t kMostCells = 400'000;
constexpr double kCoarse = 0.4, kFine = 0.2;  // of the radius: the width of a cell
constexpr double kGreedy = 1.2;               // the way may be longer by this, and is found sooner
constexpr double kSeekAgain = 2;              // s, at least, from one search to the next
constexpr int kSightsACall = 8;               // straight lines that are tried along the way

std::uint64_t key_of(const Eigen::Matrix<int, 3, 1>& at) {
  constexpr int kMiddle = 1 << 20;
  std::uint64_t key = 0;
  for (int i = 0; i < 3; ++i)
    key = key << 21 | std::uint64_t(std::clamp(at[i] + kMiddle, 0, 2 * kMiddle - 1));
  return key;
}

}  // namespace

void Route::start(const Vector3d& goal, const Vector3d& position, double cell) {
  goal_ = goal;
  from_ = position;
  cell_ = cell;
  more_ = std::sqrt(radius_ * radius_ + 0.75 * cell_ * cell_) - radius_;
  sought_ = looking_ = true;
  nodes_.clear();
  open_ = {};
  way_.clear();
  at_ = 0;
  Node first;
  nearest_ = key_of(first.at);
  nodes_.emplace(nearest_, first);
  open_.push({left(first.at), nearest_});
}

bool Route::is_fine() const { return cell_ < 0.5 * (kCoarse + kFine) * radius_; }

void Route::advance(bool planar, const Clear& clear) {
  int looked = 0;
  while (looked < kCellsACall) {
    if (open_.empty() || nodes_.size() > kMostCells) {
      if (is_fine() || !open_.empty()) return finish(nearest_, false);
      return start(goal_, from_, kFine * radius_);  // narrow places need smaller cells
    }
    const std::uint64_t key = open_.top().key;
    open_.pop();
    Node& node = nodes_.at(key);
    if (node.done) continue;
    node.done = true;
    const Node here = node;  // others are added below
    if (left(here.at) < left(nodes_.at(nearest_).at)) nearest_ = key;
    if (left(here.at) <= 0.87 * cell_) return finish(key, true);  // half a diagonal
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dz = planar ? 0 : -1; dz <= (planar ? 0 : 1); ++dz) {
          const Index step(dx, dy, dz);
          if (step.isZero()) continue;
          const Index at = here.at + step;
          const std::uint64_t next = key_of(at);
          const auto [found, is_new] = nodes_.try_emplace(next);
          Node& neighbour = found->second;
          const double cost = here.cost + cell_ * step.cast<double>().norm();
          if (is_new) {
            neighbour.at = at;
            neighbour.blocked = !clear(center(at), center(at), more_);
            ++looked;
          } else if (neighbour.done || cost >= neighbour.cost) {
            continue;
          }
          if (neighbour.blocked) continue;
          neighbour.cost = cost;
          neighbour.before = key;
          open_.push({cost + kGreedy * left(at), next});
        }
  }
}

void Route::finish(std::uint64_t last, bool arrived) {
  looking_ = false;
  if (arrived) way_.push_back(goal_);
  const std::uint64_t first = key_of(Index::Zero());
  for (std::uint64_t key = last; key != first; key = nodes_.at(key).before)
    way_.push_back(center(nodes_.at(key).at));
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
