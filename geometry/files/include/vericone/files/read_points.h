// SPDX-License-Identifier: BSD-3-Clause
//
// Points and faces from mesh and point-cloud files.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace vericone::files {

/// Corners of a polygon as indices into PointFile::points, three or more.
using Face = std::vector<std::uint32_t>;

struct PointFile {
  /// "OFF", "OBJ", "PLY ascii", "PLY binary_little_endian" or "PLY binary_big_endian".
  std::string format;

  /// In the unit and order of the file. The double nearest to what is written, however many digits; a binary
  /// float is kept exactly. All finite.
  std::vector<Eigen::Vector3d> points;

  /// Empty for a cloud. Triangles, quads and larger polygons as they stand in the file.
  std::vector<Face> faces;

  /// Points of the file with a coordinate that is NaN or infinite, left out of `points`; the indices in
  /// `faces` are those after leaving them out.
  std::size_t dropped_points = 0;

  /// Faces of the file that use a dropped point or have fewer than three corners, left out of `faces`.
  std::size_t dropped_faces = 0;

  /// Members of `points` that no member of `faces` uses; for a cloud, all.
  std::size_t unreferenced_points = 0;
};

/// Reads OFF, OBJ and PLY (ascii and both binary kinds), with or without faces. Other content (normals,
/// colours, intensities, further PLY elements) is read over; PLY triangle strips become triangles. The format
/// is told by the first bytes where the format has a signature, by the extension otherwise.
///
/// Throws InputError whose field is the path and whose message is one line: for a file that is missing,
/// empty, truncated, longer than its header says, of no known format or malformed anywhere, that has no
/// finite point or whose faces point outside the file. Memory is taken only for what is in the file, not for
/// what its header claims. Time and memory are linear in the size of the file.
PointFile read_points(const std::filesystem::path& path);

/// Extensions of the known formats, with dot, lower case: ".obj", ".off", ".ply".
std::vector<std::string> known_extensions();

/// The faces cut into triangles, each as a fan about its first corner (right for convex polygons).
std::vector<std::array<std::uint32_t, 3>> fan_triangles(const std::vector<Face>& faces);

}  // namespace vericone::files
