// SPDX-License-Identifier: BSD-3-Clause
//
// Parts of a sample around which small solids are small together.
#pragma once

#include <vericone/internal/fitting/canonical.h>
#include <vericone/internal/fitting/solids.h>
#include <functional>
#include <vector>

namespace vericone::fitting {

/// A group for each triangle of a mesh or point of a cloud, and how many groups there are: at most `count`,
/// fewer where a further one would make nothing smaller. `told` is told the share done.
struct SolidGroups {
  std::vector<int> group;
  int count = 1;
};

/// What is to be in the same solid as a triangle, beside its corners: where chords from it through the inside
/// of the mesh come out, so that the solids fill what they are around and are not sheets. Of closed meshes
/// and of those that are nearly so; none of a cloud. Quadratic in the triangles up to 3000.
std::vector<std::vector<Eigen::Vector3d>> chord_ends(const CanonicalSample& sample,
                                                     const std::vector<std::uint32_t>& items);

/// What hangs together is parted first; then the group that gains most is cut across an axis of its box, to
/// more groups than wanted; pairs that gain least by being apart are joined again; then each item goes to the
/// solid that it is deepest in, while that makes the sum of volumes fall. A local minimum of that sum.
SolidGroups solid_groups(const CanonicalSample& sample,
                         const std::vector<std::vector<Eigen::Vector3d>>& chords,
                         const std::vector<SolidKind>& kinds, int count,
                         const std::function<void(double)>& told);

/// Every so many of all triangles or points, 3000 at most: those that searches look at.
std::vector<std::uint32_t> some_items(const CanonicalSample& sample);

/// How deep a point is in a solid as a ratio: 0 amid it, 1 on its boundary.
double depth_ratio(const Solid& solid, const Eigen::Vector3d& x);

}  // namespace vericone::fitting
