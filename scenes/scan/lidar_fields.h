// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/lidar/lidar.h>
#include <vector>

#include "json/json_forward.h"

namespace vericone::scanning {

struct SceneLidars {
  std::vector<lidar::Lidar> lidars;
  double position_error = 0, rotation_error = 0;  // how well their poses are known, see Setup
};

/// The fields `lidars` and `pose_error` of a scene (docs/reference/formats.md). Throws InputError naming the
/// field.
SceneLidars read_lidars(const Json& scene);
Json scan_schema();

}  // namespace vericone::scanning
