// SPDX-License-Identifier: BSD-3-Clause
#include "scenarios/schema.h"

#include "json/json_value.h"
#include "scenarios/read_orifice.h"
#include "scenarios/read_pilot.h"
#include "scenarios/read_road.h"
#include "scenarios/read_scenario.h"
#include "scenarios/read_sensor.h"
#include "scenarios/read_vehicle.h"

namespace vericone::scenario {

Json scenario_schema() {
  Json schema = scenario_file_schema();
  for (const Json& some :
       {orifice_schemas(), vehicle_schemas(), road_schemas(), pilot_schemas(), sensor_schemas()})
    schema["$defs"].update(some);
  return schema;
}

}  // namespace vericone::scenario
