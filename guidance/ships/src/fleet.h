// SPDX-License-Identifier: BSD-3-Clause
//
// Ships step by step: encounters and who is to do what in them, commands, and the stops that are proved.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "motion.h"

namespace vericone::ships {

/// What two ships know of their encounter: from its first risk until they are past and clear (rule 13d).
struct Watch {
  bool active = false, must_act = false;
  std::array<Encounter, 2> role{Encounter::none, Encounter::none};  // of the first ship, of the second
  std::array<State, 2> seen;                                        // what they did then
};

/// How a course passes another ship.
enum class Passing { opens, port, starboard, meets };

class Fleet {
 public:
  Fleet(const std::vector<Ship>& ships, const FleetOptions& options);

  void step();

  [[nodiscard]] double time() const { return time_; }
  [[nodiscard]] const std::vector<State>& states() const { return states_; }
  [[nodiscard]] const std::vector<std::vector<Piece>>& pieces() const { return pieces_; }
  [[nodiscard]] std::vector<PairOfShips>& pairs() { return pairs_; }
  [[nodiscard]] const FleetCounts& counts() const { return counts_; }
  [[nodiscard]] Eigen::Vector2d ground(std::size_t i) const {
    return states_[i].position + time_ * options_.current;
  }
  /// m along the line to her goal, less its length.
  [[nodiscard]] double past_goal(std::size_t i) const;

 private:
  struct Course {
    double heading = 0, speed = 0, cost = 0;
  };
  /// What a course does to another ship that keeps hers, as the domains with room tell.
  [[nodiscard]] Passing passing(std::size_t i, const State& mine, std::size_t j, const State& hers,
                                double horizon) const;
  [[nodiscard]] State on_course(std::size_t i, double heading, double speed) const;
  [[nodiscard]] Course base(std::size_t i) const;
  void watch(std::size_t pair);
  [[nodiscard]] bool must_act(std::size_t i, std::size_t j) const;
  [[nodiscard]] bool clears_by_sailing(std::size_t i, const Course& course, std::size_t j) const;
  /// nullopt: refused. `strict`: with the rules' side.
  [[nodiscard]] std::optional<double> judged(std::size_t i, const Course& course, bool strict) const;
  [[nodiscard]] static bool cheaper(const Course& p, const Course& q) { return p.cost < q.cost; }
  /// All that are considered, the cheapest first, for themselves.
  [[nodiscard]] std::vector<Course> courses(std::size_t i) const;
  void choose(std::size_t i);
  [[nodiscard]] bool offer(std::size_t i, const Course& course);
  void give_up_sides(std::size_t i);
  [[nodiscard]] bool clear_of_stops(std::size_t i, const std::vector<Piece>& plan) const;
  [[nodiscard]] bool agreed(std::size_t i) const;
  [[nodiscard]] bool near(std::size_t i, std::size_t j) const;
  [[nodiscard]] bool alone(std::size_t i) const;
  [[nodiscard]] bool apart(std::size_t i, const std::vector<Piece>& mine, std::size_t j,
                           const std::vector<Piece>& hers) const;
  [[nodiscard]] std::size_t pair_of(std::size_t i, std::size_t j) const;
  [[nodiscard]] bool obliged(std::size_t i) const;

  std::vector<Ship> ships_;
  FleetOptions options_;
  double time_ = 0;
  std::vector<State> states_;
  std::vector<Eigen::Vector2d> starts_;
  std::vector<std::vector<Piece>> pieces_, stops_, plans_;
  std::vector<std::uint8_t> offers_;
  std::vector<std::uint32_t> waited_;  // steps in a row that she stopped
  std::vector<std::uint8_t> busy_;     // has given way, or had to act
  std::vector<double> chosen_;         // rad, the last course
  std::vector<PairOfShips> pairs_;
  std::vector<Watch> watches_;
  FleetCounts counts_;
};

}  // namespace vericone::ships
