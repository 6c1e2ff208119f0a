// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/scenes/scene.h>

#include "json/json_forward.h"

namespace vericone {

/// What a picture shows of two velocities, seen from the obstacle: {"velocity", "verdict"} and where that
/// leads: "contact_time" (s) with "contact_point", or "miss_distance" (m) with "nearest_time",
/// "nearest_on_agent" and "nearest_on_obstacle"; neither where the verdict is undecided, the bodies overlap,
/// or the contact is too far away for doubles. Requires combined quadrics in space, or any bodies
/// in the plane.
/// Distances of ellipses and ellipsoids are those of Pair, others estimates (nearest_points.h).
Json course_json(const scenes::Scene& scene);

}  // namespace vericone
