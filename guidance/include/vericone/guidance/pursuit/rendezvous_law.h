// SPDX-License-Identifier: BSD-3-Clause
//
// The source's law of chapter 3: a UAS pursues one vehicle on the ground, (3.1)-(3.8), corrected
// (errata 3.3).
#pragma once

#include <vericone/guidance/kinematics.h>
#include <cstdint>

namespace vericone::guidance {

struct RendezvousGains {
  double cone = 0.5;        // K_1, 1/s
  double speed = 0.2;       // K_2, 1/s
  double reference = -0.1;  // y_1d, m^4/s^2
  double radius = 0.1;      // R, m
  double most = 10;         // m/s^2, of each component
  double singular = 0.01;   // nothing commanded where |2 V_r V_theta r^2| is below this
  bool closing = true;      // K_1 sign(-V_r), without which the UAS parks beside the vehicle (errata 2.2)
};

enum class PursuitStatus : std::uint8_t {
  steering,
  saturated,
  singular,  // the law has no command: nothing commanded, or the boundary layer's
};
[[nodiscard]] const char* to_string(PursuitStatus status);

struct PursuitCommand {
  double lateral = 0, longitudinal = 0;  // of A, m/s^2, saturated
  double y1 = 0, y2 = 0;
  PursuitStatus status = PursuitStatus::steering;
};

/// `acceleration_b`: of the vehicle, in fixed axes, m/s^2. No allocation, no throw.
[[nodiscard]] PursuitCommand rendezvous_law(const PlanarState& state, const Eigen::Vector2d& acceleration_b,
                                            const RendezvousGains& gains);

}  // namespace vericone::guidance
