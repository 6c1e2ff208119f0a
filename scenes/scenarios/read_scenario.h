// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/scenarios/scenario_files.h>
#include <vericone/scenes/scene.h>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "json/json_forward.h"

namespace vericone::scenario {

/// What reading the file of each body found, in the order of the bodies.
using Readings = std::vector<std::optional<scenes::Reading>>;

/// Of fields that are read already. Names of files in them are relative to `folder`; `name` is the scenario's
/// where it has none.
simulation::Scenario read_scenario(const Json& fields, const std::string& name,
                                   const std::filesystem::path& folder = {}, Readings* readings = nullptr);

/// Of the file itself in JSON Schema; its $defs stand elsewhere.
Json scenario_file_schema();

}  // namespace vericone::scenario
