// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include "command/program.h"

namespace vericone {

/// simulate, campaign, trials, claims and figures; none in a build without VERICONE_SIMULATION.
std::map<std::string, Command> simulation_commands();

}  // namespace vericone
