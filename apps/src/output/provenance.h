// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "json/json_forward.h"

namespace vericone {

/// What it takes to get the same result again: commit, version, compiler, flags, processor, command line; how
/// many threads computed, and each file that was read, with its SHA-256 (null where it cannot be read again).
Json provenance(const std::string& command_line, int threads,
                const std::vector<std::filesystem::path>& inputs);

}  // namespace vericone
