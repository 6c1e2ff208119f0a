// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace vericone {

/// The program `vericone-NAME`: beside this one, in the family's folder of an installation, or on the PATH.
std::optional<std::filesystem::path> find_program(const std::string& name);

}  // namespace vericone
