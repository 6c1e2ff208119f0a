// SPDX-License-Identifier: BSD-3-Clause
//
// Scenarios from YAML; the fields are described in docs/reference/scenarios.md.
#pragma once

#include <vericone/simulation/scenario.h>
#include <filesystem>
#include <string>

#include "input/body.h"

namespace vericone::scenario {

/// Reads and checks a scenario. Throws InputError naming the file or the field, for example
/// "bodies[1].shape.k". A scenario without name is called like the file.
simulation::Scenario read_scenario(const std::string& file);
/// `text`: what stands in the file.
simulation::Scenario scenario_of_text(const std::string& text, const std::string& file);
/// Names of files in it are relative to `folder`.
simulation::Scenario read_scenario(const Json& fields, const std::string& name,
                                   const std::filesystem::path& folder = {});

}  // namespace vericone::scenario
