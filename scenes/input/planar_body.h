// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "input/body.h"

namespace vericone::input {

/// Throws InputError with `path` before the field.
CombinedEllipse read_planar_body(const Json& value, const std::string& path);

/// What the JSON schema of bodies says of planar ones, and their delimiters.
Json planar_schema();
Json hyperbola_schema();

}  // namespace vericone::input
