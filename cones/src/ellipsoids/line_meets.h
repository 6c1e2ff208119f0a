// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/cones/answers.h>

#include "ellipsoids/pair_on_grid.h"

namespace vericone::exact {

/// Whether A, moving along w != 0 forwards or backwards, overlaps B at some time (`in`), only touches it
/// (`on`), or stays apart (docs/explanation/theory.md, 2).
Membership line_meets(const PairOnGrid<3>& pair, const IntegerVector<3>& w);

}  // namespace vericone::exact
