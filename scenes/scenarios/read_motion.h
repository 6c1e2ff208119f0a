// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/simulation/scenario.h>

#include "json/json_forward.h"

namespace vericone::scenario {

/// Velocity and the direction ahead, which a body at rest may have as well.
struct Going {
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  guidance::Direction ahead;
};

/// The field velocity, or speed with heading or heading_deg.
Going read_going(const Json& value, const std::string& path, bool planar);

/// An angle in the plane, [azimuth, elevation] in space; in degrees or radians.
guidance::Direction read_heading(const Json& value, const std::string& path, bool planar, bool degrees);

/// The fields position, velocity (or speed with heading), orientation and rotation of a body into its `start`
/// and `orientation`. Throws InputError with `path` before the field.
void read_motion(const Json& value, const std::string& path, bool planar, simulation::Body& body);

}  // namespace vericone::scenario
