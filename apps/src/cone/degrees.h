// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <numbers>

namespace vericone {

/// Of an angle in radians, for text.
inline double degrees(double radians) { return radians * 180 / std::numbers::pi; }

}  // namespace vericone
