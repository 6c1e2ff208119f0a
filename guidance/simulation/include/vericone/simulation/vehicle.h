// SPDX-License-Identifier: BSD-3-Clause
//
// Water that moves: what a vehicle swims in, or air, which it flies in.
#pragma once

#include <vericone/simulation/curve.h>
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace vericone::simulation {

/// Horizontal, in proportion to the height above a level.
struct Shear {
  Eigen::Vector2d rate = Eigen::Vector2d::Zero();  // 1/s: of the velocity's x and y, per metre of height
  double level = 0;                                // z where it adds nothing, m
};

/// The same everywhere, smooth in time, never faster than `most`: sines whose amplitudes sum to it.
struct Gusts {
  double most = 0;          // m/s
  double shortest = 2;      // s, the shortest period
  double longest = 20;      // s, the longest
  std::uint64_t seed = 1;   // of directions, periods and phases
  bool horizontal = false;  // without a vertical part
};

/// Velocity of the water at a place and time: uniform, sheared, gusty. World z is up. Cost: 0.14 us with
/// gusts.
class Current {
 public:
  Current() = default;
  /// Throws InputError naming "uniform", "shear.rate", "shear.level", "gusts.most", "gusts.shortest" or
  /// "gusts.longest".
  explicit Current(const Eigen::Vector3d& uniform, const Shear& shear = {}, const Gusts& gusts = {});

  /// This water, and all of it moving uniformly besides, m/s.
  [[nodiscard]] Current carried(const Eigen::Vector3d& by) const;

  [[nodiscard]] Eigen::Vector3d velocity(double z, double t) const;
  /// Of a particle that stays at its height: what the gusts do, m/s^2.
  [[nodiscard]] Eigen::Vector3d acceleration(double t) const;
  /// By height, 1/s.
  [[nodiscard]] Eigen::Vector3d gradient() const { return {shear_.rate.x(), shear_.rate.y(), 0}; }
  /// Whether any of it ever moves.
  [[nodiscard]] bool moves() const { return gusts_ > 0 || !uniform_.isZero(0) || !shear_.rate.isZero(0); }
  /// The shortest period of its gusts, s; infinite without any.
  [[nodiscard]] double shortest() const { return shortest_; }
  /// No water is faster between two heights, m/s.
  [[nodiscard]] double most(double bottom, double top) const;

 private:
  struct Wave {
    Eigen::Vector3d amplitude = Eigen::Vector3d::Zero();  // m/s
    double rate = 0, phase = 0;                           // rad/s, rad
  };

  Eigen::Vector3d uniform_ = Eigen::Vector3d::Zero();
  Shear shear_;
  double gusts_ = 0;                                           // m/s
  double shortest_ = std::numeric_limits<double>::infinity();  // s
  std::array<Wave, 8> waves_;
};

// Vehicles that are not point masses: what flies a body by its own equations of motion.

/// What a law wants of a vehicle, held for a step.
struct VehicleCommand {
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();  // m/s^2, in the world; the law's
  /// Where it is to be: a point that moves with a velocity, and in how many seconds. Of laws that know one.
  struct Aim {
    Eigen::Vector3d point = Eigen::Vector3d::Zero();     // m, now
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // m/s
    double seconds = 0;
  };
  std::optional<Aim> aim;
};

/// What no motion of a vehicle exceeds: proved of its equations, or declared and kept by the vehicle.
struct VehicleLimits {
  double speed = 0;            // m/s, through the water or air
  double turn_rate = 0;        // rad/s, of its heading, mean over a beat; infinite if not limited
  double climb = 0;            // m/s
  double climb_jerk = 0;       // m/s^3, of its velocity up; infinite if not limited
  double top = 0, bottom = 0;  // z of the highest and lowest place it can be, m
};

/// The first time at which a vehicle was beyond one of its limits.
struct LimitBroken {
  double t = 0;                   // s
  std::string limit;              // "speed", "turn_rate", "climb", "top" or "bottom"
  double value = 0, allowed = 0;  // in the unit of what is limited
};

/// One under way.
class Vehicle {
 public:
  virtual ~Vehicle() = default;
  /// At the time reached.
  [[nodiscard]] virtual Motion motion() const = 0;
  /// Carries out the command until `to`, and appends its motion since `from`, the time reached, to `way`.
  virtual void advance(const VehicleCommand& command, double from, double to, std::vector<Curve>& way) = 0;
  /// Its inputs and states at the time reached, in the order and units of VehicleModel::channels().
  virtual void log(std::vector<double>& values) const = 0;
  /// Watched on every step of the solver: nothing while it keeps what VehicleModel::limits() says.
  [[nodiscard]] virtual std::optional<LimitBroken> broken() const = 0;
};

/// A kind of vehicle with its parameters.
class VehicleModel {
 public:
  virtual ~VehicleModel() = default;
  /// `start` at time t, seconds, in moving water; this model outlives it. Throws InputError naming
  /// "position", "velocity" or "rotation" for a start that the vehicle cannot be in.
  [[nodiscard]] virtual std::unique_ptr<Vehicle> launch(const Motion& start, double t,
                                                        const Current& water) const = 0;
  /// Whether water or air that moves takes it along.
  [[nodiscard]] virtual bool carried() const { return true; }
  /// Columns of what it logs, with units: "bias [rad]".
  [[nodiscard]] virtual std::vector<std::string> channels() const = 0;
  /// Of one launched with this start.
  [[nodiscard]] virtual VehicleLimits limits(const Motion& start) const = 0;
};

}  // namespace vericone::simulation
