// SPDX-License-Identifier: BSD-3-Clause
//
// Dents: multipliers of the inequalities of two bodies and of the time, with a sum that is positive at every
// point, so that no point satisfies all of them.
#pragma once

#include "certificate/pieces.h"

namespace vericone::certificates {

/// Of pieces one of which is delimited: by a plane, multipliers, or those of parts of the time.
bool prove_out_by_forms(const PairOfPieces& pair, Text& proof);

/// A point strictly inside all of both.
bool prove_in_of_forms(const PairOfPieces& pair, Text& proof);

}  // namespace vericone::certificates
