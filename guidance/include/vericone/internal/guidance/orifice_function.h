// SPDX-License-Identifier: BSD-3-Clause
//
// The function of the source's law for orifices.
#pragma once

#include <vericone/guidance/orifice_law.h>

namespace vericone::guidance {

/// (2.2): y = r^2 (V_theta^2 + V_phi^2) / V^2 - (R_B - R_A)^2, m^2, and what changes it: y' =
/// by_acceleration.a for an acceleration a of A in the world; without acceleration y stays as it is (for
/// constant velocities it is the squared miss of two points). V = 0: y as for V_r alone, no gradient.
struct OrificeFunction {
  double y = 0;
  Eigen::Vector3d by_acceleration = Eigen::Vector3d::Zero();  // m s
  double v_r = 0;                                             // m/s, negative: closing
};

[[nodiscard]] OrificeFunction orifice_function(const Cartesian<3>& motion, double opening_radius,
                                               double agent_radius);

}  // namespace vericone::guidance
