// SPDX-License-Identifier: BSD-3-Clause
//
// A table of named columns: what runs and campaigns say, for files and for arrays.
#pragma once

#include <vericone/simulation/run.h>
#include <cstddef>
#include <string>
#include <vector>

namespace vericone::simulation {

/// Numbers, or words: the other list stays empty.
struct Column {
  std::string name;  // "V_r"
  std::string unit;  // "m/s"; empty: none
  bool text = false;
  std::vector<double> numbers = {};  // in that unit; NaN: nothing
  std::vector<std::string> words = {};
};

/// Columns of one length.
struct Table {
  std::string name;  // "bodies"
  std::vector<Column> columns;

  [[nodiscard]] std::size_t rows() const;
};

/// Text as a field of a CSV file: in quotes where a comma, a quote or a new line is in it.
[[nodiscard]] std::string csv_field(const std::string& text);

/// A header "NAME [UNIT]" and a line each row. Numbers are the shortest text that reads back as the same
/// double; nothing is an empty field.
[[nodiscard]] std::string csv(const Table& table);

// A run as tables: columns, units and meaning are those of docs/reference/scenarios.md.

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

/// Those that a run has: bodies, encounters, events; planes where they are logged, sights where an agent has
/// a sensor, vehicles and orifices where there are any.
[[nodiscard]] std::vector<Table> run_tables(const Scenario& scenario, const Run& run);

/// Of an event: what its value is, "m", "s" or "1", empty where it has none; and the other body's name, or
/// the orifice's, empty where only one body is concerned.
[[nodiscard]] std::string unit_of(const Scenario& scenario, const Event& event);
[[nodiscard]] std::string obstacle_of(const Scenario& scenario, const Event& event);
/// Whether its obstacle is an orifice.
[[nodiscard]] bool of_orifice(const Event& event);

}  // namespace vericone::simulation
