// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace vericone {

/// simulate, campaign, claims and figures, which need VERICONE_SIMULATION and say so without. `status`
/// becomes the exit status.
void add_simulation_commands(CLI::App& app, const std::string& command_line, int& status);

}  // namespace vericone
