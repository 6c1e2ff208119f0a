// SPDX-License-Identifier: BSD-3-Clause
//
// The source's law of chapter 3: a UAS pursues one vehicle on the ground, (3.1)-(3.8), corrected
// (errata 3.3).
#pragma once

#include <vericone/guidance/kinematics.h>
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>

namespace vericone::guidance {

struct RendezvousGains {
  double cone = 0.5;        // K_1, 1/s
  double speed = 0.2;       // K_2, 1/s
  double reference = -0.1;  // y_1d, m^4/s^2
  double radius = 0.1;      // R, m
  double most = 10;         // m/s^2, of each component
  double singular = 0.01;   // m^4/s^2: nothing commanded where |2 V_r V_theta r^2| is below this
  bool closing = true;      // K_1 sign(-V_r), without which the UAS parks beside the vehicle (errata 3.3)
};

enum class PursuitStatus : std::uint8_t {
  steering,
  saturated,
  singular,  // the law has no command: nothing commanded, or the boundary layer's
};
[[nodiscard]] const char* to_string(PursuitStatus status);

struct PursuitCommand {
  double lateral = 0, longitudinal = 0;  // of A, at its heading + pi/2 and along it, m/s^2, saturated
  double y1 = 0, y2 = 0;                 // y_1 in the unit of its law, y_2 in m^2/s^2
  PursuitStatus status = PursuitStatus::steering;
};

/// (3.1), (3.2), and what A's accelerations change of them: y' = by_lateral a_lat + by_longitudinal a_long,
/// with (3.4) and (3.6) corrected (errata 3.3). B's accelerations change them by the opposite of A's.
struct RendezvousRates {
  double y1 = 0;  // m^4/s^2
  double y2 = 0;  // m^2/s^2
  double by_lateral1 = 0, by_longitudinal1 = 0, by_lateral2 = 0, by_longitudinal2 = 0;
};
/// `radius`: R, m. No throw. Cost: 40 ns.
[[nodiscard]] RendezvousRates rendezvous_cone(const PlanarState& state, double radius);

/// (3.7), (3.8), with the sign of -V_r on K_1. `acceleration_b`: of the vehicle, in fixed axes, m/s^2. No
/// allocation, no throw. Cost: 0.1 us.
[[nodiscard]] PursuitCommand rendezvous_law(const PlanarState& state, const Eigen::Vector2d& acceleration_b,
                                            const RendezvousGains& gains);

// The source's law of chapter 4: the rendezvous cone of an ellipse by its foci, (4.5)-(4.14), with its
// boundary layer (4.15)-(4.16), corrected (errata 3.4); the same cone as a polynomial, without tau; and the
// exact least sum of distances to the foci over time, for an ellipse that deforms.

/// A and the foci of the ellipse, in fixed axes; m, m/s, m/s^2.
struct FocalState {
  Eigen::Vector2d position = Eigen::Vector2d::Zero(), velocity = Eigen::Vector2d::Zero();  // of A
  using Two = std::array<Eigen::Vector2d, 2>;
  Two foci{Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
  Two velocities{Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
  Two accelerations{Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
  double a = 0, a_rate = 0;  // semi-major axis and its rate
};

/// source: (4.6), (4.7) with |V_theta|. polynomial: 4 V^2 [(P_1 x V)(P_2 x V) - b^2 V^2] with P_i from A to a
/// focus and V the mean of the foci's relative velocities (errata 3.4): the same number where the ellipse is
/// rigid and both foci are on one side of A's course, and with a gradient between them, where the source's
/// has none.
enum class FocalForm : std::uint8_t { source, polynomial };

/// y_1 (m^2 times the fourth power of a speed), y_2 = V^2 of (4.9) with E_c the first focus, and what changes
/// them: y' = drift + by_acceleration.a with A's acceleration a in fixed axes. The drift has the term of a'
/// that (4.11) leaves out.
struct FocalRates {
  double y1 = 0, y2 = 0;
  double drift1 = 0, drift2 = 0;  // without an acceleration of A
  Eigen::Vector2d by_acceleration1 = Eigen::Vector2d::Zero(), by_acceleration2 = Eigen::Vector2d::Zero();
  bool closing = false;  // V_r1 + V_r2 < 0, (4.8)
};
/// No allocation, no throw. Cost: 0.1 us.
[[nodiscard]] FocalRates focal_cone(const FocalState& state, FocalForm form);

/// min over t >= 0 of |P_1 + t V_1| + |P_2 + t V_2| - 2 (a + t a'), m, to rounding: negative where a straight
/// motion meets the ellipse as it deforms. Minus infinity where the ellipse grows faster than A can leave it.
/// The sum is convex in t: its slope is halved down. Cost: 1 us.
[[nodiscard]] double least_focal_sum(const FocalState& state);

struct FocalGains {
  double cone = 1;                  // K_1, 1/s; the source's is 0 where y_1 < 0
  double speed = 0.11;              // K_2, 1/s
  double reference = 0;             // y_1d, in the unit of y_1
  double most = 10;                 // m/s^2, of each component
  double singular = 10;             // |denominator| below which the boundary layer's law takes over
  double stay = 2;                  // s, for which it then stays in force
  bool layer_when_receding = true;  // also where V_r1 > 0
  // (4.15), (4.16): m/s^2 per unit of what each multiplies
  double heading = 10, sight = 0, speed_error = 0.2, distance = 0;
  double near = 5;  // m: `sight` and `distance` count beyond it
};

/// (4.14), and the boundary layer's (4.15), (4.16). No allocation, no throw.
class FocalLaw {
 public:
  FocalLaw(const FocalGains& gains, FocalForm form) : gains_(gains), form_(form) {}
  /// The command at a time that does not go back, s. `in_layer` says whether the boundary layer's law spoke.
  PursuitCommand step(const FocalState& state, double time);
  [[nodiscard]] bool in_layer() const { return in_layer_; }

 private:
  FocalGains gains_;
  FocalForm form_;
  double until_ = -1;
  bool in_layer_ = false;
};

// The altitude of a camera that keeps what it follows at a size in its picture, (4.17)-(4.24), Algorithm 2,
// corrected (errata 3.4).

struct VerticalGains {
  double size = 240, size_band = 20, size_near = 5;  // x_S: wanted, where it begins to act, where it ends, px
  double altitude = 200, altitude_band = 100;        // z: wanted and most beside it, m
  double size_p = 0.018, size_d = 0.012;             // 1/s^2 and 1/s
  double altitude_p = 0.006, altitude_d = 0.003;     // 1/s^2 and 1/s
  double lock_p = 0.84, lock_d = 0.42;               // 1/s^2 and 1/s
  double most = 10;                                  // m/s^2
  /// With the term 2 phi x_W x_S'^2 / x_S^3 that (4.23) leaves out of the inversion of (4.22).
  bool exact = true;
};

enum class VerticalMode : std::uint8_t { size, lock, altitude };
[[nodiscard]] const char* to_string(VerticalMode mode);

/// Algorithm 2 as it works (errata 3.4): outside the band of altitudes the altitude is driven; else a size
/// out of its band is driven until it is near the wanted one; then the altitude is locked. No allocation, no
/// throw.
class VerticalLaw {
 public:
  /// Throws InputError naming "most" where it is negative or no number.
  explicit VerticalLaw(const VerticalGains& gains);
  /// Acceleration up, m/s^2. size: x_S, px, and its rate; altitude, m, and its rate, up. A size of 0, of what
  /// is not in the picture, drives nothing.
  double step(double size, double size_rate, double altitude, double climb);
  [[nodiscard]] VerticalMode mode() const { return mode_; }

 private:
  VerticalGains gains_;
  VerticalMode mode_ = VerticalMode::size;
  std::optional<double> lock_;
  bool driving_ = false;
};

}  // namespace vericone::guidance
