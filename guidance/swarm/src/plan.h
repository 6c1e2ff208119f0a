// SPDX-License-Identifier: BSD-3-Clause
//
// What an agent flies: a command, then the stop after it; and whether two such are apart for ever.
#pragma once

#include <algorithm>
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

/// Legs of a body over a time, and what it is in them: in leg k it turns from bodies[k] to bodies[k + 1] at a
/// constant rate; the last of them it remains.
struct Way {
  std::span<const PlanLeg> legs;
  const Prepared* bodies;
  std::size_t last = 0;  // of `bodies`
  double most_turn = 0;  // rad, in a leg

  [[nodiscard]] const Prepared& body(std::size_t leg) const { return bodies[std::min(leg, last)]; }
  /// Half its width along n at any time in a leg, or more. A point of the body is p.R(t)^T n along n, whose
  /// second derivative by the angle turned is at most its reach: so far it is above the chord between both
  /// ends by at most angle^2 / 8.
  [[nodiscard]] double width(std::size_t leg, const Eigen::Vector3d& n) const {
    const double begin = body(leg).width(n);
    if (leg >= last || body(leg).round) return begin;
    return std::max(begin, body(leg + 1).width(n)) + 0.125 * most_turn * most_turn * body(leg).reach;
  }
};

/// m: never nearer than this in [from, to], by one plane a piece of time, the same normal throughout; pieces
/// that it does not prove are halved `halvings` times. Negative: not proved. `hint`: tried first where it is
/// not zero, of length 1; becomes the normal that proved all, or zero.
[[nodiscard]] double proved_gap(const Way& a, const Way& b, double from, double to, double enough,
                                int halvings, Eigen::Vector3d* hint = nullptr);

/// What an agent flies, and with which attitudes: `turned` where it turns in its step, by `turn` rad.
struct Course {
  const Plan& plan;
  const Prepared* bodies;  // before, and after the step where `turn` is not 0
  double turn = 0;         // rad

  [[nodiscard]] Way way() const { return {plan.legs(), bodies, turn > 0 ? 1U : 0U, turn}; }
};

/// Whether both, begun together, are apart for ever by more than what rounding may take.
[[nodiscard]] bool apart(const Course& a, const Course& b, Eigen::Vector3d* hint = nullptr);

/// m: positions are off by no more than this from the polynomials between two steps, rounding of supports
/// included, for coordinates within 1e5 m.
inline constexpr double kPadding = 1e-8;

}  // namespace vericone::swarm
