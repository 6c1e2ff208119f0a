// SPDX-License-Identifier: BSD-3-Clause
//
// How guide() asks the outer loop for a correction.
#pragma once

#include <vericone/guidance/robust_law.h>

namespace vericone::guidance {

/// Standard deviations of what is measured on the plane at a (measured) state: those of (7.2), and, to first
/// order, those of position and velocity; of psi as for a ball.
[[nodiscard]] Measured deviations_on_plane(const Sight& sight, const PlanarState& state,
                                           const PlaneCone& cone);

/// u to be added to the inner loop's lateral acceleration `inner`, both within `most`. `by_lateral_a`: dy'/da
/// of the measured state, whose sign is that of b.
[[nodiscard]] RobustCorrection outer_loop(const OuterLoopOptions& outer, double z, double inner, double most,
                                          double gain, double by_lateral_a, const PlanarState& state,
                                          const PlaneCone& cone, const Measured& deviations);

}  // namespace vericone::guidance
