// SPDX-License-Identifier: BSD-3-Clause
//
// What one engagement leads to: the verdict, the clearance and the time, for bodies of every kind.
#pragma once

#include <vericone/cones/answers.h>
#include <vericone/scenes/scene.h>

#include "json/json_forward.h"

namespace vericone {

/// {"verdict", ["rung"], "clearance", "time_to_contact", ...} as docs/reference/formats.md says. The verdict
/// is that within the horizon, all else as without one.
Json answer(const scenes::Scene& scene, bool with_rung, const Horizon& horizon = {});

/// Why a verdict can be relied on: "exact" or "certified".
const char* verdict_kind(const scenes::Scene& scene);

}  // namespace vericone
