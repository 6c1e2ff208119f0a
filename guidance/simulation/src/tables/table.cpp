// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/internal/simulation/run_tables.h>
#include <vericone/simulation/run_tables.h>
#include <cmath>

namespace vericone::simulation {

std::size_t Table::rows() const {
  if (columns.empty()) return 0;
  return columns.front().text ? columns.front().words.size() : columns.front().numbers.size();
}

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

std::string csv(const Table& table) {
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const Column& column = table.columns[i];
    const std::size_t rows = column.text ? column.words.size() : column.numbers.size();
    if (rows != table.rows())
      throw InputError("columns[" + std::to_string(i) + "]", std::to_string(rows) + " rows",
                       std::to_string(table.rows()) + ", as many as the first");
  }
  std::string text;
  const auto end_of_field = [&](std::size_t i) { text += i + 1 < table.columns.size() ? ',' : '\n'; };
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const Column& column = table.columns[i];
    text += column.unit.empty() ? column.name : column.name + " [" + column.unit + "]";
    end_of_field(i);
  }
  for (std::size_t row = 0; row < table.rows(); ++row)
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      const Column& column = table.columns[i];
      if (column.text)
        text += csv_field(column.words[row]);
      else if (!std::isnan(column.numbers[row]))
        text += to_text(column.numbers[row]);
      end_of_field(i);
    }
  return text;
}

}  // namespace vericone::simulation
