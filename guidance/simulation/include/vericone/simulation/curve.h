// SPDX-License-Identifier: BSD-3-Clause
//
// What a track is made of: how a body moved over one interval of time, with bounds that proofs rest on.
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <vector>

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

// A piece of any motion, as the dense output of a solver of differential equations gives it.

/// A vector that is a polynomial of degree 5 of the time since its beginning: coefficients of 1, t, ..., t^5.
using Quintic = std::array<Eigen::Vector3d, 6>;

/// A vector at a time, in its unit, with its first two derivatives.
struct Jet {
  Eigen::Vector3d value = Eigen::Vector3d::Zero(), first = Eigen::Vector3d::Zero(),
                  second = Eigen::Vector3d::Zero();
};

/// The one that has these jets at 0 and after `duration` seconds (Hermite). Of a function with a sixth
/// derivative it is within duration^6 / 46080 times the most of that.
[[nodiscard]] Quintic quintic(const Jet& from, const Jet& to, double duration);

/// Position p(t), and rotation Exp(phi(t)) R with a rotation vector phi, both quintic.
///
/// Bounds hold for the polynomials, rounded up. A polynomial is within the hull of its Bernstein
/// coefficients, which bounds |p''|, |phi'| and |phi''|. The angular velocity is J phi', where J is the
/// integral of Exp(s phi) over s in [0, 1]: so |omega| <= |phi'|; and as J' is the integral of [omega_s]
/// Exp(s phi) with |omega_s| <= s |phi'|, |omega'| <= |phi''| + |phi'|^2 / 2, the last term gone where phi
/// keeps its direction. |d2/dt2| of a direction of the body is at most |omega|^2 + |omega'|. Cost: 0.5 us
/// to make.
class Curve : public Leg {
 public:
  /// From `from` until `to` > from; the polynomials' time begins at `from`. Throws InputError naming "to", or
  /// "curve" where a coefficient is not finite.
  Curve(const Quintic& position, const Quintic& turned, const Eigen::Matrix3d& rotation, double from,
        double to);

  /// With constant velocity and constant spin, rad/s in world axes.
  [[nodiscard]] static Curve steady(const Motion& start, const Eigen::Vector3d& spin, double from, double to);

  [[nodiscard]] Motion at(double t) const override;
  [[nodiscard]] Eigen::Vector3d acceleration(double t) const override;
  [[nodiscard]] Eigen::Vector3d turn(double t) const override;

 private:
  void bound();

  Quintic position_, turned_;
  Eigen::Matrix3d rotation_;
};

// Ways of vehicles on the ground, by formulas: lane changes and the squircle of chapters 3 and 4
// (errata 4.3).

/// Where a vehicle is at a time, with velocity and acceleration: m, m/s, m/s^2.
struct RoadPoint {
  Eigen::Vector2d position = Eigen::Vector2d::Zero(), velocity = Eigen::Vector2d::Zero(),
                  acceleration = Eigen::Vector2d::Zero();
};

class Road {
 public:
  virtual ~Road() = default;
  [[nodiscard]] virtual RoadPoint at(double t) const = 0;  // t >= 0, s
  /// Times at which the acceleration jumps, ascending, s.
  [[nodiscard]] virtual std::vector<double> jumps() const { return {}; }
};

/// Constant velocity, and pulses across it: `acceleration` to the left for `seconds`, then as much to the
/// right: acceleration seconds^2 aside. Pulses that overlap add up.
struct LaneChange {
  double at = 0, seconds = 2, acceleration = 1;  // s, s, m/s^2
};
/// Throws InputError naming "velocity" (none to change lanes of, or not finite) or "changes[i].at",
/// "...seconds",
/// "...acceleration".
[[nodiscard]] std::shared_ptr<const Road> lane_road(const Eigen::Vector2d& start,
                                                    const Eigen::Vector2d& velocity,
                                                    std::vector<LaneChange> changes);

/// Fernandez-Guasti's squircle x^2 + y^2 - s^2 x^2 y^2 / r^2 = r^2, counter-clockwise once in `period` s, by
/// the parameter p = 2 pi t / period - pi/2 (errata 4.3); moved so that it begins at `start`, the middle of
/// its southern side, to the east. r: `radius`, m; s: `squareness`, 0 (a circle) to below 1 (a square).
/// Position and both derivatives are analytic. Throws InputError naming "radius", "squareness" or "period".
[[nodiscard]] std::shared_ptr<const Road> squircle_road(const Eigen::Vector2d& start, double radius,
                                                        double squareness, double period);

/// What a body on it starts as, z = height.
[[nodiscard]] Motion start_of(const Road& road, double height);

/// The road as curves for a Track, z = height, x ahead along the velocity; the road's own time is t -
/// `begins`. Pieces from jump to jump, halved until each is within half of `error` m of the road at eight
/// places. At rest the heading is 0. Throws InputError naming "to" or
/// "error". Cost: 10 us a curve.
[[nodiscard]] std::vector<Curve> curves_of(const Road& road, double height, double from, double to,
                                           double error, double begins = 0);

}  // namespace vericone::simulation
