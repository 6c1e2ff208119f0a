// SPDX-License-Identifier: BSD-3-Clause
//
// Whether some error passes: a search of the whole sphere of normals.
#pragma once

#include "uncertain/engagement.h"

namespace vericone::robust {

struct Everywhere {
  bool all_collide = false;             // proved
  std::optional<RelativeError> passes;  // one that does, proved
  int cells = 0;
};

/// `inner`: the engagement whose every error must collide; `outer`: that in which one must pass. They differ
/// where bodies may be turned, or grown. `prove`: whether `in` may be proved (convex bodies, as they are).
Everywhere everywhere(const Engagement& inner, const Engagement& outer, bool prove);

/// The error that opens the widest gap along n, rounded into its sets; nothing where that cannot be proved.
std::optional<RelativeError> passing_error(const Engagement& e, const Vector3d& n);

}  // namespace vericone::robust
