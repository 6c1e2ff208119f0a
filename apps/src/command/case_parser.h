// SPDX-License-Identifier: BSD-3-Clause
//
// One line of a file of cases as a JSON value.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

#include "json/json_forward.h"

namespace vericone {

/// Bytes that must be readable after a line.
inline constexpr std::size_t kCasePadding = 64;

/// Keeps its memory from line to line; not for several threads at once.
class CaseParser {
 public:
  CaseParser();
  ~CaseParser();
  CaseParser(const CaseParser&) = delete;
  CaseParser& operator=(const CaseParser&) = delete;

  /// The value of a line, whose `number` errors name, and its field `id` as written, digit for digit: a
  /// number may have more of them than a double; "null" without one. Throws InputError for what is no JSON,
  /// nested too deeply, a mapping of too many fields, or a field given twice.
  Json parse(std::string_view line, std::size_t number, std::string& id);

 private:
  struct Fast;
  std::unique_ptr<Fast> fast_;
};

/// The same by another parser, which is slower and says what is wrong; needs no bytes after the line.
Json parse_case_slowly(std::string_view line, std::size_t number, std::string& id);

}  // namespace vericone
