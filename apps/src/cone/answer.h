// SPDX-License-Identifier: BSD-3-Clause
//
// What one engagement leads to: the verdict, the clearance and the time, for bodies of every kind.
#pragma once

#include "input/body.h"

namespace vericone {

/// {"verdict", ["rung"], "clearance", "time_to_contact", ...} as docs/reference/formats.md says.
Json answer(const input::AnyEngagement& engagement, bool with_rung);

/// Why a verdict can be relied on: "exact" or "certified".
const char* verdict_kind(const input::AnyEngagement& engagement);

}  // namespace vericone
