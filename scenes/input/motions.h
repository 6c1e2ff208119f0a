// SPDX-License-Identifier: BSD-3-Clause
//
// How the bodies of an engagement spin, accelerate or brake: fields beside those of the body.
#pragma once

#include <vericone/cones/motion.h>
#include <vericone/scenes/scene.h>
#include <optional>

#include "json/json_value.h"

namespace vericone::input {

/// The fields of both bodies as they stand, taken out of an engagement.
struct MotionsGiven {
  Json agent, obstacle;  // mappings
};

/// Takes `spin`, `acceleration` and `braking` out of both bodies; nothing where there is none of them.
std::optional<MotionsGiven> take_motions(Json& engagement);

struct Motions {
  BodyMotion agent, obstacle;
};

/// With the velocities of the scene; in the plane `spin` is a number and `acceleration` has two. Throws
/// InputError naming "agent.spin", ...
Motions read_motions(const MotionsGiven& given, const scenes::Scene& scene);

/// Throws InputError naming the first of them: of readers whose answers are of straight motion.
void refuse_motions(const Json& engagement);

/// Their properties in the schema of a body.
Json motion_schema();

}  // namespace vericone::input
