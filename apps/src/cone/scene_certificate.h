// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/scenes/scene.h>
#include <string>

#include "json/json_forward.h"

namespace vericone {

/// Adds what proves the scene's verdict, `certificate`, or null and why there is none, `no_certificate`.
/// `id`: as JSON, or empty.
void add_scene_certificate(Json& result, const scenes::Scene& scene, const std::string& id);

}  // namespace vericone
