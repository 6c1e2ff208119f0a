// SPDX-License-Identifier: BSD-3-Clause
//
// Wavefront OBJ: vertices and polygons, the rest read over. An own reader: tinyobjloader 2.0 rounds its
// doubles wrongly (two thirds of 17-digit coordinates come back changed) and reads a malformed number as
// zero; assimp and OpenMesh keep floats.
#include <algorithm>

#include "source.h"
#include "text.h"

namespace vericone::files {
namespace {

/// What can be a statement without vertices and faces: programs add their own to those of the format. A
/// capital V or F is no such thing.
bool is_other_statement(std::string_view word) {
  const auto is_letter = [](char c) { return (c | 32) >= 'a' && (c | 32) <= 'z'; };
  return is_letter(word.front()) && word != "V" && word != "F" && std::ranges::all_of(word, [&](char c) {
           return is_letter(c) || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.' || c == ':';
         });
}

Eigen::Vector3d read_vertex(const Source& source, const Lines& lines, Words& words) {
  Eigen::Vector3d p;
  int count = 0;
  for (std::string_view word = words.next(); !word.empty(); word = words.next(), ++count) {
    const double x = lines.number(word);
    if (count < 3) p(count) = x;
  }
  // x y z, then a weight, a colour, or both.
  if (count < 3 || count == 5 || count > 8)
    source.refuse(lines.where() + ": a vertex of " + std::to_string(count) + " numbers",
                  "x y z, then nothing, a weight or a colour");
  return p;
}

/// Corners are v, v/vt, v//vn or v/vt/vn; v counts from 1, or backwards from the last vertex so far when
/// negative.
std::vector<std::uint32_t> read_face(const Source& source, const Lines& lines, Words& words,
                                     std::size_t vertices) {
  std::vector<std::uint32_t> face;
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    const std::size_t slash = std::min(word.find('/'), word.size());
    if (word.find_first_not_of("0123456789+-/", slash) != std::string_view::npos)
      source.refuse(lines.where() + ": " + in_quotes(word), "a face corner v, v/vt, v//vn or v/vt/vn");
    const std::int64_t v = lines.integer(word.substr(0, slash));
    if (v == 0 || v < -std::int64_t(vertices))
      source.refuse(
          lines.where() + ": vertex index " + std::to_string(v),
          "1 or more, or as far back as " + std::to_string(vertices) + " vertices go when negative");
    face.push_back(to_index(source, v > 0 ? v - 1 : std::int64_t(vertices) + v, lines.where()));
  }
  if (face.size() < 3)
    source.refuse(lines.where() + ": a face of " + std::to_string(face.size()) + " corners",
                  "a face of three or more corners");
  return face;
}

}  // namespace

Parsed parse_obj(const Source& source) {
  constexpr const char* kStatement = "a statement of an OBJ file, such as v or f";
  Parsed parsed{.format = "OBJ"};
  Lines lines(source);
  std::string strange;  // the first statement that is read over, for files that are something else
  while (lines.next(true)) {
    Words words(lines.text());
    const std::string_view statement = words.next();
    if (statement == "v")
      parsed.points.push_back(read_vertex(source, lines, words));
    else if (statement == "f" || statement == "fo")
      parsed.faces.push_back(read_face(source, lines, words, parsed.points.size()));
    else if (!is_other_statement(statement))
      source.refuse(lines.where() + ": " + in_quotes(statement), kStatement);
    else if (strange.empty())
      strange = lines.where() + ": " + in_quotes(statement);
  }
  if (parsed.points.empty() && parsed.faces.empty() && !strange.empty()) source.refuse(strange, kStatement);
  return parsed;
}

}  // namespace vericone::files
