// SPDX-License-Identifier: BSD-3-Clause
//
// STL, ascii and binary. An own reader, as for the other meshes: assimp 5.2 and OpenMesh 9.0 read ascii
// coordinates into floats, and assimp takes a file for ascii by its first word, which binary files have too.
#include <vericone/geometry/error.h>
#include <algorithm>
#include <cctype>

#include "binary.h"
#include "point_merger.h"
#include "source.h"
#include "text.h"

namespace vericone::files {
namespace {

constexpr std::size_t kHeader = 84, kFacet = 50;

bool is(std::string_view word, std::string_view keyword) {
  return std::ranges::equal(word, keyword,
                            [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; });
}

/// Binary files often begin with "solid" too, but no text has zeros.
bool looks_like_ascii(std::string_view bytes) {
  const std::string_view head = bytes.substr(0, 1024);
  return is(Words(head).next(), "solid") && head.find('\0') == std::string_view::npos;
}

std::size_t facets_of_binary(std::string_view bytes) {
  return bytes.size() < kHeader ? 0 : little_endian<std::uint32_t>(bytes.data() + 80);
}

/// What the header claims; an ascii file does not: letters as the count make it larger than 7 GB.
std::size_t binary_size(std::string_view bytes) { return kHeader + kFacet * facets_of_binary(bytes); }

Parsed parse_binary(const Source& source) {
  Parsed parsed{.format = "STL binary"};
  PointMerger merger(parsed.points);
  const std::size_t facets = facets_of_binary(source.bytes);
  parsed.faces.reserve(facets);
  parsed.trailing_bytes = source.bytes.size() - binary_size(source.bytes);
  for (std::size_t f = 0; f < facets; ++f) {
    if (f % 4096 == 0) checkpoint();
    // A normal, which the corners tell better, the corners, and two bytes that mean different things.
    const char* at = source.bytes.data() + kHeader + kFacet * f + 12;
    std::vector<std::uint32_t> face(3);
    for (std::uint32_t& corner : face) {
      Eigen::Vector3d p;
      for (int i = 0; i < 3; ++i, at += 4) p(i) = little_endian<float>(at);
      corner = merger.index(p);
    }
    parsed.faces.push_back(std::move(face));
  }
  return parsed;
}

/// solid, facets and endsolid, a line each; several solids may follow each other.
class AsciiReader {
 public:
  explicit AsciiReader(const Source& source) : source_(source), lines_(source), merger_(parsed_.points) {}

  Parsed read() {
    parsed_.format = "STL ascii";
    while (lines_.next()) {
      expect("solid", "");
      while (!is(next_line("facet or endsolid"), "endsolid")) read_facet();
    }
    return std::move(parsed_);
  }

 private:
  /// The first word of the next line.
  std::string_view next_line(const char* expected) {
    if (!lines_.next())
      source_.refuse("end of file inside a solid", std::string(expected) + ", up to the last endsolid");
    return Words(lines_.text()).next();
  }

  void expect(std::string_view first, std::string_view second) {
    Words words(lines_.text());
    if (!is(words.next(), first) || (!second.empty() && !is(words.next(), second)))
      source_.refuse(lines_.where() + ": " + in_quotes(lines_.text()),
                     std::string(first) + (second.empty() ? "" : " ") + std::string(second));
  }

  /// From the line of the facet itself, whose normal is read over.
  void read_facet() {
    expect("facet", "normal");
    next_line("outer loop");
    expect("outer", "loop");
    std::vector<std::uint32_t> face(3);
    for (std::uint32_t& corner : face) {
      next_line("vertex");
      expect("vertex", "");
      Words words(lines_.text());
      words.next();
      Eigen::Vector3d p;
      for (double& x : p) x = lines_.number(words.next());
      if (!words.next().empty())
        source_.refuse(lines_.where() + ": " + in_quotes(lines_.text()), "vertex and three numbers");
      corner = merger_.index(p);
    }
    next_line("endloop");
    expect("endloop", "");
    next_line("endfacet");
    expect("endfacet", "");
    parsed_.faces.push_back(std::move(face));
  }

  const Source& source_;
  Lines lines_;
  Parsed parsed_;
  PointMerger merger_;
};

}  // namespace

Parsed parse_stl(const Source& source) {
  const std::size_t facets = facets_of_binary(source.bytes), size = binary_size(source.bytes);
  if (source.bytes.size() == size) return parse_binary(source);
  if (looks_like_ascii(source.bytes)) return AsciiReader(source).read();
  if (facets > 0 && source.bytes.size() > size) return parse_binary(source);
  if (source.bytes.size() < kHeader)
    source.refuse(std::to_string(source.bytes.size()) + " bytes, not beginning with solid",
                  "an STL file, ascii or of 84 bytes and 50 for each facet");
  source.refuse(std::to_string(source.bytes.size()) + " bytes", std::to_string(size) + " bytes, as the " +
                                                                    std::to_string(facets) +
                                                                    " facets take that the header claims");
}

}  // namespace vericone::files
