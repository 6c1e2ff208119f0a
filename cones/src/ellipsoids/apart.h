// SPDX-License-Identifier: BSD-3-Clause
//
// Two bodies about centres that are themselves sums.
#pragma once

#include <vericone/geometry/combined.h>
#include <vericone/geometry/ellipsoid.h>

namespace vericone {

/// What `apart` makes of two bodies.
template <class Body>
struct BodiesApart {
  Body a, b;
  Eigen::Vector3d world_a, world_b;  // where their centres stand, rounded; theirs where nothing was moved
};

/// Bodies a and b whose own origins stand at `a_at` and `b_at`: two bodies whose centres are as far apart as
/// theirs. Of sums that are doubles they are at these; otherwise both are moved so that the difference of
/// their centres, which is what all answers depend on, is that of the four numbers, cut off after 106 bits.
/// The difference of the centres, rounded once, then is the difference of the four numbers, rounded once.
/// Throws InputError naming "pose.position[i]" where a sum is not finite.
BodiesApart<Ellipsoid> apart(const Ellipsoid& a, const Eigen::Vector3d& a_at, const Ellipsoid& b,
                             const Eigen::Vector3d& b_at);
BodiesApart<CombinedEllipsoid> apart(const CombinedEllipsoid& a, const Eigen::Vector3d& a_at,
                                     const CombinedEllipsoid& b, const Eigen::Vector3d& b_at);

}  // namespace vericone
