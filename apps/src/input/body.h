// SPDX-License-Identifier: BSD-3-Clause
//
// Bodies and velocities from JSON values; the fields are described in docs/formats.md.
#pragma once

#include <vericone/geometry/ellipsoid.h>
#include <initializer_list>
#include <nlohmann/json.hpp>

namespace vericone::input {

using Json = nlohmann::ordered_json;

/// One engagement: two bodies and their velocities, m and m/s.
struct Engagement {
  Ellipsoid agent, obstacle;
  Eigen::Vector3d agent_velocity = Eigen::Vector3d::Zero();
  Eigen::Vector3d obstacle_velocity = Eigen::Vector3d::Zero();
};

enum class Velocities { required, optional };

/// Reads {"agent", "obstacle", "agent_velocity", "obstacle_velocity"}; further keys only if listed in `also`.
/// Throws InputError naming the field, for example "obstacle.semi_axes[1]".
Engagement read_engagement(const Json& value, Velocities velocities, std::initializer_list<const char*> also);

/// A value as it stands in a message: one line, at most 60 characters.
std::string quoted(const Json& value);

}  // namespace vericone::input
