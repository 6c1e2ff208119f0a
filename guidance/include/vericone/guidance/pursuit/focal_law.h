// SPDX-License-Identifier: BSD-3-Clause
//
// The source's law of chapter 4: the rendezvous cone of an ellipse by its foci, (4.5)-(4.14), with its
// boundary layer (4.15)-(4.16), corrected (errata 3.4); the same cone as a polynomial, without tau; and the
// exact least sum of distances to the foci over time, for an ellipse that deforms.
#pragma once

#include <vericone/guidance/pursuit/rendezvous_law.h>
#include <Eigen/Core>
#include <array>
#include <cstdint>

namespace vericone::guidance {

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

}  // namespace vericone::guidance
