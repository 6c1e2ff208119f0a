// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>
#include <string>

#include "output/output_options.h"

namespace vericone {

struct SimulateOptions : OutputOptions {
  SimulateOptions() { out = "out/simulate"; }
  std::string scenario;
  bool animate = false;  // also a page that shows the run over time
};

/// Carries out a scenario and writes what happened and what is proved of it. Returns the exit status: 0
/// whatever the verdict is, 130 interrupted. Throws InputError.
int run_simulate(const SimulateOptions& options, std::ostream& out);

}  // namespace vericone
