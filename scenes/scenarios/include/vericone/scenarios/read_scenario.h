// SPDX-License-Identifier: BSD-3-Clause
//
// Scenarios from YAML; the fields are described in docs/reference/scenarios.md.
#pragma once

#include <vericone/simulation/scenario.h>
#include <string>

namespace vericone::scenario {

/// Reads and checks a scenario, and the files it names, relative to its folder. Throws InputError naming the
/// file or the field, for example "bodies[1].shape.k". A scenario without name is called like the file.
[[nodiscard]] simulation::Scenario read_scenario(const std::string& file);

/// The same from `text`; `file` is named in errors.
[[nodiscard]] simulation::Scenario scenario_of_text(const std::string& text, const std::string& file);

}  // namespace vericone::scenario
