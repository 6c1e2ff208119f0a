// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/simulation/scenario.h>
#include <filesystem>

#include "json/json_forward.h"

namespace vericone {

/// The scenario of a folder that `vericone simulate` has written, from its copy there; files that it names
/// are looked for beside the original. Throws InputError naming "run" where the folder is none of a run, or
/// the field of what cannot be read.
simulation::Scenario scenario_of_run(const std::filesystem::path& folder);

/// What the page of such a folder is made of (viewer/src/data.ts): bodies with all that defines them and how
/// they look, where they were (of each at most 400 rows of bodies.csv, all digits), what laws saw, events,
/// and what is proved. Equal files give equal data. Throws InputError naming the file.
Json run_page(const std::filesystem::path& folder, const simulation::Scenario& scenario);

}  // namespace vericone
