// SPDX-License-Identifier: BSD-3-Clause
//
// What a law is told of a measurement.
#pragma once

#include <vericone/simulation/pilot.h>

namespace vericone::simulation {

/// What the agent knows of the errors of the moment, as the law is told: of the deviations, those of the
/// measured state, since the true one is not known.
[[nodiscard]] guidance::Sight sight_of(const Sensor& sensor, const Measurement& measurement,
                                       const Draw& draw);

}  // namespace vericone::simulation
