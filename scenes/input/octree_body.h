// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "input/body.h"

namespace vericone::input {

struct OctreePieces {
  Assembly boxes;
  scenes::Reading reading;
};

/// Whether this build reads octree maps.
bool have_octrees();

/// The cells of a map that are obstacles by what `unknown`, `free`, `occupied_above` and `region` say. Throws
/// InputError with `path` before the field.
OctreePieces read_octree_pieces(const Json& value, const std::string& path, const std::filesystem::path& file,
                                double scale);

}  // namespace vericone::input
