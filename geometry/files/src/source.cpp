// SPDX-License-Identifier: BSD-3-Clause
#include "source.h"

#include <vericone/geometry/error.h>
#include <limits>

namespace vericone::files {

void Source::refuse(const std::string& value, const std::string& requirement) const {
  throw InputError(path, value, requirement);
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  std::string out = "\"";
  for (const char c : text.substr(0, kLongest)) out += c >= ' ' && c <= '~' ? c : '?';
  return out + (text.size() > kLongest ? "...\"" : "\"");
}

std::uint32_t to_index(const Source& source, std::int64_t index, const std::string& where) {
  if (index < 0 || index >= std::numeric_limits<std::uint32_t>::max())
    source.refuse(where + ": vertex index " + std::to_string(index), "the index of a vertex of the file");
  return static_cast<std::uint32_t>(index);
}

}  // namespace vericone::files
