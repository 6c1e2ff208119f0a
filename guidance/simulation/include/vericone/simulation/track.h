// SPDX-License-Identifier: BSD-3-Clause
//
// Bodies that change their shape: what they are at a time, how fast they change, and what holds all that they
// are during an interval.
#pragma once

#include <vericone/geometry/world_body.h>
#include <vericone/guidance/kinematics.h>
#include <vericone/simulation/curve.h>
#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace vericone::simulation {

/// k(t) = offset + amplitude sin(rate t + phase), or its absolute value; t in seconds of the scenario.
struct Oscillation {
  double offset = 0, amplitude = 0;
  double rate = 0, phase = 0;  // rad/s, rad
  bool absolute = false;

  [[nodiscard]] double at(double t) const;
  [[nodiscard]] double rate_at(double t) const;  // 1/s; at a corner of |...| that of the side after t
  /// Bounds of k over [from, to], widened by a few roundings.
  struct Range {
    double low, high;  // in the unit of what oscillates
  };
  [[nodiscard]] Range range(double from, double to) const;
};

/// About the origin of the body's own frame, its x axis ahead. Hulls and placed bodies: the origin is the
/// reference point.
struct RigidShape {
  WorldBody shape;
};

/// The source's conic (5.5) with the dents ahead and behind, k(t) in [0, 1].
struct DentedConic {
  double a_c = 1, b_c = 1;
  Oscillation k;
};

/// Its counterpart in space, (x/a)^2 + |(y/b)^2 + (z/c)^2 - k| <= 1: the ellipsoid (a, b, c) sqrt(1 + k)
/// delimited by the two-sheeted hyperboloid (a, b, c) sqrt(1 - k). k = 0: the ellipsoid (a, b, c).
struct DentedQuadric {
  Eigen::Vector3d semi_axes = Eigen::Vector3d::Ones();  // m
  Oscillation k;
};

/// One of these.
class ShapeInTime {
 public:
  ShapeInTime(RigidShape rigid = {}) : rigid_(std::move(rigid.shape)) {}  // NOLINT: each of these is one
  ShapeInTime(const DentedConic& conic)                                   // NOLINT
      : semi_axes_(conic.a_c, conic.b_c, 0), flat_(true), k_(conic.k) {}
  ShapeInTime(const DentedQuadric& quadric) : semi_axes_(quadric.semi_axes), k_(quadric.k) {}  // NOLINT

  /// The body where it stays as it is; null where its dents change.
  [[nodiscard]] const WorldBody* rigid() const { return rigid_ ? &*rigid_ : nullptr; }
  /// Of one with dents: how deep they are, otherwise null.
  [[nodiscard]] const Oscillation* k() const { return rigid_ ? nullptr : &k_; }
  /// Metres. Of one with dents, for k = 0: a_c, b_c and 0 in the plane.
  [[nodiscard]] const Eigen::Vector3d& semi_axes() const { return semi_axes_; }

 private:
  friend bool planar(const ShapeInTime& shape);

  std::optional<WorldBody> rigid_;
  Eigen::Vector3d semi_axes_ = Eigen::Vector3d::Zero();
  bool flat_ = false;
  Oscillation k_;
};

/// Throws InputError: "center", "a_c", "b_c", "semi_axes[i]" or "k" (values outside [0, 1] at some time).
void check(const ShapeInTime& shape);

[[nodiscard]] bool planar(const ShapeInTime& shape);

/// The largest distance (m) of a point of the body from its reference point, at any time; rounded up.
[[nodiscard]] double reach(const ShapeInTime& shape);

// How a body moved: arcs between the times at which its command changed, integrated by Boost.odeint, or
// curves that a vehicle swam or flew.

enum class Orientation : std::uint8_t {
  fixed,    // does not turn
  heading,  // carried along by the velocity without roll: defined for every direction, poles included
  level,    // x axis along the velocity, y axis level (source, (6.5)); a vertical velocity keeps the last
            // azimuth
};

/// Motion with an acceleration that is constant in the frame carried along by the velocity: its lateral part
/// turns the velocity without changing the speed, its longitudinal part changes the speed alone. So it lies
/// in one plane. A body slower than 1 mm/s is at rest: it has no heading to carry anything along, and from
/// then on the acceleration stays as it is in space and the body does not turn; one that brakes beyond rest
/// moves backwards until the end of the arc.
class Arc : public Leg {
 public:
  /// From `start` at time `from` until `to` > from, the acceleration as it stands at `from`. dopri5 with
  /// tolerance 1e-12 m and rad a step (relative 1e-14); dense output by one step of the method, of the length
  /// needed, from the last accepted one, so of the same order. Throws InputError naming "to".
  Arc(const Motion& start, const Eigen::Vector3d& acceleration, Orientation orientation, double from,
      double to);

  [[nodiscard]] Motion at(double t) const override;
  [[nodiscard]] Eigen::Vector3d acceleration(double t) const override;
  [[nodiscard]] Eigen::Vector3d turn(double) const override { return Eigen::Vector3d::Zero(); }

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

  Eigen::Vector3d acceleration_;
  Orientation orientation_;
  // The plane: unit vectors along the velocity at the start and along the lateral acceleration.
  Eigen::Vector3d ahead_ = Eigen::Vector3d::Zero(), aside_ = Eigen::Vector3d::Zero();
  double speed_ = 0, longitudinal_ = 0, lateral_ = 0;
  double carried_ = 0;  // seconds, until when the acceleration is carried along
  InPlane last_;        // then
  // The second step and all that follow: none in most arcs, which are as short as a step of guidance.
  std::shared_ptr<const std::vector<Step>> steps_;
};

/// A body's whole motion. Legs follow each other without gap; they are shared by copies of the track.
class Track {
 public:
  Track(ShapeInTime shape, const Motion& start, Orientation orientation, double appears);

  /// Goes on until `to` with an acceleration as it stands now. Arcs without acceleration that follow each
  /// other are one. Throws InputError naming "to" where it is not after end().
  void advance(const Eigen::Vector3d& acceleration, double to);

  /// Goes on along a curve from end(), where position and rotation are those reached, to 1e-12 (of 1 m and of
  /// the distance from the origin). Its velocity may be another: a blow. Throws InputError naming "from",
  /// "position" or "rotation", and "orientation" unless the track's is fixed: a curve says itself how it
  /// turns.
  void append(const Curve& curve);

  [[nodiscard]] double appears() const { return appears_; }
  [[nodiscard]] double end() const { return legs_.empty() ? appears_ : legs_.back()->to(); }
  [[nodiscard]] const ShapeInTime& shape() const { return shape_; }
  [[nodiscard]] Orientation orientation() const { return orientation_; }
  [[nodiscard]] const std::vector<std::shared_ptr<const Leg>>& legs() const { return legs_; }

  /// appears() <= t <= end().
  [[nodiscard]] Motion motion(double t) const;
  [[nodiscard]] Eigen::Vector3d acceleration(double t) const;
  /// What guidance sees at time t. Bodies that turn with their velocity do so without roll as guidance sees
  /// them, level ones too, whose slow roll in a climbing turn is left out.
  [[nodiscard]] guidance::BodyState state(double t) const;

  /// Bound of |a| over the whole way, m/s^2.
  [[nodiscard]] double most_acceleration() const;

  /// Bounds over [from, to].
  struct Bounds {
    double acceleration = 0;    // m/s^2
    double turn_rate = 0;       // rad/s
    double velocity_jumps = 0;  // m/s, their sum, between legs
    /// Of directions fixed in the body: |d2/dt2| within legs, and the sum of the jumps of d/dt between them.
    double turn_acceleration = 0;  // rad/s^2
    double turn_jumps = 0;         // rad/s
  };
  [[nodiscard]] Bounds bounds(double from, double to) const;

 private:
  ShapeInTime shape_;
  Motion start_;
  Orientation orientation_;
  double appears_;
  std::vector<std::shared_ptr<const Leg>> legs_;
};

}  // namespace vericone::simulation
