// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "cone/assembly_cone.h"

namespace vericone {

/// Writes the data of a picture of a cone around a body of pieces to `folder` (which exists): where the agent
/// is outside of the body's bounds both bodies and the cone's surface, where it is within them the map from
/// above; beside it every direction, coloured by the distance to the first contact. Returns the script that
/// draws it (figures.h). Requires disjoint bodies.
std::string write_pieces_picture(const AssemblyCone& cone, const scenes::Scene& scene,
                                 const std::filesystem::path& folder, int threads);

}  // namespace vericone
