// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "json/json_forward.h"

namespace vericone {

/// What work::provenance() has, as JSON values.
Json provenance(const std::string& command_line, int threads,
                const std::vector<std::filesystem::path>& inputs);

}  // namespace vericone
