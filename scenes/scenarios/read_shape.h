// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/scenes/scene.h>
#include <vericone/simulation/track.h>
#include <filesystem>
#include <optional>
#include <string>

#include "json/json_forward.h"

namespace vericone::scenario {

/// The shape of a body in its own frame, and what reading its file found. Names of files are relative to
/// `folder`. Throws InputError with `path` before the field.
simulation::ShapeInTime read_shape(const Json& value, const std::string& path,
                                   const std::filesystem::path& folder,
                                   std::optional<scenes::Reading>& reading);

}  // namespace vericone::scenario
