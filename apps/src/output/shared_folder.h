// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace vericone {

/// Where this program is; empty if nobody knows. What belongs to it is found from there, also when an
/// installation was moved.
std::filesystem::path own_folder();

/// The folder share/vericone/NAME of the installation, or of the build, that this program is part of.
std::filesystem::path shared_folder(const std::string& name);

}  // namespace vericone
