// SPDX-License-Identifier: BSD-3-Clause
//
// The cone's function of a direction.
#pragma once

#include <vericone/cones/planar/sector.h>

namespace vericone {

/// (5.10) itself, dimensionless, from V_r, V_theta and the angle theta of the line of sight.
[[nodiscard]] double cone_function_y(double v_r, double v_theta, double theta, double theta_b, double psi);

}  // namespace vericone
