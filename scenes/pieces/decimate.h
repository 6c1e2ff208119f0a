// SPDX-License-Identifier: BSD-3-Clause
//
// Fewer pieces for a picture; nothing else is computed with them.
#pragma once

#include <vericone/geometry/assembly.h>
#include <vericone/geometry/pose.h>

#include "json/json_forward.h"

namespace vericone {

/// The pieces in world coordinates, thinned to what a picture shows: {"triangles": [[9 numbers]]} (corners of
/// one cell of a grid joined), {"points": [[x, y, z]], "radius"} or {"boxes": [[x, y, z, half width]]}.
/// Convex bodies become triangles.
Json shown_pieces(const Assembly& pieces, const Pose& pose);

/// The same of one convex body.
Json shown_convex(const Convex& body, const Pose& pose);

/// The body from above as rows of characters, south to north: {"low": [x, y], "cell": metres, "rows"};
/// '#': it has something between `low` and `high` (m) there, '+': only below or above, '.': nothing.
Json top_view(const Assembly& pieces, const Pose& pose, double low, double high);

}  // namespace vericone
