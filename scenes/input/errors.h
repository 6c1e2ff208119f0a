// SPDX-License-Identifier: BSD-3-Clause
//
// Bounded errors of an engagement from JSON values (docs/reference/formats.md, robust verdicts).
#pragma once

#include <vericone/cones/uncertain/robust.h>
#include <optional>

#include "json/json_forward.h"

namespace vericone::input {

/// The fields "position_error", "velocity_error" and "horizon"; nothing where none of them is there. Throws
/// InputError naming the field, for example "position_error.ball".
std::optional<RelativeErrors> read_errors(const Json& value);

}  // namespace vericone::input
