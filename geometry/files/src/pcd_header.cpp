// SPDX-License-Identifier: BSD-3-Clause
#include "pcd_header.h"

#include <algorithm>
#include <optional>

#include "text.h"

namespace vericone::files {
namespace {

/// More values in a field than this are no field.
constexpr std::int64_t kMostValues = 1'000'000;

class HeaderReader {
 public:
  explicit HeaderReader(const Source& source) : source_(source), lines_(source) {}

  PcdHeader read() {
    while (lines_.next()) {
      Words words(lines_.text());
      const std::string_view keyword = words.next();
      if (keyword == "FIELDS" || keyword == "COLUMNS")
        read_names(words);
      else if (keyword == "SIZE" || keyword == "TYPE" || keyword == "COUNT")
        read_of_each_field(keyword, words);
      else if (keyword == "WIDTH")
        width_ = read_number(words);
      else if (keyword == "HEIGHT")
        height_ = read_number(words);
      else if (keyword == "POINTS")
        points_ = read_number(words);
      else if (keyword == "DATA")
        return finish(words.next());
      else if (keyword != "VERSION" && keyword != "VIEWPOINT")
        refuse("a line of a PCD header, such as FIELDS, SIZE or DATA");
    }
    source_.refuse("a header without end", "a PCD file whose header ends with DATA");
  }

 private:
  [[noreturn]] void refuse(const std::string& requirement) const {
    source_.refuse(lines_.where() + ": " + in_quotes(lines_.text()), requirement);
  }

  void read_names(Words& words) {
    if (!header_.fields.empty()) refuse("FIELDS once");
    for (std::string_view word = words.next(); !word.empty(); word = words.next())
      header_.fields.push_back({.name = std::string(word)});
  }

  void read_of_each_field(std::string_view keyword, Words& words) {
    for (PcdField& field : header_.fields) {
      const std::string_view word = words.next();
      if (keyword == "TYPE") {
        if (word != "I" && word != "U" && word != "F") refuse("I, U or F for each field");
        field.type = word.front();
        continue;
      }
      const auto n = to_integer(word);
      if (keyword == "SIZE") {
        if (n != 1 && n != 2 && n != 4 && n != 8) refuse("1, 2, 4 or 8 for each field");
        field.size = std::size_t(*n);
      } else {
        if (!n || *n < 0 || *n > kMostValues) refuse("0 to 1000000 for each field");
        field.count = std::size_t(*n);
      }
    }
    if (header_.fields.empty() || !words.next().empty())
      refuse("one entry for each name of FIELDS before it");
  }

  std::size_t read_number(Words& words) const {
    const auto n = to_integer(words.next());
    // Products of two such numbers fit in 64 bits.
    if (!n || *n < 0 || *n > 0xffffffff || !words.next().empty()) refuse("a number from 0 to 2^32 - 1");
    return std::size_t(*n);
  }

  PcdHeader finish(std::string_view data) {
    if (data == "ascii")
      header_.data = PcdHeader::Data::ascii;
    else if (data == "binary")
      header_.data = PcdHeader::Data::binary;
    else if (data == "binary_compressed")
      header_.data = PcdHeader::Data::binary_compressed;
    else
      refuse("DATA ascii, binary or binary_compressed");
    header_.size = source_.bytes.size() - lines_.rest().size();
    header_.lines = lines_.read();

    for (const PcdField& f : header_.fields)
      if (f.type == 'F' && f.size < 4)
        source_.refuse(
            "floating-point field " + in_quotes(f.name) + " of " + std::to_string(f.size) + " bytes",
            "4 or 8 bytes");
    // PDAL writes its names in capitals.
    constexpr std::array<std::string_view, 6> kNames = {"x", "y", "z", "X", "Y", "Z"};
    const bool small = std::ranges::any_of(header_.fields, [](const PcdField& f) { return f.name == "x"; });
    for (std::size_t i = 0; i < 3; ++i) {
      const auto is_it = [&](const PcdField& f) { return f.name == kNames[small ? i : i + 3]; };
      const auto it = std::ranges::find_if(header_.fields, is_it);
      if (std::ranges::count_if(header_.fields, is_it) != 1 || it->count != 1)
        source_.refuse("fields without just one x, y and z", "a PCD file with fields x, y and z of count 1");
      header_.coordinates[i] = std::size_t(it - header_.fields.begin());
    }

    // Files of old versions have POINTS only.
    header_.width = width_ ? *width_ : points_.value_or(0);
    header_.height = height_.value_or(1);
    header_.points = points_.value_or(header_.width * header_.height);
    if (header_.width * header_.height != header_.points)
      source_.refuse("WIDTH " + std::to_string(header_.width) + ", HEIGHT " + std::to_string(header_.height) +
                         " and POINTS " + std::to_string(header_.points),
                     "as many points as the width times the height");
    return header_;
  }

  const Source& source_;
  Lines lines_;
  PcdHeader header_;
  std::optional<std::size_t> width_, height_, points_;
};

}  // namespace

std::size_t PcdHeader::stride() const {
  std::size_t bytes = 0;
  for (const PcdField& f : fields) bytes += f.size * f.count;
  return bytes;
}

PcdHeader read_pcd_header(const Source& source) { return HeaderReader(source).read(); }

}  // namespace vericone::files
