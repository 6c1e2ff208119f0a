// SPDX-License-Identifier: BSD-3-Clause
//
// Lines, words and numbers of text files.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "source.h"

namespace vericone::files {

inline constexpr std::string_view kBlanks = " \t\r\n\v\f";

/// The whole word as a number, correctly rounded, whatever the locale; "nan" and "inf" in any case are
/// numbers, what exceeds the range of double is not.
std::optional<double> to_number(std::string_view word);
std::optional<std::int64_t> to_integer(std::string_view word);

/// The words of a text, split at blanks (and at line ends where the text has any).
class Words {
 public:
  explicit Words(std::string_view text) : rest_(text) {}

  /// Empty when there is none left.
  std::string_view next();
  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
};

/// The lines of a file that hold anything besides a comment (from '#' to the end), numbered as in the file.
/// They end with a line feed, a carriage return, or both.
class Lines {
 public:
  /// From byte `from`, `before` lines down.
  explicit Lines(const Source& source, std::size_t from = 0, std::size_t before = 0)
      : source_(source), rest_(std::string_view(source.bytes).substr(from)), read_(before) {}

  /// A line that ends in a backslash goes on in the next one (OBJ).
  bool next(bool joins_continued = false);

  std::string_view text() const { return text_; }
  std::string_view rest() const { return rest_; }
  std::size_t read() const { return read_; }  // lines so far

  /// "line 12", for messages.
  std::string where() const { return "line " + std::to_string(number_); }

  double number(std::string_view word) const;
  std::int64_t integer(std::string_view word) const;

 private:
  bool take_line(std::string_view& line);

  const Source& source_;
  std::string_view rest_, text_;
  const char* feed_ = nullptr;  // the next line feed, or the end
  std::string joined_;
  std::size_t number_ = 0, read_ = 0;
};

}  // namespace vericone::files
