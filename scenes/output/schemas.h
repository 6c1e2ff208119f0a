// SPDX-License-Identifier: BSD-3-Clause
//
// The JSON schemas of bodies and scenes, from the tables of their fields.
#pragma once

#include <string>

#include "json/json_forward.h"

namespace vericone::input {

/// The outermost lines of a schema before what `fields` say.
Json schema_of(const std::string& title, const std::string& description, Json fields);

/// As docs/schemas has it: a field is one line.
std::string schema_text(const Json& schema);

Json body_schema();
Json scene_schema();

}  // namespace vericone::input
