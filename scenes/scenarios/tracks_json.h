// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/scenarios/scenario_files.h>

#include "json/json_forward.h"

namespace vericone::scenario {

/// certify(), whose errors name the file's fields.
[[nodiscard]] simulation::CertifiedTracks certified_of(const TracksFile& tracks);

/// What is proved of tracks of others: docs/reference/formats.md, "Tracks of others".
[[nodiscard]] Json certified_json(const TracksFile& tracks, const simulation::CertifiedTracks& certified);

/// Of the file in JSON Schema.
[[nodiscard]] Json tracks_schema();

}  // namespace vericone::scenario
