// SPDX-License-Identifier: BSD-3-Clause
//
// The kinds of pilots that a file can ask for; each refers to the pilot given.
#pragma once

#include <vericone/simulation/pilot.h>

namespace vericone::simulation {

std::shared_ptr<const PilotModel> law_pilot(const Pilot& pilot);
std::shared_ptr<const PilotModel> guarded_pilot(const Pilot& pilot);
/// Requires pilot.through.
std::shared_ptr<const PilotModel> through_pilot(const Pilot& pilot);

}  // namespace vericone::simulation
