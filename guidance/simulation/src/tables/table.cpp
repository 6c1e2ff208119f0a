// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/internal/simulation/run_tables.h>
#include <vericone/simulation/run_tables.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include "tables/rows.h"

namespace vericone::simulation {
namespace {

/// Reads rows of fields off a text.
class Fields {
 public:
  Fields(std::string_view text, const std::string& source) : left_(text), source_(source) {
    while (left_.starts_with('#')) take_line();
  }

  [[nodiscard]] bool at_end() const { return left_.empty(); }
  /// Whether the last row ended with a line break.
  [[nodiscard]] bool whole() const { return whole_; }

  std::vector<std::string> row() {
    std::vector<std::string> fields;
    whole_ = false;
    while (!left_.empty()) {
      if (fields.empty() && take_break()) return fields;
      fields.push_back(left_.starts_with('"') ? quoted() : plain());
      if (take_break() || left_.empty()) return fields;
      left_.remove_prefix(1);  // the comma
      if (left_.empty() || left_.front() == '\n' || left_.front() == '\r') {
        fields.emplace_back();
        take_break();
        return fields;
      }
    }
    return fields;
  }

 private:
  bool take_break() {
    const std::size_t length =
        left_.starts_with("\r\n") ? 2 : left_.starts_with('\n') || left_.starts_with('\r');
    left_.remove_prefix(length);
    whole_ = whole_ || length > 0;
    return length > 0;
  }
  void take_line() {
    left_.remove_prefix(std::min(left_.find_first_of("\r\n"), left_.size()));
    take_break();
  }
  std::string plain() {
    const std::string_view field = left_.substr(0, left_.find_first_of(",\r\n"));
    left_.remove_prefix(field.size());
    return std::string(field);
  }
  std::string quoted() {
    std::string field;
    for (left_.remove_prefix(1); !left_.empty(); left_.remove_prefix(1)) {
      if (left_.front() == '"') {
        left_.remove_prefix(1);
        if (!left_.starts_with('"')) {
          if (!left_.empty() && left_.find_first_of(",\r\n") != 0) refuse("',' expected after '\"'");
          return field;
        }
      }
      field += left_.front();
    }
    refuse("unexpected end of data");
  }
  [[noreturn]] void refuse(const char* value) const {
    throw InputError(source_, value, "a table of comma-separated fields");
  }

  std::string_view left_;
  const std::string& source_;
  bool whole_ = false;
};

/// NaN of an empty field; nothing where it is no number.
std::optional<double> number_of(std::string_view field) {
  double x = std::numeric_limits<double>::quiet_NaN();
  if (field.empty()) return x;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), x);
  if (error != std::errc() || end != field.data() + field.size()) return std::nullopt;
  return x;
}

/// The columns of a header, without rows.
Table header_of(const std::vector<std::string>& fields, const std::string& source) {
  Table table;
  std::string list;
  bool sound = !fields.empty();
  for (const std::string& field : fields) {
    table.columns.push_back(column(field));
    table.columns.back().text = is_of_words(table.columns.back().name);
    list.append(list.empty() ? "['" : ", '").append(field).append("'");
    const std::string& name = table.columns.back().name;
    sound = sound && !name.empty() && table.find(name) == &table.columns.back();
  }
  if (!sound)
    throw InputError(source, fields.empty() ? "no columns" : "columns " + list + "]",
                     "a table whose first line names its columns, each by another name");
  return table;
}

/// The words of a column become its numbers, unless none is one.
void take_numbers(Column& column, const std::string& source) {
  std::size_t no_number = column.words.size();
  bool any = false;
  for (std::size_t row = 0; row < column.words.size(); ++row) {
    const std::optional<double> x = number_of(column.words[row]);
    column.numbers.push_back(x.value_or(std::numeric_limits<double>::quiet_NaN()));
    any = any || !std::isnan(column.numbers.back());
    if (!x) no_number = std::min(no_number, row);
  }
  column.text = no_number < column.words.size();
  if (column.text && any)
    throw InputError(source,
                     "'" + column.words[no_number] + "' in row " + std::to_string(no_number + 1) +
                         ", column " + column.name,
                     "a number like others of the column, or empty");
  (column.text ? column.numbers.clear() : column.words.clear());
}

}  // namespace

std::size_t Table::rows() const {
  if (columns.empty()) return 0;
  return columns.front().text ? columns.front().words.size() : columns.front().numbers.size();
}

const Column* Table::find(const std::string& name_of_column) const {
  const auto found = std::find_if(columns.begin(), columns.end(),
                                  [&](const Column& column) { return column.name == name_of_column; });
  return found == columns.end() ? nullptr : &*found;
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

Table table_of_csv(const std::string& text, const std::string& source) {
  Fields fields(text, source);
  Table table = header_of(fields.row(), source);
  const std::size_t count = table.columns.size();
  std::size_t rows = 0;
  while (!fields.at_end()) {
    std::vector<std::string> row = fields.row();
    ++rows;
    if (row.size() != count)
      throw InputError(source,
                       "row " + std::to_string(rows) + " of " + std::to_string(row.size()) + " fields",
                       "a table whose rows have " + std::to_string(count) + " fields, one for each column");
    for (std::size_t i = 0; i < count; ++i) table.columns[i].words.push_back(std::move(row[i]));
  }
  if (!fields.whole())
    throw InputError(source, "no line break after row " + std::to_string(rows),
                     "a whole table: this one may be cut off");
  for (Column& column : table.columns)
    if (!column.text) take_numbers(column, source);
  return table;
}

}  // namespace vericone::simulation
