// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/internal/simulation/flying_pilot.h>

namespace vericone::simulation {

/// Not everything is seen by it.
[[nodiscard]] bool sees_in_part(const Sensor& sensor);

/// Whether the sensor sees a body that is there: within its range and view and, if others can hide it, its
/// centre or one of its extremes across the line of sight not behind any. A placed body that does not move, a
/// map, need only be within range.
[[nodiscard]] bool in_sight(const Sensor& sensor, const Instant& now, std::size_t agent, std::size_t body);

}  // namespace vericone::simulation
