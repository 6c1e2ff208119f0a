// SPDX-License-Identifier: BSD-3-Clause
//
// Whether all that was ordered has been passed.
#pragma once

#include <vericone/simulation/reach.h>

namespace vericone::simulation {

/// Whether every passage that was ordered is proved.
[[nodiscard]] bool all_passed(const Run& run);

}  // namespace vericone::simulation
