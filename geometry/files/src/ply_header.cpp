// SPDX-License-Identifier: BSD-3-Clause
#include "ply_header.h"

#include <map>

#include "text.h"

namespace vericone::files {
namespace {

/// Longer headers than this are no headers.
constexpr int kMostHeaderLines = 10'000;

std::optional<PlyType> to_type(std::string_view name) {
  static const std::map<std::string_view, PlyType> names = {
      {"char", PlyType::int8},      {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
      {"uint8", PlyType::uint8},    {"short", PlyType::int16},     {"int16", PlyType::int16},
      {"ushort", PlyType::uint16},  {"uint16", PlyType::uint16},   {"int", PlyType::int32},
      {"int32", PlyType::int32},    {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
      {"float", PlyType::float32},  {"float32", PlyType::float32}, {"double", PlyType::float64},
      {"float64", PlyType::float64}};
  const auto it = names.find(name);
  return it == names.end() ? std::nullopt : std::optional(it->second);
}

/// What ends the lines of the header: a carriage return alone in files that begin so. After the header a
/// line feed may be data.
char line_end(std::string_view bytes) {
  const std::size_t at = bytes.find_first_of("\r\n");
  return at != std::string_view::npos && bytes[at] == '\r' && !bytes.substr(at + 1).starts_with('\n') ? '\r'
                                                                                                      : '\n';
}

class HeaderReader {
 public:
  explicit HeaderReader(const Source& source)
      : source_(source), rest_(source.bytes), end_(line_end(source.bytes)) {}

  PlyHeader read() {
    if (!next_line() || line_ != "ply") refuse("the word ply");
    bool has_format = false;
    while (next_line()) {
      Words words(line_);
      const std::string_view keyword = words.next();
      if (keyword == "end_header") {
        if (!has_format) refuse("a line with the format before it");
        header_.size = source_.bytes.size() - rest_.size();
        return header_;
      }
      if (keyword == "format") {
        read_format(words);
        has_format = true;
      } else if (keyword == "element") {
        read_element(words);
      } else if (keyword == "property") {
        read_property(words);
      } else if (keyword != "comment" && keyword != "obj_info" && !keyword.empty()) {
        refuse("a header line: format, element, property, comment, obj_info or end_header");
      }
    }
    source_.refuse("a header without end", "a file whose header ends with end_header");
  }

 private:
  bool next_line() {
    const std::size_t end = rest_.find(end_);
    if (end == std::string_view::npos || ++number_ > kMostHeaderLines) return false;
    line_ = rest_.substr(0, end);
    line_ = line_.substr(0, line_.find_last_not_of(kBlanks) + 1);
    rest_.remove_prefix(end + 1);
    return true;
  }

  [[noreturn]] void refuse(const std::string& requirement) const {
    source_.refuse("line " + std::to_string(number_) + ": " + in_quotes(line_), requirement);
  }

  void read_format(Words& words) {
    const std::string_view encoding = words.next(), version = words.next();
    using Encoding = PlyHeader::Encoding;
    if (encoding == "ascii")
      header_.encoding = Encoding::ascii;
    else if (encoding == "binary_little_endian")
      header_.encoding = Encoding::little_endian;
    else if (encoding == "binary_big_endian")
      header_.encoding = Encoding::big_endian;
    else
      refuse("format ascii, binary_little_endian or binary_big_endian");
    if (version != "1.0") refuse("version 1.0 of the format");
  }

  void read_element(Words& words) {
    const std::string_view name = words.next();
    const auto count = to_integer(words.next());
    if (name.empty() || !count || *count < 0) refuse("element, a name and a count of zero or more");
    for (const PlyElement& other : header_.elements)
      if (other.name == name) refuse("an element of another name than those before");
    header_.elements.push_back({std::string(name), std::uint64_t(*count), {}});
  }

  void read_property(Words& words) {
    if (header_.elements.empty()) refuse("after the line of an element");
    PlyProperty property;
    std::string_view word = words.next();
    if (word == "list") {
      property.count_type = to_type(words.next());
      if (!property.count_type || !is_integer(*property.count_type))
        refuse("a list counted in an integer type");
      word = words.next();
    }
    const auto type = to_type(word);
    if (!type) refuse("a property of a type of PLY, such as float, double, int or uchar");
    property.type = *type;
    property.name = words.next();
    if (property.name.empty()) refuse("a property with a name");
    header_.elements.back().properties.push_back(std::move(property));
  }

  const Source& source_;
  std::string_view rest_, line_;
  char end_;
  int number_ = 0;
  PlyHeader header_;
};

}  // namespace

PlyHeader read_ply_header(const Source& source) { return HeaderReader(source).read(); }

}  // namespace vericone::files
