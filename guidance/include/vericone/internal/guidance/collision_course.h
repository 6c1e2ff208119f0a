// SPDX-License-Identifier: BSD-3-Clause
//
// Whether an engagement is one at all.
#pragma once

#include <vericone/guidance/guide.h>
#include <optional>

namespace vericone::guidance {

/// Whether they are on a collision course: the relative velocity lies in the cone (of the slices, or the true
/// one), or its y on the plane that holds it and the line of sight is below `cease`. The true cone is asked
/// by exact predicates where cease <= 0; what they leave undecided counts as colliding. Nothing where the
/// bodies are not apart.
[[nodiscard]] std::optional<bool> on_collision_course(const BodyState& a, const BodyState& b,
                                                      SectorMethod method, double cease = 0);

}  // namespace vericone::guidance
