// SPDX-License-Identifier: BSD-3-Clause
//
// How a body moved: arcs between the times at which its command changed, integrated by Boost.odeint.
#pragma once

#include <vericone/guidance/body_state.h>
#include <vericone/simulation/shape_in_time.h>
#include <cstdint>
#include <memory>
#include <vector>

namespace vericone::simulation {

enum class Orientation : std::uint8_t {
  fixed,    // does not turn
  heading,  // carried along by the velocity without roll: defined for every direction, poles included
  level,    // x axis along the velocity, y axis level (source, (6.5)); a vertical velocity keeps the last
            // azimuth
};

/// A point mass with an orientation.
struct Motion {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  // of the body's frame in the world
};

/// Motion with an acceleration that is constant in the frame carried along by the velocity: its lateral part
/// turns the velocity without changing the speed, its longitudinal part changes the speed alone. A body at
/// rest is accelerated in the fixed direction.
class Arc {
 public:
  /// From `start` at time `from` until `to` > from, the acceleration as it stands at `from`. Dense output of
  /// dopri5 with absolute and relative tolerance 1e-11.
  Arc(const Motion& start, const Eigen::Vector3d& acceleration, Orientation orientation, double from,
      double to);

  double from() const { return from_; }
  double to() const { return to_; }
  /// from <= t <= to.
  Motion at(double t) const;
  Eigen::Vector3d acceleration(double t) const;
  const Motion& end() const { return end_; }

  /// Bounds over the arc: |a|, and the rate at which the body turns, rad/s.
  double most_acceleration() const { return most_acceleration_; }
  double most_turn_rate() const { return most_turn_rate_; }

 private:
  struct Step;  // an accepted step of the integrator with its dense output
  Motion start_, end_;
  Eigen::Vector3d acceleration_;
  Orientation orientation_;
  double from_, to_;
  double most_acceleration_ = 0, most_turn_rate_ = 0;
  std::shared_ptr<const std::vector<Step>> steps_;  // none without acceleration: a straight line
};

/// A body's whole motion. Arcs follow each other without gap.
class Track {
 public:
  Track(ShapeInTime shape, const Motion& start, Orientation orientation, double appears);

  /// Goes on until `to` with an acceleration as it stands now.
  void advance(const Eigen::Vector3d& acceleration, double to);

  double appears() const { return appears_; }
  double end() const { return arcs_.empty() ? appears_ : arcs_.back().to(); }
  const ShapeInTime& shape() const { return shape_; }
  Orientation orientation() const { return orientation_; }
  const std::vector<Arc>& arcs() const { return arcs_; }

  /// appears() <= t <= end().
  Motion motion(double t) const;
  Eigen::Vector3d acceleration(double t) const;
  /// What guidance sees at time t.
  guidance::BodyState state(double t) const;

  /// Bounds over [from, to].
  struct Bounds {
    double acceleration = 0;  // m/s^2
    double turn_rate = 0;     // rad/s
  };
  Bounds bounds(double from, double to) const;

 private:
  ShapeInTime shape_;
  Motion start_;
  Orientation orientation_;
  double appears_;
  std::vector<Arc> arcs_;
};

}  // namespace vericone::simulation
