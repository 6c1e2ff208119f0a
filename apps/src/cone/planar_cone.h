// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>

#include "input/body.h"

namespace vericone {

/// The sector of a planar scene with the source's y, as JSON (docs/formats.md) and as text.
Json planar_cone_json(const input::PlanarEngagement& engagement);
void print_planar_cone(const Json& cone, const input::PlanarEngagement& engagement, std::ostream& out);

}  // namespace vericone
