// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/simulation/trajectory.h>
#include <filesystem>
#include <string>

#include "json/json_forward.h"

namespace vericone::scenario {

/// How a body moves, of its field `track`: docs/reference/formats.md, "Tracks of others". Names of files are
/// relative to `folder`.
[[nodiscard]] simulation::Trajectory read_track(const Json& fields, const std::string& path,
                                                const std::filesystem::path& folder);

/// For the $defs of the schema of tracks.
Json track_schemas();

}  // namespace vericone::scenario
