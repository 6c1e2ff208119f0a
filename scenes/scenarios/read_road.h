// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/simulation/scenario.h>
#include <memory>
#include <string>

#include "json/json_forward.h"

namespace vericone::scenario {

/// A road, of its fields: kind and what belongs to it; it begins at `start`, m. Throws InputError with `path`
/// before the field.
[[nodiscard]] std::shared_ptr<const simulation::Road> read_road(const Json& fields, const std::string& path,
                                                                const Eigen::Vector2d& start);
/// The fields position and road of a body into its `start` and `road`. Throws InputError with `path` before
/// the field; those of other motions are none beside a road.
void read_road(const Json& value, const std::string& path, bool planar, simulation::Body& body);

/// The $defs of their mappings in JSON Schema.
Json road_schemas();

}  // namespace vericone::scenario
