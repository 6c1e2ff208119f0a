// SPDX-License-Identifier: BSD-3-Clause
//
// Points as text, one a line: x y z and whatever follows, parted by blanks, commas or semicolons. What
// programs put first is understood: a line with the names of the columns, or with the number of points.
#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <utility>

#include "source.h"
#include "text.h"

namespace vericone::files {
namespace {

constexpr std::string_view kBlanksInLine = " \t\r\v\f";

std::string_view trimmed(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(kBlanksInLine), text.size()));
  return text.substr(0, text.find_last_not_of(kBlanksInLine) + 1);
}

/// The fields of a line: parted by commas or by semicolons where one stands after the first field, else by
/// blanks. Two commas have an empty field between them.
class Fields {
 public:
  explicit Fields(std::string_view line) : rest_(trimmed(line)) {
    const std::size_t at = rest_.find_first_of(",;");
    if (at != std::string_view::npos &&
        trimmed(rest_.substr(0, at)).find_first_of(kBlanksInLine) == std::string_view::npos)
      separator_ = rest_[at];
  }

  std::optional<std::string_view> next() {
    if (rest_.empty()) return std::nullopt;
    const std::size_t end =
        std::min(separator_ ? rest_.find(*separator_) : rest_.find_first_of(kBlanksInLine), rest_.size());
    const std::string_view field = trimmed(rest_.substr(0, end));
    rest_ = trimmed(rest_.substr(std::min(end + 1, rest_.size())));
    return field;
  }

 private:
  std::string_view rest_;
  std::optional<char> separator_;
};

/// Which fields are x, y and z.
using Columns = std::array<std::size_t, 3>;

std::optional<Columns> named_columns(std::string_view line) {
  constexpr std::size_t kNone = ~std::size_t{0};
  Columns columns = {kNone, kNone, kNone};
  Fields fields(line);
  for (std::size_t k = 0; const auto field = fields.next(); ++k) {
    std::string_view name = *field;
    if (name.size() == 3 && name.front() == '"' && name.back() == '"') name = name.substr(1, 1);
    if (name.size() != 1) continue;
    const int axis = std::tolower(static_cast<unsigned char>(name.front())) - 'x';
    if (axis < 0 || axis > 2) continue;
    if (columns[std::size_t(axis)] != kNone) return std::nullopt;
    columns[std::size_t(axis)] = k;
  }
  if (std::ranges::find(columns, kNone) != columns.end()) return std::nullopt;
  return columns;
}

}  // namespace

Parsed parse_xyz(const Source& source) {
  Parsed parsed{.format = "XYZ"};
  Lines lines(source);
  Columns columns = {0, 1, 2};
  std::optional<std::int64_t> count;
  bool is_first = true;  // but for comments
  while (lines.next()) {
    std::string_view line = trimmed(lines.text());
    const bool is_comment = line.starts_with("//");
    if (is_comment) line.remove_prefix(2);
    const std::string_view first = Fields(line).next().value_or("");
    if (is_first && (is_comment || !to_number(first))) {
      const auto named = named_columns(line);
      if (named) columns = *named;
      if (!named && !is_comment)
        source.refuse(lines.where() + ": " + in_quotes(line),
                      "a point x y z, or names of columns x, y and z");
      is_first = is_comment;
      continue;
    }
    if (is_comment) continue;
    const bool may_be_count = std::exchange(is_first, false);
    Eigen::Vector3d p;
    int found = 0;
    std::size_t k = 0;
    Fields fields(line);
    for (auto field = fields.next(); field && found < 3; field = fields.next(), ++k)
      for (std::size_t i = 0; i < 3; ++i)
        if (columns[i] == k) {
          p(Eigen::Index(i)) = lines.number(*field);
          ++found;
        }
    if (may_be_count && k == 1) {
      count = to_integer(first);
      if (count) continue;
    }
    if (found < 3)
      source.refuse(lines.where() + ": " + in_quotes(line), "three coordinates, perhaps more after them");
    parsed.points.push_back(p);
  }
  if (count && *count != std::int64_t(parsed.points.size()))
    source.refuse(std::to_string(parsed.points.size()) + " points",
                  "the " + std::to_string(*count) + " points that the first line claims");
  return parsed;
}

}  // namespace vericone::files
