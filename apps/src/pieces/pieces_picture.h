// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "input/body.h"
#include "pieces/assembly_cone.h"

namespace vericone {

/// Writes the data and the picture of a cone around a body of pieces to `folder` (which exists): where the
/// agent is outside of the body's bounds both bodies and the cone's surface, where it is within them the map
/// from above; beside it every direction, coloured by the distance to the first contact. Returns the
/// pictures. Requires disjoint bodies.
std::vector<std::filesystem::path> draw_pieces(const AssemblyCone& cone,
                                               const input::AssemblyEngagement& engagement,
                                               const std::filesystem::path& folder);

}  // namespace vericone
