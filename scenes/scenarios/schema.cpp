// SPDX-License-Identifier: BSD-3-Clause
#include "scenarios/schema.h"

#include "json/json_value.h"
#include "output/schemas.h"
#include "scenarios/parts.h"
#include "scenarios/read_scenario.h"

namespace vericone::scenario {

Json scenario_schema() {
  Json schema = scenario_file_schema();
  for (const Json& some : {shape_schemas(), orifice_schemas(), vehicle_schemas(), road_schemas(),
                           pilot_schemas(), sensor_schemas()})
    schema["$defs"].update(some);
  return input::schema_of(
      "a scenario", "vericone simulate SCENARIO.yaml, docs/reference/scenarios.md. Metres, seconds, radians.",
      std::move(schema));
}

}  // namespace vericone::scenario
