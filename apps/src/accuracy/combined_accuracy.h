// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>

#include "accuracy/accuracy.h"
#include "accuracy/distribution.h"

namespace vericone::accuracy {

inline constexpr double kReferenceTolerance = 0.01;

/// `vericone accuracy --obstacle KIND` for combined quadrics: slice cones against planes, held against the
/// certified inner and outer cone. What slices miss is an interval then, as wide as the two differ. Requires
/// validated options with a folder in `out`.
int run_combined_accuracy(const Options& options, ObstacleKind kind, std::ostream& out);

}  // namespace vericone::accuracy
