// SPDX-License-Identifier: BSD-3-Clause
//
// Tables as the commands write them: columns of numbers and of words.
#pragma once

#include <vericone/simulation/run_tables.h>
#include <cstddef>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace vericone::paper {

/// What stands for a number that does not exist.
inline constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

/// Columns by their names without units: "V_r [m/s]" is V_r. An empty cell of numbers is NaN.
struct Table {
  std::size_t rows = 0;
  std::map<std::string, std::vector<double>> numbers;
  std::map<std::string, std::vector<std::string>> words;

  /// A column of numbers; nullptr where there is none. NAME_before is the column NAME one row earlier, NaN in
  /// the first row.
  const std::vector<double>* find(const std::string& name);
  /// The rows whose word in `column`, one of words, is `word`, without that column.
  Table with(const std::string& column, const std::string& word) const;
};

Table table_of(simulation::Table table);

/// Every number of the rows of `right` that count beside the rows of `left` with the same time t (within 1e-9
/// s) and, where both have them, the same words, as "NAME.column"; NaN where there is no such row.
void put_beside(Table& left, const std::string& name, const Table& right, const std::vector<bool>& counts);

}  // namespace vericone::paper
