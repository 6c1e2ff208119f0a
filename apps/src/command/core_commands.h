// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include "command/program.h"

namespace vericone {

/// cone, query, accuracy, signmap, gallery and shapes: what needs the cones alone.
std::map<std::string, Command> core_commands();

}  // namespace vericone
