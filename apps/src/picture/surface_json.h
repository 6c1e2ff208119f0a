// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "glb/glb_file.h"
#include "json/json_forward.h"

namespace vericone {

/// A surface with as many digits as a picture shows: {"points": [xyz...], "triangles": [indices...]}.
Json surface_json(const glb::Drawn& drawn);

}  // namespace vericone
