// SPDX-License-Identifier: BSD-3-Clause
//
// A run in words.
#pragma once

#include <vericone/scenarios/scenario_files.h>
#include <string>

namespace vericone::scenario {

/// touched or undecided where anything is; else missed, where an ordered passage is, or passed, where all
/// are; of runs without orders avoided, or none where no pair could be checked.
[[nodiscard]] std::string run_verdict(const simulation::Run& run);

/// The verdict, what is proved of every pair and of every passage, as JSON (docs/reference/scenarios.md):
/// proof.json.
[[nodiscard]] std::string proof_text(const simulation::Scenario& scenario, const simulation::Run& run);

}  // namespace vericone::scenario
