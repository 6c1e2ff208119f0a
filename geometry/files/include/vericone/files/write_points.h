// SPDX-License-Identifier: BSD-3-Clause
//
// Meshes and clouds to files, so that reading gives the same numbers.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <span>

namespace vericone::files {

/// Writes points (metres, or any unit) and triangles of indices into them, none for a cloud, in the format of
/// the extension: .ply (binary, little endian, doubles), .obj, .off, .stl (binary; triangles alone), .pcd
/// (binary, doubles) and .xyz (text), the last two for clouds. read_points() then gives the same doubles in
/// the same order; of .stl, whose numbers are floats, each point once in the order of first use.
///
/// The file is there as a whole at the end, or as it was before. Throws InputError naming "path" for another
/// extension, "points[i][k]" for a number that is not finite or, in .stl, no float, "triangles[i][k]" for an
/// index without a point and "triangles" where the format has no triangles or cannot do without;
/// std::system_error naming the path where it cannot be written. Linear in the points and triangles, 0.2 s a
/// million as text.
void write_points(const std::filesystem::path& path, std::span<const Eigen::Vector3d> points,
                  std::span<const std::array<std::uint32_t, 3>> triangles);

/// The same of a cloud.
void write_points(const std::filesystem::path& path, std::span<const Eigen::Vector3d> points);

/// A name beside `path` for what is being written, which no other writer has, in this process or in another.
[[nodiscard]] std::filesystem::path partial_path(const std::filesystem::path& path);

}  // namespace vericone::files
