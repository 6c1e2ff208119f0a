// SPDX-License-Identifier: BSD-3-Clause
//
// What flies a body by its own equations of motion, and in what water: docs/reference/scenarios.md.
#pragma once

#include <vericone/simulation/scenario.h>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "json/json_forward.h"

namespace vericone::scenario {

/// The vehicle, and the shape that it gives its body where the scenario gives none: a fish has one. Both
/// throw InputError with `path` before the field.
struct VehicleRead {
  std::shared_ptr<const simulation::VehicleModel> model;
  std::optional<simulation::ShapeInTime> shape;
};
VehicleRead read_vehicle(const Json& value, const std::string& path, bool shape_given);

/// `seed`: of the gusts.
simulation::Current read_current(const Json& value, const std::string& path, std::uint64_t seed);

/// The $defs of their mappings in JSON Schema.
Json vehicle_schemas();

}  // namespace vericone::scenario
