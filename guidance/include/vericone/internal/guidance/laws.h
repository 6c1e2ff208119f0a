// SPDX-License-Identifier: BSD-3-Clause
//
// What guide() asks of laws.
#pragma once

#include <vericone/guidance/laws.h>

namespace vericone::guidance {

/// clear, receding or no_relative_velocity: avoidance has nothing to say.
[[nodiscard]] bool commands_nothing(LawStatus status);

/// m(w) of the bodies as the law sees them, without errors; of planar ones in the plane.
/// Infinite where they do not move to each other.
[[nodiscard]] double law_clearance(const BodyState& a, const BodyState& b);

}  // namespace vericone::guidance
