// SPDX-License-Identifier: BSD-3-Clause
#include "source.h"

#include <vericone/geometry/error.h>
#include <fstream>
#include <limits>

namespace vericone::files {

void Source::refuse(const std::string& value, const std::string& requirement) const {
  throw InputError(path, value, requirement);
}

Source load(const std::filesystem::path& path) {
  Source source{path.string(), {}};
  for (char& c : source.path)  // errors are one line
    if (static_cast<unsigned char>(c) < ' ') c = '?';
  std::error_code failure;
  const auto status = std::filesystem::status(path, failure);
  if (!std::filesystem::exists(status)) source.refuse("no such file", "the path of a file");
  if (!std::filesystem::is_regular_file(status))
    source.refuse(std::filesystem::is_directory(status) ? "a directory" : "no regular file",
                  "the path of a file");
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = in ? std::streamoff(in.tellg()) : -1;
  if (size == 0) source.refuse("an empty file", "a file with points");
  if (size > 0) {
    source.bytes.resize(std::size_t(size));
    in.seekg(0);
    in.read(source.bytes.data(), size);
  }
  if (size < 0 || !in) source.refuse("a file that cannot be read", "a readable file");
  return source;
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
