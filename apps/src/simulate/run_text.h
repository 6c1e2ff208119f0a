// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/simulation/run.h>
#include <iosfwd>

namespace vericone::scenario {

/// What happened in a few lines: bodies, events, verdict with what is proved, `seconds` of the computation.
void print_run(const simulation::Scenario& scenario, const simulation::Run& run, double seconds,
               std::ostream& out);

}  // namespace vericone::scenario
