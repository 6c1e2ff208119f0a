// SPDX-License-Identifier: BSD-3-Clause
//
// Orifices, and the laws that take a pilot through them.
#pragma once

#include <vericone/simulation/scenario.h>
#include <filesystem>
#include <string>

#include "json/json_forward.h"

namespace vericone::scenario {

/// Names of meshes are relative to `folder`.
simulation::MovingOrifice read_orifice(const Json& value, const std::string& path,
                                       const std::filesystem::path& folder);

/// Fields of a pilot whose law is one of orifices.

/// The $defs of their mappings in JSON Schema.
Json orifice_schemas();

}  // namespace vericone::scenario
