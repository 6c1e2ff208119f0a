// SPDX-License-Identifier: BSD-3-Clause
//
// The horizon and bounded errors of an engagement from JSON values (docs/reference/formats.md).
#pragma once

#include <vericone/cones/uncertain/robust.h>
#include <optional>

#include "json/json_forward.h"

namespace vericone::input {

/// The field "horizon": seconds from now, or from and until when; for ever where it is not there. Throws
/// InputError naming it.
Horizon read_horizon(const Json& value);

/// The fields "position_error" and "velocity_error", with the horizon; nothing where neither is there. Throws
/// InputError naming the field, for example "position_error.ball".
std::optional<RelativeErrors> read_errors(const Json& value, const Horizon& horizon);

}  // namespace vericone::input
