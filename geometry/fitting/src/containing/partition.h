// SPDX-License-Identifier: BSD-3-Clause
//
// Parts of a sample, each to get a body of its own.
#pragma once

#include <vericone/fitting/hull.h>
#include <vericone/internal/fitting/canonical.h>
#include <vector>

namespace vericone::fitting {

/// Part of a sample: a sample in the same frame (weights as they were; `index` empty), and its items: indices
/// into the triangles of a mesh or the points of a cloud.
struct Part {
  CanonicalSample sample;
  std::vector<std::uint32_t> items;
};

/// Those of the points kept, and the triangles all of whose corners are.
Part kept_part(const CanonicalSample& sample, const std::vector<char>& kept);

/// Cuts a part into `count`, so that the minimum-volume ellipsoids of the parts are small together: the
/// largest is halved across its longest axis, then every triangle (of a cloud: every point) goes to the
/// ellipsoid that it is deepest in, in turns, while the sum of volumes falls. A local minimum. Throws
/// InputError naming "pieces" where a part would be flat.
std::vector<Part> partition(const Part& whole, int count);

}  // namespace vericone::fitting
