// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

namespace vericone {

/// Where the scenarios and scripts of papers stand: VERICONE_PAPERS where it is set, next to the sources in a
/// build, in the data folder when installed.
std::filesystem::path papers_folder();

/// The scenarios that all its claims and figures are made of, in the order of their names.
std::vector<std::filesystem::path> scenario_files();

}  // namespace vericone
