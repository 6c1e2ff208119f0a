// SPDX-License-Identifier: BSD-3-Clause
//
// What becomes of a measurement, and what a law is told of it.
#pragma once

#include <vericone/simulation/pilot.h>

namespace vericone::simulation {

/// Whether a measurement does not drop out.
[[nodiscard]] bool arrives(const Sensor& sensor, const Draw& draw);

/// What the agent knows of the errors of the moment, as the law is told: of the deviations, those of the
/// measured state, since the true one is not known.
[[nodiscard]] guidance::Sight sight_of(const Sensor& sensor, const Measurement& measurement,
                                       const Draw& draw);

}  // namespace vericone::simulation
