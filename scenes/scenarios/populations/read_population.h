// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "json/json_forward.h"
#include "scenarios/populations/population.h"

namespace vericone::populations {

/// A file of docs/reference/formats.md, "Populations". Throws InputError naming the file or the field.
[[nodiscard]] Population read_population(const std::string& file);

/// docs/schemas/population.schema.json.
[[nodiscard]] Json population_schema();

}  // namespace vericone::populations
