// SPDX-License-Identifier: BSD-3-Clause
//
// The laws and levels of trials by their names.
#pragma once

#include <vericone/simulation/trials.h>
#include <span>
#include <string>

namespace vericone::simulation {

/// Throws InputError naming "--laws".
[[nodiscard]] TrialLaw trial_law(const std::string& name);

[[nodiscard]] std::span<const TrialLaw> all_trial_laws();

/// "7.5:15" or "x4". Throws InputError naming "--levels".
[[nodiscard]] TrialLevel trial_level(const std::string& text);

/// What fly_trial() says of a run.
[[nodiscard]] TrialOutcome outcome_of(const Scenario& scenario, const Run& run);

}  // namespace vericone::simulation
