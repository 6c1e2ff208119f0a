// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/fitting/hull.h>

namespace vericone::fitting {

/// The piece that contains each point and all of each triangle, as exact arithmetic says; -1: none does, or
/// the point is none of those that count. Throws as check().
Assignment homes_of(const std::vector<std::vector<Quadric>>& pieces, const Sample& sample);

}  // namespace vericone::fitting
