// SPDX-License-Identifier: BSD-3-Clause
//
// The commands that the program `vericone` carries out itself.
#pragma once

#include <map>
#include <string>

#include "command/program.h"

namespace vericone {

/// What needs the cones and laws alone.
std::map<std::string, Command> core_commands();

/// What flies scenarios; none in a build without VERICONE_SIMULATION.
std::map<std::string, Command> simulation_commands();

}  // namespace vericone
