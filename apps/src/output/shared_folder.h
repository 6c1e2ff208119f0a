// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace vericone {

/// What to call to run this program again; empty if nobody knows. VERICONE_PROGRAM says it where the process
/// is a dynamic linker's (scripts/portable).
std::filesystem::path own_program();

/// Where this program is; empty if nobody knows. What belongs to it is found from there, also when an
/// installation was moved.
std::filesystem::path own_folder();

/// The folder share/vericone/NAME of the installation, or of the build, that this program is part of.
std::filesystem::path shared_folder(const std::string& name);

}  // namespace vericone
