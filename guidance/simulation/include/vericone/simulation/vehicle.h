// SPDX-License-Identifier: BSD-3-Clause
//
// Vehicles that are not point masses: what flies a body by its own equations of motion.
#pragma once

#include <vericone/simulation/current.h>
#include <vericone/simulation/curve.h>
#include <vericone/simulation/leg.h>
#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace vericone::simulation {

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
