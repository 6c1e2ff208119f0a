// SPDX-License-Identifier: BSD-3-Clause
#include "rows/csv_rows.h"

#include <vericone/geometry/error.h>
#include <algorithm>
#include <filesystem>
#include <fstream>

#include "json/plain_text.h"

namespace vericone::rows {
namespace {

void split(std::string_view line, std::vector<std::string_view>& cells) {
  cells.clear();
  for (;;) {
    const std::size_t comma = line.find(',');
    cells.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return;
    line.remove_prefix(comma + 1);
  }
}

constexpr std::size_t kLongestLine = std::size_t(1) << 20;  // bytes

}  // namespace

bool is_cell(std::string_view text) {
  return is_utf8(text) && !has_control_characters(text) &&
         text.find_first_of(",\"") == std::string_view::npos;
}

bool are_names(const std::vector<std::string>& columns) {
  auto sorted = columns;
  std::sort(sorted.begin(), sorted.end());
  return !columns.empty() && !columns[0].starts_with('#') && !sorted[0].empty() &&
         std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end() &&
         std::all_of(sorted.begin(), sorted.end(), is_cell);
}

void read_csv(const std::string& file, const std::function<void(const Heading&)>& begin,
              const std::function<void(const std::vector<std::string_view>& cells, std::uint64_t line,
                                       double share)>& row) {
  std::ifstream in(file, std::ios::binary);
  std::error_code error;
  const auto bytes = double(std::filesystem::file_size(file, error));
  // Read twice, so no pipe.
  if (!in || !std::filesystem::is_regular_file(file, error))
    throw InputError(plain_text(file), "no file that can be read", "a table, CSV or HDF5");
  std::vector<char> text(kLongestLine);
  std::uint64_t number = 0;
  double read = 0;
  Heading heading;
  std::vector<std::string_view> cells;
  const auto refuse = [&](const std::string& got, const std::string& requirement) {
    throw InputError(plain_text(file) + ": line " + std::to_string(number), got, requirement);
  };
  while (in.getline(text.data(), std::streamsize(text.size())) || in.gcount() > 0) {
    ++number;
    if (in.eof()) refuse("a line without an end", "a table that is not cut off");
    if (in.fail()) refuse("a line of more than 1 MiB", "a table, CSV or HDF5");
    read += double(in.gcount());
    const std::string_view line(text.data(), std::size_t(in.gcount() - 1));
    if (!is_utf8(line) || has_control_characters(line)) refuse("bytes that are no text", "CSV, or HDF5");
    if (heading.columns.empty() && line.starts_with('#')) {
      heading.comments.emplace_back(line);
      continue;
    }
    if (line.find('"') != std::string_view::npos) refuse("a quote", "cells without quotes");
    split(line, cells);
    if (!heading.columns.empty()) {
      if (cells.size() != heading.columns.size())
        refuse(std::to_string(cells.size()) + " cells", std::to_string(heading.columns.size()));
      if (number % 4096 == 0) checkpoint();
      row(cells, number, read / bytes);
      continue;
    }
    heading.columns.assign(cells.begin(), cells.end());
    if (!are_names(heading.columns)) refuse("a column without a name of its own", "a line of names");
    begin(heading);
  }
  if (in.bad()) refuse("an error of reading", "a file that can be read to its end");
  if (heading.columns.empty()) refuse("no names", "a line of the columns' names");
}

}  // namespace vericone::rows
