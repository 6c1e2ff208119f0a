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
  /// "OFF", "OBJ", "PLY ascii", "PLY binary_little_endian", "PLY binary_big_endian", "STL ascii",
  /// "STL binary", "PCD ascii", "PCD binary", "PCD binary_compressed", "LAS 1.2" (its version), "XYZ",
  /// "KITTI", "nuScenes", "scan graph" or "scan graph text".
  std::string format;

  /// In the unit, frame and order of the file. The double nearest to what is written, however many digits; a
  /// binary float is kept exactly; LAS coordinates are rounded once from integer * scale + offset. Of a scan
  /// graph in its world frame, turned and moved in double; of an STL file each point once, in the order of
  /// first use. All finite.
  std::vector<Eigen::Vector3d> points;

  /// Empty for a cloud. Triangles, quads and larger polygons as they stand in the file.
  std::vector<Face> faces;

  /// Points of the file with a coordinate that is NaN or infinite, left out of `points`; the indices in
  /// `faces` are those after leaving them out.
  std::size_t dropped_points = 0;

  /// Faces of the file that use a dropped point or have fewer than three corners, left out of `faces`.
  std::size_t dropped_faces = 0;

  /// Of an organised cloud (PCD with more than one row) the grid of the file, which `points` still fills
  /// where no point was dropped; 0 otherwise.
  std::size_t width = 0, height = 0;

  /// Bytes after the data that the header of a binary PLY, STL or PCD file claims, read over: more than a few
  /// mean that its counts are too low.
  std::size_t trailing_bytes = 0;

  /// Members of `points` that no member of `faces` uses; for a cloud, all.
  std::size_t unreferenced_points = 0;
};

/// Reads meshes (OFF, OBJ, PLY, STL) and clouds (PLY, PCD, LAS, XYZ and kin, KITTI, OctoMap's scan graphs);
/// docs/reference/formats.md has what is kept of each and what is refused. Other content (normals, colours,
/// intensities, further PLY elements) is read over; PLY triangle strips become triangles. The format is told
/// by the first bytes where the format has a signature, by the extension otherwise.
///
/// Throws InputError whose field is the path and whose message is one line: for a file that is missing,
/// empty, truncated, longer than its header says (but for `trailing_bytes`), of no known format or malformed
/// anywhere, that has no finite point or whose faces point outside the file. Memory is taken only for what is
/// in the file, not for what its header claims. Time and memory are linear in the size of the file.
[[nodiscard]] PointFile read_points(const std::filesystem::path& path);

/// Extensions that promise a mesh or a cloud, with dot, lower case: ".obj", ".off", ... For choosing among
/// the files of a folder; read_points() also reads .asc, .bin (KITTI), .csv, .pts, .pwn and .txt.
[[nodiscard]] std::vector<std::string> known_extensions();

/// The faces cut into triangles, n - 2 for n corners. A polygon is looked at along the coordinate axis from
/// which it looks largest: it becomes the fan about its first corner where all of that turns the same way
/// (convex polygons), else its ears are cut one by one, both decided exactly. So a flat polygon is itself; of
/// one that is not flat this choice is made. Throws InputError naming "faces[i]" for one that crosses itself.
/// Quadratic in the number of corners of a dented polygon.
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> triangles_of(
    const std::vector<Eigen::Vector3d>& points, const std::vector<Face>& faces);

}  // namespace vericone::files
