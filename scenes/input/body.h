// SPDX-License-Identifier: BSD-3-Clause
//
// Bodies and engagements from JSON values; the fields are described in docs/reference/formats.md.
#pragma once

#include <vericone/scenes/scene.h>
#include <filesystem>
#include <initializer_list>
#include <string>

#include "json/json_forward.h"

namespace vericone::input {

using scenes::Scene, scenes::SceneBody;

enum class Velocities { required, optional };

/// Reads {"agent", "obstacle", "agent_velocity", "obstacle_velocity"}; further keys only if listed in `also`.
/// Planar where a body's centre has two numbers and no body is spatial. Names of files are relative to
/// `folder`. Throws InputError naming the field, for example "obstacle.semi_axes[1]".
Scene read_engagement(const Json& value, Velocities velocities, std::initializer_list<const char*> also,
                      const std::filesystem::path& folder);

/// A spatial body of any kind where it stands. Throws InputError with `path` before the field.
SceneBody read_body(const Json& value, const std::string& path, const std::filesystem::path& folder);

}  // namespace vericone::input
