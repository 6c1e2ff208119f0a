// SPDX-License-Identifier: BSD-3-Clause
//
// What the options say of the random engagements.
#pragma once

#include <vericone/internal/cones/random_engagement.h>
#include <string>

#include "accuracy/accuracy.h"

namespace vericone::accuracy {

using namespace engagements;

/// Of `vericone accuracy --obstacle`. Throws InputError naming "--obstacle".
ObstacleKind obstacle_kind(const std::string& name);

Distribution distribution(const Options& options);

/// For text and pictures: "semi-axes 1 to 10 m".
std::string distribution_text(const Distribution& from);

/// For the settings of a table: what differs from the campaign of the source; nothing if nothing does.
std::string distribution_settings(const Options& options);

}  // namespace vericone::accuracy
