// SPDX-License-Identifier: BSD-3-Clause
//
// Extensions that are read, and the names of files that are being written.
#pragma once

#include <vericone/files/files.h>
#include <filesystem>
#include <string>
#include <vector>

namespace vericone::files {

/// Extensions that promise a mesh or a cloud, with dot, lower case: ".obj", ".off", ... For choosing among
/// the files of a folder; read_points() also reads .asc, .bin (KITTI), .csv, .pts, .pwn and .txt.
[[nodiscard]] std::vector<std::string> known_extensions();

/// A name beside `path` for what is being written, which no other writer has, in this process or in another.
[[nodiscard]] std::filesystem::path partial_path(const std::filesystem::path& path);

}  // namespace vericone::files
