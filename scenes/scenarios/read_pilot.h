// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/simulation/scenario.h>

#include "json/json_forward.h"

namespace vericone::scenario {

/// Throws InputError with `path` before the field, also for fields that the law does not read.
simulation::Pilot read_pilot(const Json& value, const std::string& path, bool planar);

/// The $defs of their mappings in JSON Schema.
Json pilot_schemas();

}  // namespace vericone::scenario
