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
  /// The column of this name; null where there is none.
  [[nodiscard]] const Column* find(const std::string& column) const;
};

/// A header "NAME [UNIT]" and a line each row. Numbers are the shortest text that reads back as the same
/// double; nothing is an empty field.
[[nodiscard]] std::string csv(const Table& table);

/// The table of such text, after lines of comment (#). Where no field of a column is a number, or its name is
/// one that all commands give words, it has words. Throws InputError naming `source` for text that is cut off
/// or no table.
[[nodiscard]] Table table_of_csv(const std::string& text, const std::string& source);

// A run as tables: columns, units and meaning are those of docs/reference/scenarios.md.

/// Those that a run has: bodies, encounters, events; planes where they are logged, sights where an agent has
/// a sensor, vehicles and orifices where there are any.
[[nodiscard]] std::vector<Table> run_tables(const Scenario& scenario, const Run& run);

}  // namespace vericone::simulation
