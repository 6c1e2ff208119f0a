// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "input/body_kind.h"

namespace vericone::input {

/// A body given by `robot`: URDF or SDF, its joints at given values.
BodyKind robot_kind();

}  // namespace vericone::input
