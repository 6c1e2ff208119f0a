// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace vericone::rows {

/// The lines of comment before the names of the columns (with their #), and these as they stand.
struct Heading {
  std::vector<std::string> comments, columns;
};

/// Text that can stand between two commas.
bool is_cell(std::string_view text);

/// Each a cell, none empty or twice, and no comment.
bool are_names(const std::vector<std::string>& columns);

/// Reads a table as the commands write it, row by row, in memory that does not grow: cells without quotes,
/// separated by commas, lines of at most 1 MiB. Gives the heading to `begin`, then each row with the number
/// of its line and the share of the file's bytes up to there. Throws InputError naming the file and the line.
void read_csv(const std::string& file, const std::function<void(const Heading&)>& begin,
              const std::function<void(const std::vector<std::string_view>& cells, std::uint64_t line,
                                       double share)>& row);

}  // namespace vericone::rows
