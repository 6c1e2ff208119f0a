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
/// turns the velocity without changing the speed, its longitudinal part changes the speed alone. So it lies
/// in one plane. A body slower than 1 mm/s is at rest: it has no heading to carry anything along, and from
/// then on the acceleration stays as it is in space and the body does not turn; one that brakes beyond rest
/// moves backwards until the end of the arc.
class Arc {
 public:
  /// From `start` at time `from` until `to` > from, the acceleration as it stands at `from`. dopri5 with
  /// tolerance 1e-12 m and rad a step (relative 1e-14); dense output by one step of the method, of the length
  /// needed, from the last accepted one, so of the same order. Throws InputError naming "to".
  Arc(const Motion& start, const Eigen::Vector3d& acceleration, Orientation orientation, double from,
      double to);

  [[nodiscard]] double from() const { return from_; }
  [[nodiscard]] double to() const { return to_; }
  /// from <= t <= to.
  [[nodiscard]] Motion at(double t) const;
  [[nodiscard]] Eigen::Vector3d acceleration(double t) const;
  [[nodiscard]] const Motion& start() const { return start_; }
  [[nodiscard]] const Motion& end() const { return end_; }
  [[nodiscard]] bool accelerated() const { return most_acceleration_ > 0; }

  /// Bounds over the arc: |a|, and the rate at which the body turns, rad/s; infinite where a level body turns
  /// at once (a vertical velocity, a start that was not level).
  [[nodiscard]] double most_acceleration() const { return most_acceleration_; }
  [[nodiscard]] double most_turn_rate() const { return most_turn_rate_; }
  /// Bound of |d2/dt2| of a direction that is fixed in the body, rad/s^2; infinite where it is not known
  /// (level bodies that turn, a body that comes to rest).
  [[nodiscard]] double most_turn_acceleration() const { return most_turn_acceleration_; }
  /// Angular velocity at the start and at the end, rad/s.
  [[nodiscard]] const Eigen::Vector3d& first_turn() const { return first_turn_; }
  [[nodiscard]] const Eigen::Vector3d& last_turn() const { return last_turn_; }

 private:
  /// In the plane of the arc, from its start: along and across the first velocity, metres, and the angle that
  /// the velocity has turned, rad.
  struct InPlane {
    double along = 0, across = 0, turned = 0;
  };
  struct Step {  // an accepted step of the integrator: where it began, seconds after `from`
    double begin;
    InPlane state;
  };

  void integrate();
  [[nodiscard]] InPlane in_plane(double elapsed) const;
  [[nodiscard]] double speed(double elapsed) const { return speed_ + longitudinal_ * elapsed; }
  [[nodiscard]] Eigen::Matrix3d rotation(const InPlane& state, const Eigen::Vector3d& velocity) const;
  [[nodiscard]] double turn_rate_bound() const;
  void bound_turn_acceleration();

  Motion start_, end_;
  Eigen::Vector3d acceleration_;
  Orientation orientation_;
  double from_, to_;
  // The plane: unit vectors along the velocity at the start and along the lateral acceleration.
  Eigen::Vector3d ahead_ = Eigen::Vector3d::Zero(), aside_ = Eigen::Vector3d::Zero();
  double speed_ = 0, longitudinal_ = 0, lateral_ = 0;
  double carried_ = 0;  // seconds, until when the acceleration is carried along
  InPlane last_;        // then
  double most_acceleration_ = 0, most_turn_rate_ = 0, most_turn_acceleration_ = 0;
  Eigen::Vector3d first_turn_ = Eigen::Vector3d::Zero(), last_turn_ = Eigen::Vector3d::Zero();
  // The second step and all that follow: none in most arcs, which are as short as a step of guidance.
  std::shared_ptr<const std::vector<Step>> steps_;
};

/// A body's whole motion. Arcs follow each other without gap.
class Track {
 public:
  Track(ShapeInTime shape, const Motion& start, Orientation orientation, double appears);

  /// Goes on until `to` with an acceleration as it stands now. Arcs without acceleration that follow each
  /// other are one. Throws InputError naming "to" where it is not after end().
  void advance(const Eigen::Vector3d& acceleration, double to);

  [[nodiscard]] double appears() const { return appears_; }
  [[nodiscard]] double end() const { return arcs_.empty() ? appears_ : arcs_.back().to(); }
  [[nodiscard]] const ShapeInTime& shape() const { return shape_; }
  [[nodiscard]] Orientation orientation() const { return orientation_; }
  [[nodiscard]] const std::vector<Arc>& arcs() const { return arcs_; }

  /// appears() <= t <= end().
  [[nodiscard]] Motion motion(double t) const;
  [[nodiscard]] Eigen::Vector3d acceleration(double t) const;
  /// What guidance sees at time t. Bodies that turn with their velocity do so without roll as guidance sees
  /// them, level ones too, whose slow roll in a climbing turn is left out.
  [[nodiscard]] guidance::BodyState state(double t) const;

  /// Bounds over [from, to].
  struct Bounds {
    double acceleration = 0;  // m/s^2
    double turn_rate = 0;     // rad/s
    /// Of directions fixed in the body: |d2/dt2| within arcs, and the sum of the jumps of d/dt between them.
    double turn_acceleration = 0;  // rad/s^2
    double turn_jumps = 0;         // rad/s
  };
  [[nodiscard]] Bounds bounds(double from, double to) const;

 private:
  ShapeInTime shape_;
  Motion start_;
  Orientation orientation_;
  double appears_;
  std::vector<Arc> arcs_;
};

}  // namespace vericone::simulation
