// SPDX-License-Identifier: BSD-3-Clause
//
// Pursuits from YAML (docs/reference/pursuits.md).
#pragma once

#include <vericone/vision/pursuit/pursuit.h>
#include <filesystem>
#include <string>

#include "json/json_forward.h"

namespace vericone::pursuit {

/// Throws InputError with the field's path: "cars[1].road.changes[0].at", "cameras.perspective.noise", ...
/// Pictures of the ground are found relative to `folder`.
vision::Pursuit read_pursuit(const Json& fields, const std::string& name,
                             const std::filesystem::path& folder);

/// A camera and what a perception needs beside it, for `track --own`: the fields of camera_json.
vision::PerceptionOptions read_perception(const Json& fields);
Json perception_json(const vision::PerceptionOptions& options);

}  // namespace vericone::pursuit
