// SPDX-License-Identifier: BSD-3-Clause
//
// One agent among others from a line of a file of cases (docs/reference/formats.md).
#pragma once

#include <vericone/geometry/error.h>
#include <vericone/guidance/bands.h>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "command/program.h"
#include "json/json_forward.h"

namespace vericone {

struct EncounterCase {
  Placed agent;
  Eigen::Vector3d velocity, wind;  // m/s
  std::vector<guidance::Intruder> intruders;

  /// `also`: fields besides those that every such case has. Throws InputError naming the field.
  EncounterCase(const Json& value, const std::vector<std::string>& also, const std::filesystem::path& folder);
};

/// A command that answers a file of such cases; `answer` takes one and the folder that names of files in it
/// are relative to. Returns the exit status.
int answer_encounters(CommandLine& line, Json (*answer)(const Json&, const std::filesystem::path&));

/// What `ask` answers; what it says of a limit is said of the field that gave it: "limits.speed".
template <typename Ask>
auto within_limits(const Ask& ask) {
  try {
    return ask();
  } catch (const InputError& error) {
    for (const char* name : {"speed", "climb", "altitude", "lateral", "longitudinal", "vertical"})
      if (error.field() == name) throw error.within("limits");
    throw;
  }
}

guidance::Range read_range(const Json& value, const std::string& path, const char* unit);

}  // namespace vericone
