// SPDX-License-Identifier: BSD-3-Clause
//
// Columns of numbers as planners and recorders write them: separated by commas or blanks, with a line of
// names or without, # before remarks.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

namespace vericone::scenario {

class NumberTable {
 public:
  /// Throws InputError that names the file, the line and the column.
  explicit NumberTable(const std::string& file);

  [[nodiscard]] bool named() const { return !names_.empty(); }
  [[nodiscard]] std::size_t columns() const { return columns_; }
  [[nodiscard]] const std::vector<std::vector<double>>& rows() const { return rows_; }
  /// The column that has one of these names.
  [[nodiscard]] std::optional<std::size_t> find(std::initializer_list<const char*> names) const;
  /// "track.csv: line 7": where a row stands.
  [[nodiscard]] std::string where(std::size_t row) const;
  /// All names, for refusals.
  [[nodiscard]] std::string header() const;

 private:
  std::string file_;
  std::vector<std::string> names_;
  std::size_t columns_ = 0;
  std::vector<std::vector<double>> rows_;
  std::vector<std::size_t> lines_;
};

}  // namespace vericone::scenario
