// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace vericone {

/// Where the scenarios and scripts of papers stand: VERICONE_PAPERS where it is set, next to the sources in a
/// build, in the data folder when installed.
std::filesystem::path papers_folder();

}  // namespace vericone
