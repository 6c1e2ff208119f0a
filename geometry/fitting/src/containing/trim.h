// SPDX-License-Identifier: BSD-3-Clause
//
// Which points to leave out when a share of them is to be contained.
#pragma once

#include <vericone/fitting/hull.h>
#include <vericone/internal/fitting/canonical.h>
#include <vector>

namespace vericone::fitting {

/// Points kept: at least the share `coverage` (of a cloud's points, repeated ones counted; of a mesh's
/// vertices), chosen so that the minimum-volume ellipsoid of the kept ones (`planar`: the minimum-area
/// ellipse around their footprints) is small. Two heuristics, the better one: the support points that matter
/// most are taken away in turn; or those are kept that are near by their own covariance (minimum covariance
/// determinant). Not the least of all: that is a combinatorial problem.
std::vector<char> trim(const CanonicalSample& sample, double coverage, bool planar);

}  // namespace vericone::fitting
