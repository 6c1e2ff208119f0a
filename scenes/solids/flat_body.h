// SPDX-License-Identifier: BSD-3-Clause
//
// Bodies of the plane with straight edges, and those with a margin.
#pragma once

#include "input/body.h"

namespace vericone::input {

/// Whether a field of bodies is one that only some readers of scenes know.
bool is_word_of_scenes(const std::string& field);

/// Whether the fields are those of a polygon or a stadium.
bool is_flat_word(const Json& body);
/// Throws InputError naming such a field: for readers of bodies in space.
void refuse_words_of_scenes(const Json& body, const std::string& path);

/// Two bodies of the plane, any of them but two conics without margins. Velocities are not read. Throws
/// InputError naming the field.
Scene flat_scene(const Json& agent, const Json& obstacle);

/// A body of the plane, raised to some height. Throws InputError with `path` before the field.
SceneBody read_flat_body(const Json& value, const std::string& path);

/// For the JSON schema of bodies, and the mapping `stadium` in it.
Json flat_schema();
Json stadium_schema();

/// Of a raised body that is no conic: what it covers of the plane, as convex outlines, metres; round parts by
/// many corners.
std::vector<std::vector<Eigen::Vector2d>> flat_outlines(const Placed& raised);

}  // namespace vericone::input
