// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "json/json_forward.h"

namespace vericone {

/// The page of share/vericone/viewer with this data: one file that asks for no other. What the data says,
/// names of files and bodies too, is never read as anything but text. Throws std::runtime_error where there
/// is no such page.
std::string page_with(const Json& data);

/// Shows a file in the desktop's browser. Throws std::runtime_error where there is none.
void open_in_browser(const std::filesystem::path& file);

}  // namespace vericone
