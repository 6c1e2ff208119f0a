// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/scenes/scene.h>
#include <iosfwd>

#include "json/json_forward.h"

namespace vericone {

/// The sector of a planar scene with the source's y, as JSON (docs/reference/formats.md) and as text.
Json planar_cone_json(const scenes::Scene& scene);
void print_planar_cone(const Json& cone, const scenes::Scene& scene, std::ostream& out);

/// What its picture shows: outlines, sector and edges of `cone`, and the course (course.h).
Json planar_picture(const Json& cone, const scenes::Scene& scene);

}  // namespace vericone
