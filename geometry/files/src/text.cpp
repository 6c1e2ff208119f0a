// SPDX-License-Identifier: BSD-3-Clause
#include "text.h"

#include <vericone/geometry/error.h>
#include <charconv>
#include <cmath>
#include <limits>

namespace vericone::files {
namespace {

template <typename T>
std::from_chars_result parse(std::string_view word, T& x) {
  if (word.starts_with('+') && !word.starts_with("+-"))
    word.remove_prefix(1);  // from_chars takes no plus sign
  auto result = std::from_chars(word.data(), word.data() + word.size(), x);
  if (result.ec != std::errc::invalid_argument && result.ptr != word.data() + word.size())
    result.ec = std::errc::invalid_argument;
  return result;
}

}  // namespace

std::optional<double> to_number(std::string_view word) {
  double x = 0;
  const auto result = parse(word, x);
  if (result.ec == std::errc()) return x;
  if (result.ec != std::errc::result_out_of_range) return std::nullopt;
  // Too small or too large: only the first has a nearest double.
  long double wide = 0;
  if (parse(word, wide).ec != std::errc() || std::abs(wide) > 1) return std::nullopt;
  return static_cast<double>(wide);
}

std::optional<std::int64_t> to_integer(std::string_view word) {
  std::int64_t x = 0;
  if (parse(word, x).ec != std::errc()) return std::nullopt;
  return x;
}

std::string_view Words::next() {
  const std::size_t begin = rest_.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return rest_ = {};
  const std::size_t end = std::min(rest_.find_first_of(kBlanks, begin), rest_.size());
  const std::string_view word = rest_.substr(begin, end - begin);
  rest_.remove_prefix(end);
  return word;
}

bool Lines::take_line(std::string_view& line) {
  if (rest_.empty()) return false;
  const char* const begin = rest_.data();
  // Once, however many carriage returns come before it.
  if (!feed_ || feed_ < begin) feed_ = begin + std::min(rest_.find('\n'), rest_.size());
  std::size_t end = std::size_t(feed_ - begin);
  if (const std::size_t cr = rest_.substr(0, end).find('\r'); cr != std::string_view::npos && cr + 1 < end)
    end = cr;
  line = rest_.substr(0, end);
  rest_.remove_prefix(std::min(end + 1, rest_.size()));
  if (++read_ % 4096 == 0) checkpoint();
  line = line.substr(0, line.find('#'));
  line = line.substr(0, line.find_last_not_of(kBlanks) + 1);
  return true;
}

bool Lines::next(bool joins_continued) {
  std::string_view line;
  while (take_line(line)) {
    number_ = read_;
    if (joins_continued && line.ends_with('\\')) {
      joined_.clear();
      do {
        joined_.append(line.substr(0, line.size() - 1)).append(" ");
      } while (take_line(line) && line.ends_with('\\'));
      joined_.append(line);
      line = joined_;
    }
    if (line.find_first_not_of(kBlanks) == std::string_view::npos) continue;
    text_ = line;
    return true;
  }
  return false;
}

double Lines::number(std::string_view word) const {
  const auto x = to_number(word);
  if (!x) source_.refuse(where() + ": " + in_quotes(word), "a number in the range of double");
  return *x;
}

std::int64_t Lines::integer(std::string_view word) const {
  const auto x = to_integer(word);
  if (!x) source_.refuse(where() + ": " + in_quotes(word), "an integer");
  return *x;
}

}  // namespace vericone::files
