// SPDX-License-Identifier: BSD-3-Clause
//
// The JSON schema of scenarios, from the tables of their fields.
#pragma once

#include "json/json_forward.h"

namespace vericone::scenario {

/// docs/schemas/scenario.schema.json.
Json scenario_schema();

}  // namespace vericone::scenario
