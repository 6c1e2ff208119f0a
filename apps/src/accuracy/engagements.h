// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/internal/cones/random_engagement.h>
#include <string>

namespace vericone::accuracy {

using namespace engagements;

/// Of `vericone accuracy --obstacle`. Throws InputError naming "--obstacle".
ObstacleKind obstacle_kind(const std::string& name);

}  // namespace vericone::accuracy
