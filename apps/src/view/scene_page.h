// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/scenes/scene.h>
#include <string>

#include "json/json_forward.h"

namespace vericone {

/// Bodies of more pieces (or points of a hull) than this are answered by the command, not in a page.
inline constexpr std::size_t kMostPagePieces = 100'000;

/// What the page of a scene is made of (viewer/src/data.ts): each body's own numbers, all digits, which the
/// page asks its questions of; its surface, rounded, to be looked at; and what this program answered. Throws
/// InputError naming "agent" or "obstacle" where a body has more than kMostPagePieces.
Json scene_page(const scenes::Scene& scene, const std::string& title);

}  // namespace vericone
