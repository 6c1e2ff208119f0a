// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vericone::work {

/// What it takes to get the same result again, as JSON: commit, version, compiler, flags, processor, the
/// command or call; how many threads computed, and each file that was read, with its SHA-256 (null where it
/// cannot be read again). As the commands write it to provenance.json.
[[nodiscard]] std::string provenance(const std::string& command_line, int threads,
                                     const std::vector<std::filesystem::path>& inputs);

}  // namespace vericone::work
