// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/internal/geometry/requires.h>
#include <vericone/simulation/run_tables.h>
#include <Eigen/Core>
#include <algorithm>
#include <iterator>
#include <limits>
#include <string_view>

namespace vericone::simulation {

/// "V_r [m/s]" as a column without rows.
inline Column column(std::string_view header, bool text = false) {
  const std::size_t bracket = header.find(" [");
  if (bracket == std::string_view::npos) return {std::string(header), "", text};
  return {std::string(header.substr(0, bracket)),
          std::string(header.substr(bracket + 2, header.size() - bracket - 3)), text};
}

/// Whether all commands give words in a column of this name.
inline bool is_of_words(std::string_view name) {
  constexpr std::string_view kWords[] = {"body",   "agent",        "obstacle", "orifice",
                                         "status", "outer_status", "event",    "unit"};
  return std::find(std::begin(kWords), std::end(kWords), name) != std::end(kWords);
}

/// An empty table of the columns of a header, of which those of these names hold words.
inline Table table_of(const char* name, std::string_view header) {
  Table table{name, {}};
  while (!header.empty()) {
    const std::size_t comma = std::min(header.find(','), header.size());
    const std::string_view field = header.substr(0, comma);
    table.columns.push_back(column(field, is_of_words(field)));
    header.remove_prefix(std::min(comma + 1, header.size()));
  }
  return table;
}

/// Fills one row of a table, column after column.
class Row {
 public:
  explicit Row(Table& table) : table_(table) {}
  ~Row() { VERICONE_REQUIRES(next_ == table_.columns.size()); }
  Row(const Row&) = delete;
  Row& operator=(const Row&) = delete;

  Row& text(std::string word) {
    table_.columns[next_++].words.push_back(std::move(word));
    return *this;
  }
  Row& number(double x) {
    table_.columns[next_++].numbers.push_back(x);
    return *this;
  }
  Row& vector(const Eigen::Vector3d& v) { return number(v.x()).number(v.y()).number(v.z()); }
  Row& empty(int fields = 1) {
    for (int i = 0; i < fields; ++i) {
      Column& column = table_.columns[next_++];
      if (column.text)
        column.words.emplace_back();
      else
        column.numbers.push_back(std::numeric_limits<double>::quiet_NaN());
    }
    return *this;
  }

 private:
  Table& table_;
  std::size_t next_ = 0;
};

}  // namespace vericone::simulation
