// SPDX-License-Identifier: BSD-3-Clause
//
// Many runs of one pursuit: from starts near each other, or with random occlusions.
#pragma once

#include <vericone/vision/pursuit/pursuit.h>
#include <iosfwd>

#include "pursue/pursue_command.h"

namespace vericone::pursuit {

/// starts.csv: mean and greatest distance, mean speed error, share of the boundary layer, of every start.
int run_starts(const vision::Pursuit& pursuit, const PursueOptions& options, std::ostream& out);
/// occlusions.csv: a row a run, in which one vehicle is hidden for 3 s at a random time of the scenario.
int run_random(const vision::Pursuit& pursuit, const PursueOptions& options, std::ostream& out);

}  // namespace vericone::pursuit
