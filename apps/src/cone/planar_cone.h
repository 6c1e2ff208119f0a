// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>

#include "input/body.h"

namespace vericone {

/// The sector of a planar scene with the source's y, as JSON (docs/reference/formats.md) and as text.
Json planar_cone_json(const input::PlanarEngagement& engagement);
void print_planar_cone(const Json& cone, const input::PlanarEngagement& engagement, std::ostream& out);

/// What its picture shows: outlines, sector and edges of `cone`, and the course (course.h).
Json planar_picture(const Json& cone, const input::PlanarEngagement& engagement);

}  // namespace vericone
