// SPDX-License-Identifier: BSD-3-Clause
//
// What an agent flies: a command, then the stop after it; and whether two such are apart for ever.
#pragma once

#include <array>
#include <span>

#include "solids.h"

namespace vericone::swarm {

/// From `begin` on, until the next leg begins.
struct PlanLeg {
  double begin = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero(), velocity = Eigen::Vector3d::Zero(),
                  acceleration = Eigen::Vector3d::Zero();  // m, m/s, m/s^2

  [[nodiscard]] Eigen::Vector3d at(double t) const {
    const double s = t - begin;
    return position + s * (velocity + 0.5 * s * acceleration);
  }
  [[nodiscard]] Eigen::Vector3d velocity_at(double t) const { return velocity + (t - begin) * acceleration; }
};

/// Accelerates for a step, brakes along its velocity, stays. Without a step: brakes at once.
class Plan {
 public:
  Plan() = default;
  Plan(const Eigen::Vector3d& position, const Eigen::Vector3d& velocity, const Eigen::Vector3d& acceleration,
       double seconds, double most);
  [[nodiscard]] static Plan stop(const Eigen::Vector3d& position, const Eigen::Vector3d& velocity,
                                 double most) {
    return {position, velocity, Eigen::Vector3d::Zero(), 0, most};
  }

  [[nodiscard]] std::span<const PlanLeg> legs() const { return {legs_.data(), count_}; }
  [[nodiscard]] double end() const { return legs_[count_ - 1].begin; }  // s: at rest from then on
  [[nodiscard]] const Eigen::Vector3d& last() const { return legs_[count_ - 1].position; }
  // A ball that holds all its places, m.
  [[nodiscard]] const Eigen::Vector3d& middle() const { return middle_; }
  [[nodiscard]] double radius() const { return radius_; }

 private:
  void add(double seconds, const Eigen::Vector3d& acceleration);

  std::array<PlanLeg, 3> legs_;
  std::size_t count_ = 1;
  double radius_ = 0;
  Eigen::Vector3d middle_ = Eigen::Vector3d::Zero();
};

/// Legs of two bodies over one time.
struct PairOfWays {
  std::span<const PlanLeg> first, second;
  double end = 0;  // s
};

/// m: never nearer than this in [from, to], by one plane a piece of time, the same normal throughout; pieces
/// that it does not prove are halved `halvings` times. Negative: not proved.
[[nodiscard]] double proved_gap(const Between& between, const PairOfWays& ways, double from, double to,
                                double enough, int halvings);

/// Whether both plans, begun together, are apart for ever by more than what rounding may take.
[[nodiscard]] bool apart(const Prepared& a, const Plan& of_a, const Prepared& b, const Plan& of_b);

/// m: positions are off by no more than this from the polynomials between two steps, rounding of supports
/// included, for coordinates within 1e5 m.
inline constexpr double kPadding = 1e-8;

}  // namespace vericone::swarm
