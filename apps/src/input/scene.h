// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "input/body.h"

namespace vericone::input {

/// Reads a scene file, YAML (of which JSON is a part). Throws InputError naming the file or the field.
AnyEngagement read_scene(const std::string& path);

/// Its fields as they stand, unchecked.
Json read_scene_fields(const std::string& path);

}  // namespace vericone::input
