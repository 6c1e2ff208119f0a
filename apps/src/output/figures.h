// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vericone {

/// Runs a script of apps/figures, or one elsewhere by its path, which may import those, with Debian's Python,
/// or the one that VERICONE_PYTHON names, on the data in `folder`, where it also writes its pictures. Without
/// interpreter or packages there are none, which one line on standard error says; throws std::runtime_error
/// with the script's last line if it fails otherwise.
void draw_figures(const std::string& script, const std::filesystem::path& folder);

/// Those of `files` that are pictures.
std::vector<std::filesystem::path> pictures_of(const std::vector<std::filesystem::path>& files);

}  // namespace vericone
