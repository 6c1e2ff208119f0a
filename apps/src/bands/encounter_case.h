// SPDX-License-Identifier: BSD-3-Clause
//
// One agent among others from a line of a file of cases (docs/reference/formats.md).
#pragma once

#include <vericone/guidance/bands.h>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "json/json_forward.h"

namespace vericone {

struct EncounterCase {
  Placed agent;
  Eigen::Vector3d velocity, wind;  // m/s
  std::vector<guidance::Intruder> intruders;

  /// `also`: fields besides those that every such case has. Throws InputError naming the field.
  EncounterCase(const Json& value, const std::vector<std::string>& also, const std::filesystem::path& folder);
};

guidance::Range read_range(const Json& value, const std::string& path, const char* unit);

}  // namespace vericone
