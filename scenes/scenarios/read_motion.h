// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/simulation/scenario.h>

#include "json/json_forward.h"

namespace vericone::scenario {

/// The fields position, velocity (or speed with heading), orientation and rotation of a body into its `start`
/// and `orientation`. Throws InputError with `path` before the field.
void read_motion(const Json& value, const std::string& path, bool planar, simulation::Body& body);

}  // namespace vericone::scenario
