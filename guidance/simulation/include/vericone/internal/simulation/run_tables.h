// SPDX-License-Identifier: BSD-3-Clause
//
// The tables of a run one by one, and how their columns and bodies are named.
#pragma once

#include <vericone/simulation/run_tables.h>
#include <string>

namespace vericone::simulation {

/// Text as a field of a CSV file: in quotes where a comma, a quote or a new line is in it.
[[nodiscard]] std::string csv_field(const std::string& text);

/// Throws InputError naming "run" where it tells of bodies, orifices or steps that the scenario has not: it
/// is a run of another. All that takes both asks this.
void require_run_of(const Scenario& scenario, const Run& run);

/// One row a body and command time from its appearance.
[[nodiscard]] Table bodies_table(const Scenario& scenario, const Run& run);

/// One row an agent, an obstacle and a command time.
[[nodiscard]] Table encounters_table(const Scenario& scenario, const Run& run);

/// The same on all planes that were looked at.
[[nodiscard]] Table planes_table(const Scenario& scenario, const Run& run);

/// What agents with a sensor measured and made of it, beside the truth.
[[nodiscard]] Table sights_table(const Scenario& scenario, const Run& run);

/// One row an agent and a command time, of the orifice that it heads for.
[[nodiscard]] Table orifices_table(const Scenario& scenario, const Run& run);

/// What vehicles log at every command; a column for each of their channels.
[[nodiscard]] Table vehicles_table(const Scenario& scenario, const Run& run);

/// One row an event.
[[nodiscard]] Table events_table(const Scenario& scenario, const Run& run);

/// Of an event: what its value is, "m", "s" or "1", empty where it has none; and the other body's name, or
/// the orifice's, empty where only one body is concerned.
[[nodiscard]] std::string unit_of(const Scenario& scenario, const Event& event);

[[nodiscard]] std::string obstacle_of(const Scenario& scenario, const Event& event);

/// Whether its obstacle is an orifice.
[[nodiscard]] bool of_orifice(const Event& event);

}  // namespace vericone::simulation
