// SPDX-License-Identifier: BSD-3-Clause
#include "scenarios/number_table.h"

#include <vericone/geometry/error.h>
#include <algorithm>
#include <charconv>
#include <cmath>

#include "input/text_source.h"
#include "json/plain_text.h"

namespace vericone::scenario {
namespace {

constexpr std::size_t kMostRows = 1'000'000, kMostColumns = 64;

/// With commas what stands between them; else what stands between blanks.
std::vector<std::string> fields_of(const std::string& line) {
  const bool commas = line.find_first_of(",;") != std::string::npos;
  const char* blanks = " \t\r";
  std::vector<std::string> fields;
  std::size_t begin = 0;
  while (begin <= line.size()) {
    const std::size_t end = std::min(line.find_first_of(commas ? ",;" : blanks, begin), line.size());
    std::string field = line.substr(begin, end - begin);
    const std::size_t first = field.find_first_not_of(blanks), last = field.find_last_not_of(blanks);
    field = first == std::string::npos ? "" : field.substr(first, last - first + 1);
    if (commas || !field.empty()) fields.push_back(field);
    begin = end + 1;
  }
  // A comma at the end of all lines is usual.
  if (commas && !fields.empty() && fields.back().empty()) fields.pop_back();
  return fields;
}

std::optional<double> number_of(const std::string& text) {
  const char *first = text.data() + (text.starts_with('+') ? 1 : 0), *last = text.data() + text.size();
  double number = 0;
  const auto [end, error] = std::from_chars(first, last, number);
  if (error != std::errc() || end != last || first == last) return std::nullopt;
  return number;
}

}  // namespace

NumberTable::NumberTable(const std::string& file) : file_(plain_text(file)) {
  input::TextSource source(file, "a file of numbers in columns");
  std::string line;
  for (std::size_t number = 1; source.next_line(line); ++number) {
    if (line.size() > 1 << 16) throw InputError(file_, "line " + std::to_string(number), "shorter lines");
    line = line.substr(0, line.find('#'));
    const std::vector<std::string> fields = fields_of(line);
    if (fields.empty()) continue;
    if (columns_ == 0) {
      columns_ = fields.size();
      if (columns_ > kMostColumns)
        throw InputError(file_, std::to_string(columns_) + " columns", "at most 64");
      if (!number_of(fields.front())) {
        names_ = fields;
        continue;
      }
    }
    const std::string here = file_ + ": line " + std::to_string(number);
    if (fields.size() != columns_)
      throw InputError(here, std::to_string(fields.size()) + " numbers",
                       std::to_string(columns_) + ", as above");
    std::vector<double> row;
    for (std::size_t k = 0; k < fields.size(); ++k) {
      const auto value = number_of(fields[k]);
      if (!value || !std::isfinite(*value))
        throw InputError(here + ", " + (named() ? plain_text(names_[k]) : "column " + std::to_string(k + 1)),
                         "\"" + plain_text(fields[k].substr(0, 60)) + "\"", "a finite number");
      row.push_back(*value);
    }
    rows_.push_back(std::move(row));
    lines_.push_back(number);
    if (rows_.size() > kMostRows) throw InputError(file_, "more than 1000000 lines", "fewer");
  }
  if (rows_.empty()) throw InputError(file_, "no numbers", "a line of them, or more");
}

std::optional<std::size_t> NumberTable::find(std::initializer_list<const char*> names) const {
  for (const char* name : names)
    if (const auto it = std::find(names_.begin(), names_.end(), name); it != names_.end())
      return static_cast<std::size_t>(it - names_.begin());
  return std::nullopt;
}

std::string NumberTable::where(std::size_t row) const {
  return file_ + ": line " + std::to_string(lines_[row]);
}

std::string NumberTable::header() const {
  std::string list;
  for (const std::string& name : names_) list.append(list.empty() ? "" : ", ").append(plain_text(name));
  return list.empty() ? std::to_string(columns_) + " columns without names" : list.substr(0, 200);
}

}  // namespace vericone::scenario
