// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/scenarios/read_scenario.h>
#include <filesystem>
#include <string>

#include "json/json_forward.h"

namespace vericone::scenario {

/// Of fields that are read already. Names of files in them are relative to `folder`; `name` is the scenario's
/// where it has none.
simulation::Scenario read_scenario(const Json& fields, const std::string& name,
                                   const std::filesystem::path& folder = {});

}  // namespace vericone::scenario
