// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "motion/path.h"

namespace vericone::motion {

/// Whether the true bodies have a point in common at t, proved: those as placed in doubles overlap by more
/// than they may be off. False says nothing.
bool meet(const Path& a, const Path& b, double t);

}  // namespace vericone::motion
