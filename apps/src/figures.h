// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vericone {

/// Runs a script of apps/figures, or one elsewhere by its path, which may import those, with Debian's Python
/// on the data in `folder`, where it also writes its pictures. Returns the pictures; throws
/// std::runtime_error with the script's last line if it fails.
std::vector<std::filesystem::path> draw_figures(const std::string& script,
                                                const std::filesystem::path& folder);

}  // namespace vericone
