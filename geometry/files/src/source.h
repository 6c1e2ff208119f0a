// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/files/files.h>

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace vericone::files {

/// A file in memory, and the one way to complain about it.
struct Source {
  std::string path;
  std::string bytes;

  [[noreturn]] void refuse(const std::string& value, const std::string& requirement) const;
};

/// The whole file; refuses what is missing, unreadable or empty.
Source load(const std::filesystem::path& path);

/// read_points() of a file that is in memory.
PointFile read_points(const Source& source);

/// What a parser returns: everything in the file, unchecked beyond its syntax.
struct Parsed {
  std::string format = {};
  std::vector<Eigen::Vector3d> points = {};
  std::vector<std::vector<std::uint32_t>> faces = {};
  std::size_t width = 0, height = 0;  // of an organised cloud
  std::size_t trailing_bytes = 0;     // after the data of a binary file
};

/// `text` in quotes, shortened, without anything that could break the line of a message.
std::string in_quotes(std::string_view text);

/// An index into the points of the file, counted from 0; refuses what no file could mean.
std::uint32_t to_index(const Source& source, std::int64_t index, const std::string& where);

Parsed parse_off(const Source& source);
Parsed parse_obj(const Source& source);
Parsed parse_ply(const Source& source);
Parsed parse_stl(const Source& source);
Parsed parse_pcd(const Source& source);
Parsed parse_las(const Source& source);
Parsed parse_xyz(const Source& source);
Parsed parse_kitti(const Source& source);
Parsed parse_scan_graph(const Source& source);
Parsed parse_gltf(const Source& source);
Parsed parse_dae(const Source& source);
Parsed parse_ptx(const Source& source);

/// Whether the bytes start with the signature of the format.
bool looks_like_off(std::string_view bytes);
bool looks_like_ply(std::string_view bytes);
bool looks_like_pcd(std::string_view bytes);
bool looks_like_las(std::string_view bytes);
bool looks_like_scan_graph(std::string_view bytes);
bool looks_like_glb(std::string_view bytes);

}  // namespace vericone::files
