// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>
#include <string>

namespace vericone {

struct SimulateOptions {
  std::string scenario;
  std::string out = "out/simulate";
  bool figures = true;
  bool animate = false;  // also a page that shows the run over time
  bool quiet = false;
  bool json = false;
  std::string command_line;
};

/// Carries out a scenario and writes what happened and what is proved of it. Returns the exit status: 0
/// whatever the verdict is, 130 interrupted. Throws InputError.
int run_simulate(const SimulateOptions& options, std::ostream& out);

}  // namespace vericone
