// SPDX-License-Identifier: BSD-3-Clause
//
// The registry: every number that sections 5.4.1, 5.4.2, 6.3.1 (accuracy) and 6.5 print, and
// equations that are printed wrong.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "claim.h"
#include "paper_run.h"

namespace vericone::dhal2022 {

/// All claims in the order of the source, every one measured from the runs. `progress`: of the engagements of
/// 6.3.1, false ends with Interrupted.
std::vector<Claim> measure_claims(PaperRuns& runs, const RunProgress& progress);

/// Sections, each a file of its own.
void claims_5_4_1(PaperRuns& runs, std::vector<Claim>& claims);
void claims_5_4_2(PaperRuns& runs, std::vector<Claim>& claims);
void claims_6_3_1(const RunProgress& progress, std::vector<Claim>& claims);
void claims_6_5_noncooperative(PaperRuns& runs, std::vector<Claim>& claims);
void claims_6_5_cooperative(PaperRuns& runs, std::vector<Claim>& claims);
/// Equations that are printed wrong, by what they give in the runs of the others.
void claims_of_equations(PaperRuns& runs, std::vector<Claim>& claims);

}  // namespace vericone::dhal2022
