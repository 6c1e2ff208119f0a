// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes, clouds and maps as people publish them: found beside the sources, or nothing.
#pragma once

#include <vericone/files/files.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "geometry/files/written_files.h"

namespace vericone::verify {

/// The named file of the data folder: the environment variable VERICONE_DATA_DIR, or a folder beside the
/// sources.
inline std::optional<std::filesystem::path> data_file(const std::string& name) {
  const char* given = std::getenv("VERICONE_DATA_DIR");
  const auto path = std::filesystem::path(given ? given : VERICONE_DEFAULT_DATA_DIR) / name;
  return std::filesystem::exists(path) ? std::optional(path) : std::nullopt;
}

struct RealMesh {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

inline RealMesh read_mesh(const std::filesystem::path& path) {
  const files::PointFile file = files::read_points(path);
  return {file.points, files::triangles_of(file.points, file.faces)};
}

/// A file of the data folder, or a member of the archive of the package libcgal-demo ("data/...").
inline std::optional<RealMesh> real_mesh(const std::string& name) {
  if (!name.starts_with("data/")) {
    const auto path = data_file(name);
    return path ? std::optional(read_mesh(*path)) : std::nullopt;
  }
  if (!std::filesystem::exists(VERICONE_CGAL_MESHES)) return std::nullopt;
  const testing::TemporaryDirectory directory;
  const std::string command = "tar -xzf '" VERICONE_CGAL_MESHES "' -C '" + directory.path().string() + "' '" +
                              name + "' 2> /dev/null";
  if (std::system(command.c_str()) != 0) return std::nullopt;
  return read_mesh(directory.path() / name);
}

/// For the message of a test that is skipped.
inline std::string not_here(const std::string& name) {
  return name + " is not here; set VERICONE_DATA_DIR to the folder with it, or install libcgal-demo";
}

}  // namespace vericone::verify
