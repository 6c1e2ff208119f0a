// SPDX-License-Identifier: BSD-3-Clause
//
// What a scenario says of its orifices, and of those who pass through them. Throw InputError.
#pragma once

#include <vericone/simulation/scenario.h>

namespace vericone::simulation {

/// Names the field with its path: "orifices[1].name".
void check_orifices(const Scenario& scenario);

/// Names the pilot's field: "through[0]", "reference".
void check_through(const Through& through, const Body& self, const Scenario& scenario);

}  // namespace vericone::simulation
