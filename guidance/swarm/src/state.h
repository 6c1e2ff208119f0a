// SPDX-License-Identifier: BSD-3-Clause
//
// What a swarm knows between two steps and within one.
#pragma once

#include <vericone/swarm/swarm.h>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "cells.h"
#include "plan.h"

namespace vericone::swarm {

void check(const Agent& agent, const std::string& name);
void check(const Obstacle& obstacle, const std::string& name);
void check(const SwarmOptions& options);

/// m: what is proved counts the rounding of places up to here.
inline constexpr double kFarthest = 1e5;

// Deadlocks: an agent that in kLook seconds has come nearer to its goal by less than kProgress of what it
// flies alone turns kAside rad off for kLong seconds.
inline constexpr double kLook = 2, kProgress = 0.4, kLong = 6;

struct Neighbour {
  double square;  // of the distance, m^2
  std::uint32_t index;
  bool operator<(const Neighbour& other) const {
    return square != other.square ? square < other.square : index < other.index;
  }
};

/// Agents and obstacles have numbers, those of obstacles after those of the agents.
struct Swarm::State {
  State(std::vector<Agent> given, std::vector<Obstacle> at_rest, const SwarmOptions& chosen);

  /// What an agent found of another body in its last step, for this one to try first.
  struct Known {
    std::uint32_t number = 0;
    Eigen::Vector3d plane = Eigen::Vector3d::Zero();    // normal of the velocities' plane, or zero
    Eigen::Vector3d between = Eigen::Vector3d::Zero();  // normal between what both may do, or zero
  };
  /// A body whose plane may bind, and by how much it does not.
  struct Seen {
    const Prepared* body;
    Eigen::Vector3d c, v;  // m, m/s: its centre less the agent's, the agent's velocity less its
    double share, horizon, clear;
    Known* known;
    bool taken;
    VelocityHalfSpace half_space = {};
  };
  struct Scratch {
    std::vector<Neighbour> neighbours, obstacles;
    std::vector<std::uint32_t> near;  // numbers of all that can come near, agents first
    std::size_t near_agents = 0;
    std::vector<Seen> seen;
    std::vector<Known> known;          // first those of `near`
    std::vector<std::uint32_t> slots;  // by number: where it is in `known`, from 1 on
    std::vector<VelocityHalfSpace> planes;
    std::uint64_t unsafe = 0;
  };

  [[nodiscard]] bool orca() const { return options.method == Method::orca; }
  [[nodiscard]] double now() const { return static_cast<double>(steps) * options.step; }
  void look_around();
  void gather(std::size_t i, Scratch& scratch) const;
  [[nodiscard]] static Known* known_of(std::uint32_t number, const std::vector<Known>& old, Scratch& scratch);
  void look_at(std::size_t i, Scratch& scratch) const;
  [[nodiscard]] VelocityFound best_velocity(std::size_t i, Scratch& scratch) const;
  [[nodiscard]] Eigen::Vector3d wish(std::size_t i) const;
  void ask_own_laws();
  [[nodiscard]] Eigen::Vector3d turn_towards(std::size_t i, const Eigen::Vector3d& velocity) const;
  void decide(std::size_t i, Scratch& scratch);
  [[nodiscard]] Course stop_of(std::size_t i) const { return {stops[i], bodies[i].data()}; }
  [[nodiscard]] Course plan_of(std::size_t i) const { return {plans[i], bodies[i].data(), turns[i].norm()}; }
  [[nodiscard]] bool apart_from_stops(const Course& course, Scratch& scratch) const;
  [[nodiscard]] bool agreed(std::size_t i);
  [[nodiscard]] bool hears(std::size_t i, std::size_t j) const;
  [[nodiscard]] bool outranks(std::size_t i, std::size_t j) const {
    return waited[i] != waited[j] ? waited[i] > waited[j] : i < j;
  }
  void move(std::size_t i);
  void watch(std::size_t i);
  [[nodiscard]] double to_go(std::size_t i) const;
  void check_start();

  std::vector<Agent> agents;
  std::vector<Obstacle> obstacles;
  SwarmOptions options;
  std::uint64_t steps = 0;
  SwarmCounts counts;
  std::vector<std::size_t> heading;
  std::vector<Flown> flown;
  std::vector<Scratch> rooms;

  std::vector<std::array<Prepared, 2>> bodies;  // of agents now, and after the step where they turn
  std::vector<Prepared> obstacle_bodies;
  std::vector<Prepared> roomy;      // of agents, with the room that planes keep
  std::vector<std::uint32_t> wide;  // obstacles that are asked always
  Cells obstacle_cells;
  std::vector<std::uint32_t> in_cells;             // of obstacles, by their number among the cells
  double widest_obstacle = 0, obstacle_sight = 0;  // m, reach of those in cells; as far as they have planes

  // Of this step: what each does where it gives up, what it would fly, and whether it does.
  std::vector<Plan> stops, plans;
  std::vector<Eigen::Vector3d> accelerations, turns;
  std::vector<std::uint8_t> offers, flies;
  std::vector<std::uint32_t> waited;  // steps in a row that it braked
  std::vector<std::vector<Known>> known;
  std::vector<std::uint32_t> near_agents;  // of `known`, the first
  Cells cells;
  std::vector<double> near_by;  // m, from its position, of all that it may cover by what it does now
  double farthest = 0;          // of all of these
  // Of deadlocks.
  std::vector<std::uint32_t> stuck;
  std::vector<double> left, aside_until;  // m, s
};

}  // namespace vericone::swarm
