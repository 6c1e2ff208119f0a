// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace vericone {

/// The program `vericone-NAME`: beside this one, in the family's folder of an installation, or on the PATH.
std::optional<std::filesystem::path> find_program(const std::string& name);

/// The folder share/vericone/NAME of the installation, or of the build, that this program is part of.
std::filesystem::path shared_folder(const std::string& name);

}  // namespace vericone
