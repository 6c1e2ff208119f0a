// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/simulation/run.h>
#include <iosfwd>
#include <string>

namespace vericone::scenario {

/// What happened in a few lines: bodies, events, verdict with what is proved, `seconds` of the computation.
void print_run(const simulation::Scenario& scenario, const simulation::Run& run, double seconds,
               std::ostream& out);

/// What a pilot does, in a line.
std::string agent_text(const simulation::Scenario& scenario, const simulation::Body& body);

/// A label and what it is, in the columns of all commands.
void print_line(std::ostream& out, std::string label, const std::string& text);

}  // namespace vericone::scenario
