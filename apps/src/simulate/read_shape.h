// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/simulation/shape_in_time.h>

#include "input/body.h"

namespace vericone::scenario {

/// The shape of a body in its own frame. Throws InputError with `path` before the field.
simulation::ShapeInTime read_shape(const Json& value, const std::string& path);

}  // namespace vericone::scenario
