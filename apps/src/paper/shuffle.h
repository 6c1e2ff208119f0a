// SPDX-License-Identifier: BSD-3-Clause
//
// What becomes of claims when the numbers that a paper does not print lie elsewhere in their stated ranges.
#pragma once

#include <iosfwd>

#include "output/progress.h"
#include "paper/claims_command.h"
#include "paper/paper.h"

namespace vericone::paper {

/// `vericone claims --shuffle N` (docs/reference/papers.md, "Shuffled"): each claim of `which` that says
/// something of ours, measured as the numbers were chosen and on N draws of them. Returns the exit status.
/// Throws InputError, Interrupted.
int shuffle_claims(const ClaimsOptions& options, Paper& paper, const Which& which, Progress& progress,
                   std::ostream& out);

}  // namespace vericone::paper
