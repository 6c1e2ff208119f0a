// SPDX-License-Identifier: BSD-3-Clause
//
// Bodies and engagements from JSON values; the fields are described in docs/reference/formats.md.
#pragma once

#include <vericone/scenes/scene.h>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "input/field_table.h"

namespace vericone::input {

using scenes::Scene, scenes::SceneBody;

enum class Velocities { required, optional };

/// Reads {"agent", "obstacle", "agent_velocity", "obstacle_velocity"}; further keys only if listed in `also`.
/// Planar where a body's centre has two numbers and no body is spatial. Names of files are relative to
/// `folder`. Throws InputError naming the field, for example "obstacle.semi_axes[1]".
Scene read_engagement(const Json& value, Velocities velocities, const std::vector<std::string_view>& also,
                      const std::filesystem::path& folder);

/// agent, obstacle and their velocities.
const Fields<Scene>& engagement_fields();

/// A spatial body of any kind where it stands. Throws InputError with `path` before the field.
SceneBody read_body(const Json& value, const std::string& path, const std::filesystem::path& folder);

}  // namespace vericone::input
