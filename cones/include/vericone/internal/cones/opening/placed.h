// SPDX-License-Identifier: BSD-3-Clause
//
// Whether an opening stands as it should.
#pragma once

#include <vericone/cones/opening/opening.h>

namespace vericone {

/// Throws InputError naming "center[i]", "axes[i][j]" (not finite) or "axes" (linearly dependent: exact).
void require_placed(const PlacedOpening& placed);

}  // namespace vericone
