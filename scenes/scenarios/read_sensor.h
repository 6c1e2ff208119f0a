// SPDX-License-Identifier: BSD-3-Clause
//
// What a pilot measures, filters and corrects: docs/reference/scenarios.md.
#pragma once

#include <vericone/simulation/scenario.h>
#include <string>

#include "json/json_forward.h"

namespace vericone::scenario {

/// All throw InputError naming the field.
simulation::Sensor read_sensor(const Json& value, const std::string& path);
void read_estimator(const Json& value, const std::string& path, simulation::Pilot& pilot);
guidance::PlaneFilterOptions read_filter(const Json& value, const std::string& path);
guidance::OuterLoopOptions read_outer_loop(const Json& value, const std::string& path);

/// The $defs of their mappings in JSON Schema.
Json sensor_schemas();

}  // namespace vericone::scenario
