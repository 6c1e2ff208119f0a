// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/files/files.h>
#include <vericone/internal/files/extensions.h>

#include <vericone/geometry/error.h>
#include <algorithm>
#include <cctype>
#include <limits>

#include "source.h"

namespace vericone::files {
namespace {

/// The one place that a new format is entered in.
struct Format {
  std::string_view extension;
  /// Whether the extension by itself promises geometry.
  bool is_telling;
  bool (*recognises)(std::string_view bytes);  // null: the format has no signature
  Parsed (*parse)(const Source& source);
};

constexpr Format kFormats[] = {
    {".asc", false, nullptr, parse_xyz},
    {".bin", false, nullptr, parse_kitti},
    {".csv", false, nullptr, parse_xyz},
    {".dae", true, nullptr, parse_dae},
    {".glb", true, looks_like_glb, parse_gltf},
    {".gltf", true, nullptr, parse_gltf},
    {".graph", true, looks_like_scan_graph, parse_scan_graph},
    {".las", true, looks_like_las, parse_las},
    {".laz", true, nullptr, parse_las},
    {".obj", true, nullptr, parse_obj},
    {".off", true, looks_like_off, parse_off},
    {".pcd", true, looks_like_pcd, parse_pcd},
    {".ply", true, looks_like_ply, parse_ply},
    {".pts", false, nullptr, parse_xyz},
    {".ptx", true, nullptr, parse_ptx},
    {".pwn", false, nullptr, parse_xyz},
    {".stl", true, nullptr, parse_stl},
    {".txt", false, nullptr, parse_xyz},
    {".xyz", true, nullptr, parse_xyz},
};

std::string extension_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = char(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

const Format& format_of(const Source& source, const std::string& extension) {
  for (const Format& f : kFormats)
    if (f.recognises && f.recognises(source.bytes)) return f;
  for (const Format& f : kFormats)
    if (f.extension == extension) return f;
  std::string known;
  for (const Format& f : kFormats) known += (known.empty() ? "" : ", ") + std::string(f.extension);
  source.refuse(extension.empty() ? "no extension" : "extension " + in_quotes(extension),
                "a file in one of the known formats: " + known);
}

/// Checks the indices, leaves out what is not finite, and counts.
PointFile finish(const Source& source, Parsed parsed) {
  constexpr std::uint32_t kDropped = std::numeric_limits<std::uint32_t>::max();
  PointFile file;
  file.format = std::move(parsed.format);
  file.width = parsed.width;
  file.height = parsed.height;
  file.trailing_bytes = parsed.trailing_bytes;
  const std::size_t count = parsed.points.size();
  if (count == 0) source.refuse("no points", "a file with at least one point");
  if (count >= kDropped) source.refuse(std::to_string(count) + " points", "fewer than 2^32 - 1 points");

  std::vector<std::uint32_t> new_index(count, kDropped);
  for (std::size_t i = 0; i < count; ++i)
    if (parsed.points[i].allFinite()) {
      new_index[i] = std::uint32_t(i - file.dropped_points);
      parsed.points[i - file.dropped_points] = parsed.points[i];
    } else {
      ++file.dropped_points;
    }
  if (file.dropped_points == count)
    source.refuse(std::to_string(count) + " points, none of them finite",
                  "a file with at least one finite point");
  parsed.points.resize(count - file.dropped_points);
  file.points = std::move(parsed.points);

  std::vector<char> used(file.points.size(), 0);
  file.faces.reserve(parsed.faces.size());
  for (std::size_t f = 0; f < parsed.faces.size(); ++f) {
    Face& face = parsed.faces[f];
    bool keeps = face.size() >= 3;
    for (std::uint32_t& v : face) {
      if (v >= count)
        source.refuse("face " + std::to_string(f) + " with vertex index " + std::to_string(v) + " (from 0)",
                      "at most " + std::to_string(count - 1) + ", the file has " + std::to_string(count) +
                          (count == 1 ? " vertex" : " vertices"));
      v = new_index[v];
      keeps = keeps && v != kDropped;
    }
    if (keeps) {
      for (const std::uint32_t v : face) used[v] = 1;
      file.faces.push_back(std::move(face));
    } else {
      ++file.dropped_faces;
    }
  }
  if (file.faces.empty() && file.dropped_points > 0 &&
      file.dropped_faces > 0)  // no cloud, though it has points
    source.refuse(std::to_string(file.dropped_faces) + " faces, all with points that are not finite",
                  "a file with a face of finite points");
  file.unreferenced_points = std::size_t(std::ranges::count(used, 0));
  return file;
}

}  // namespace

PointFile read_points(const Source& source) {
  return finish(source, format_of(source, extension_of(source.path)).parse(source));
}

PointFile read_points(const std::filesystem::path& path) { return read_points(load(path)); }

std::vector<std::string> known_extensions() {
  std::vector<std::string> extensions;
  for (const Format& f : kFormats)
    if (f.is_telling) extensions.emplace_back(f.extension);
  return extensions;
}

}  // namespace vericone::files
