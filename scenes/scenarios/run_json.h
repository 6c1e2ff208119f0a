// SPDX-License-Identifier: BSD-3-Clause
//
// What the files of a run hold that are JSON (scenario_files.h).
#pragma once

#include <vericone/scenarios/scenario_files.h>

#include "json/json_forward.h"

namespace vericone::scenario {

/// The verdict, what is proved of every pair and of every passage.
Json proof_json(const simulation::Scenario& scenario, const simulation::Run& run);
/// What the bodies look like in their own frames.
Json shapes_json(const simulation::Scenario& scenario);
/// The outlines of the orifices, and how they move.
Json orifices_json(const simulation::Scenario& scenario);
/// Counts, verdict, times, provenance.
Json run_json(const simulation::Scenario& scenario, const simulation::Run& run, const RunOrigin& origin);

}  // namespace vericone::scenario
