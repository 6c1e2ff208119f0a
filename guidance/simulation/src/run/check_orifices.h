// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/simulation/scenario.h>

namespace vericone::simulation {

/// What a scenario says of its orifices. Throws InputError with the field's path: "orifices[1].name".
void check_orifices(const Scenario& scenario);

}  // namespace vericone::simulation
