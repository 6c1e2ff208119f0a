// SPDX-License-Identifier: BSD-3-Clause
//
// What a track is made of: how a body moved over one interval of time, with bounds that proofs rest on.
#pragma once

#include <Eigen/Core>

namespace vericone::simulation {

/// A point mass with an orientation.
struct Motion {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();      // m
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();      // m/s
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  // of the body's frame in the world
};

/// One piece of a track: an Arc (a point mass under a command) or a Curve (any motion). Seconds, metres, rad.
class Leg {
 public:
  virtual ~Leg() = default;

  [[nodiscard]] double from() const { return from_; }
  [[nodiscard]] double to() const { return to_; }
  /// from <= t <= to.
  [[nodiscard]] virtual Motion at(double t) const = 0;
  [[nodiscard]] virtual Eigen::Vector3d acceleration(double t) const = 0;
  /// Angular velocity in world axes, beyond what Orientation says; zero of arcs.
  [[nodiscard]] virtual Eigen::Vector3d turn(double t) const = 0;
  [[nodiscard]] const Motion& start() const { return start_; }
  [[nodiscard]] const Motion& end() const { return end_; }
  [[nodiscard]] bool accelerated() const { return most_acceleration_ > 0; }

  /// Bounds over the leg: |a|, and the rate at which the body turns, rad/s; infinite where a level body turns
  /// at once (a vertical velocity, a start that was not level).
  [[nodiscard]] double most_acceleration() const { return most_acceleration_; }
  [[nodiscard]] double most_turn_rate() const { return most_turn_rate_; }
  /// Bound of |d2/dt2| of a direction that is fixed in the body, rad/s^2; infinite where it is not known
  /// (level bodies that turn, a body that comes to rest).
  [[nodiscard]] double most_turn_acceleration() const { return most_turn_acceleration_; }
  /// Angular velocity at the start and at the end, rad/s.
  [[nodiscard]] const Eigen::Vector3d& first_turn() const { return first_turn_; }
  [[nodiscard]] const Eigen::Vector3d& last_turn() const { return last_turn_; }

 protected:
  Leg(double from, double to) : from_(from), to_(to) {}
  Leg(const Leg&) = default;
  Leg& operator=(const Leg&) = default;

  double from_, to_;
  Motion start_, end_;
  double most_acceleration_ = 0, most_turn_rate_ = 0, most_turn_acceleration_ = 0;
  Eigen::Vector3d first_turn_ = Eigen::Vector3d::Zero(), last_turn_ = Eigen::Vector3d::Zero();
};

}  // namespace vericone::simulation
