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

/// Brings each component to at most `most`, m/s^2, and says so. Throws InputError naming "most" below 0.
void saturate(PursuitCommand& command, double most);

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

}  // namespace vericone::guidance
