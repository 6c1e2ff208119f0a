// SPDX-License-Identifier: BSD-3-Clause
//
// Combined quadrics and what belongs to them as JSON for apps/figures.
#pragma once

#include <vericone/geometry/mesh/surface.h>
#include <string>

#include "json/json_forward.h"

namespace vericone {

/// {"center", "factor", "delimiters": [{"matrix", "level"}]}
Json body_json(const CombinedEllipse& body);
Json body_json(const CombinedEllipsoid& body);

/// {"vertices", "triangles", "quadrics"}
Json mesh_json(const CombinedSurface& surface);

/// A body in space, or the part of its surface on the ellipsoid ("ellipsoid") or on the delimiters
/// ("delimiters"): {"body", "part", "mesh"}
Json solid_json(const CombinedEllipsoid& body, const CombinedSurface& whole,
                const std::string& part = "whole");

/// The planar body with its arcs and corners: body_json and {"arcs": [{"conic", "points"}], "corners"}
Json outline_json(const CombinedEllipse& body);

}  // namespace vericone
