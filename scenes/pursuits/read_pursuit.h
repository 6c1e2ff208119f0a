// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/vision/pursuit/pursuit.h>
#include <filesystem>
#include <string>

#include "json/json_forward.h"

namespace vericone::pursuit {

/// Throws InputError with the field's path: "cars[1].road.changes[0].at", "cameras.perspective.noise", ...
/// Pictures of the ground are found relative to `folder`. The camera of `eyes` must be there; exact eyes look
/// through the perspective one, or the source's where it is alone.
vision::Pursuit read_pursuit(const Json& fields, const std::string& name, const std::filesystem::path& folder,
                             vision::Eyes eyes);
Json pursuit_schema();

/// What saw a pursuit, for `track --own`.
struct SeenBy {
  vision::PerceptionOptions perception;
  double picture_step = 0;  // s
};
/// Throws InputError with the field's path.
SeenBy read_perception(const Json& fields);
Json perception_json(const SeenBy& seen);

}  // namespace vericone::pursuit
