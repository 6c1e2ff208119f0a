// SPDX-License-Identifier: BSD-3-Clause
//
// What is proved of all pairs of a swarm, one block of time after the other.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "plan.h"

namespace vericone::swarm {

/// Agents and obstacles, whose numbers come after those of the agents.
class BlockProof {
 public:
  BlockProof(const std::vector<Agent>& agents, const std::vector<Obstacle>& obstacles, int threads,
             double from = 0);

  /// What all agents flew in a step from `t` on.
  void add(const std::vector<Flown>& flown, double t, double step);
  /// Proves what was added since the last time, and forgets it. Memory: what a block needs.
  void prove(double until);

  [[nodiscard]] const std::vector<TouchedPair>& touched() const { return touched_; }
  [[nodiscard]] const std::vector<TouchedPair>& undecided() const { return undecided_; }
  /// m: the other pairs were never nearer, proved.
  [[nodiscard]] double least_distance() const { return least_; }

 private:
  /// Of a pair in a block: what a plane a piece of time proves, m; not positive: open.
  struct Bound {
    double gap;
    std::size_t a, b;
    bool operator<(const Bound& other) const {
      return gap != other.gap ? gap < other.gap : std::pair(a, b) < std::pair(other.a, other.b);
    }
  };
  struct Ball {
    Eigen::Vector3d middle;
    double radius;
  };
  [[nodiscard]] Ball swept(std::size_t i, double until) const;
  [[nodiscard]] Bound bound(std::size_t a, std::size_t b, double until) const;
  [[nodiscard]] simulation::Track track(std::size_t i, double until) const;
  void settle(std::vector<Bound> bounds, double until);
  [[nodiscard]] bool have_met(std::size_t a, std::size_t b) const;

  [[nodiscard]] Way way(std::size_t i) const;
  [[nodiscard]] bool turning_of(std::size_t i) const { return i < agents_ && turning_[i]; }

  std::vector<Solid> solids_, now_;  // when the block began, and now
  std::vector<bool> turning_;        // of agents
  // Of each: what it is, or where it turns what it is at the beginning of each leg and at the last one's end.
  std::vector<std::vector<Prepared>> bodies_;
  std::vector<std::vector<Eigen::Vector3d>> turns_;  // of those that turn, in each leg, rad
  std::size_t agents_;
  int threads_;
  double from_ = 0;                            // s, of the block
  std::vector<std::vector<PlanLeg>> legs_;     // of each, times of the flight
  std::vector<std::vector<std::size_t>> met_;  // partners above that a body has touched
  std::vector<TouchedPair> touched_, undecided_;
  double least_;
};

}  // namespace vericone::swarm
