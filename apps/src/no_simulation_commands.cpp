// SPDX-License-Identifier: BSD-3-Clause
#include "commands.h"

namespace vericone {

std::map<std::string, Command> simulation_commands() { return {}; }

}  // namespace vericone
