// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/scenes/scene.h>
#include <string>
#include <vector>

#include "json/json_value.h"

namespace vericone::glb {

/// A scene as GLB (glb_file.h): its two bodies, the cone of the directions of w = v_agent - v_obstacle that
/// bring them into contact, from the middle of the agent, where they are apart, and the direction of w. The
/// cone is drawn by least sectors on planes through the line of sight: beyond them no direction of those
/// planes collides. `answer`: what is proved of the scene, into the extras. Throws InputError naming "--glb".
[[nodiscard]] std::string scene_glb(const scenes::Scene& scene, const Json& answer);

/// A body of a picture.
struct Shown {
  std::string name;
  Placed body;
  double alpha = 1;  // below 1 it shows what is behind it
  Json extras = nullptr;
};

/// Bodies in one frame, such as a scan and its fit. `extras`: what is proved of them.
[[nodiscard]] std::string bodies_glb(const std::vector<Shown>& bodies, const Json& extras);

}  // namespace vericone::glb
