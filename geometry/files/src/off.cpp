// SPDX-License-Identifier: BSD-3-Clause
//
// OFF, as Geomview defines it, one vertex or face a line. An own reader: of the permissively licensed
// libraries in Debian, OpenMesh 9.0 and assimp 5.2 keep coordinates as float even where the mesh is of
// doubles.
#include "source.h"
#include "text.h"

namespace vericone::files {
namespace {

/// The keyword is [ST][C][N][4][n]OFF: texture coordinates, colours, normals, and for 4 and n other
/// dimensions.
bool is_keyword(std::string_view word) {
  for (const std::string_view prefix : {"ST", "C", "N", "4", "n"})
    if (word.starts_with(prefix)) word.remove_prefix(prefix.size());
  return word == "OFF";
}

std::size_t read_count(const Source& source, const Lines& lines, std::string_view word, const char* what) {
  const std::int64_t n = lines.integer(word);
  if (n < 0) source.refuse(lines.where() + ": " + std::to_string(n) + " " + what, "zero or more");
  return std::size_t(n);
}

[[noreturn]] void refuse_end(const Source& source, std::size_t done, std::size_t claimed, const char* what) {
  source.refuse("end of file after " + std::to_string(done) + " " + what,
                "a file with the " + std::to_string(claimed) + " " + what + " that its header claims");
}

}  // namespace

bool looks_like_off(std::string_view bytes) {
  const Source head{"", std::string(bytes.substr(0, 4096))};
  Lines lines(head);
  return lines.next() && is_keyword(Words(lines.text()).next());
}

Parsed parse_off(const Source& source) {
  Lines lines(source);
  if (!lines.next()) source.refuse("only comments", "an OFF file");
  Words head(lines.text());
  const std::string_view keyword = head.next();
  if (!is_keyword(keyword)) source.refuse(lines.where() + ": " + in_quotes(keyword), "the keyword OFF");
  if (keyword.find_first_of("4n") != std::string_view::npos)
    source.refuse(lines.where() + ": " + in_quotes(keyword), "OFF in three dimensions");
  std::string_view word = head.next();
  if (word == "BINARY") source.refuse("a binary OFF file", "an ascii OFF file");
  if (word.empty()) {
    if (!lines.next()) refuse_end(source, 0, 3, "counts");
    head = Words(lines.text());
    word = head.next();
  }
  const std::size_t vertices = read_count(source, lines, word, "vertices");
  const std::size_t faces = read_count(source, lines, head.next(), "faces");
  // The number of edges, if there, is by custom not true.
  const std::string_view edges = head.next();
  if (!edges.empty()) lines.integer(edges);

  // "0 0 0\n" and "0\n" are the shortest vertex and face.
  const std::size_t left = lines.rest().size() + 1;
  if (vertices > left / 6 || faces > left / 2)
    source.refuse(
        "a header with " + std::to_string(vertices) + " vertices and " + std::to_string(faces) + " faces",
        "counts that the " + std::to_string(left - 1) + " bytes after it can hold");

  Parsed parsed{.format = "OFF"};
  parsed.points.reserve(vertices);
  std::size_t columns = 0;
  for (std::size_t i = 0; i < vertices; ++i) {
    if (!lines.next()) refuse_end(source, i, vertices, "vertices");
    Words words(lines.text());
    Eigen::Vector3d p;
    std::size_t count = 0;
    for (word = words.next(); !word.empty(); word = words.next(), ++count) {
      const double x = lines.number(word);
      if (count < 3) p(Eigen::Index(count)) = x;
    }
    if (count < 3 || (i > 0 && count != columns))
      source.refuse(lines.where() + ": a vertex of " + std::to_string(count) + " numbers",
                    i == 0 || columns < 3 ? "three coordinates, perhaps more numbers after them"
                                          : std::to_string(columns) + " numbers, as for the vertices before");
    columns = count;
    parsed.points.push_back(p);
  }
  parsed.faces.reserve(faces);
  for (std::size_t i = 0; i < faces; ++i) {
    if (!lines.next()) refuse_end(source, i, faces, "faces");
    Words words(lines.text());
    const std::size_t corners = read_count(source, lines, words.next(), "corners");
    std::vector<std::uint32_t> face;
    for (std::size_t k = 0; k < corners; ++k) {
      word = words.next();
      if (word.empty())
        source.refuse(lines.where() + ": " + std::to_string(k) + " vertex indices",
                      std::to_string(corners) + " vertex indices, as the line begins");
      face.push_back(to_index(source, lines.integer(word), lines.where()));
    }
    for (word = words.next(); !word.empty(); word = words.next()) lines.number(word);  // colour
    parsed.faces.push_back(std::move(face));
  }
  if (lines.next())
    source.refuse(lines.where() + ": " + in_quotes(lines.text()),
                  "the end of the file, after " + std::to_string(vertices) + " vertices and " +
                      std::to_string(faces) + " faces");
  return parsed;
}

}  // namespace vericone::files
