// SPDX-License-Identifier: BSD-3-Clause
//
// Pairs of which planes tell too little (bodies with holes, arms and corridors, a hull and a body with
// dents): certificates by their distance (docs/explanation/proof-of-runs.md).
#pragma once

#include <vericone/cones/pair.h>
#include <vericone/geometry/world_body.h>

#include "proof/separation.h"

namespace vericone::simulation {

/// Two bodies as they stand.
struct Posed {
  WorldBody a, b;
};
Posed posed(const MovingPair& pair, const Moment& moment);
/// All shapes of a piece of time, where the bodies stand in its middle.
Posed posed_over(const MovingPair& pair, const Piece& piece);

/// One of them is a placed body, or one a hull and the other has dents.
bool by_distances(const MovingPair& pair);

/// Throws InputError naming "bodies" for one of the plane and one of space.
Pair certified_pair(const Posed& bodies);

/// Requires by_distances(pair). The bound is the distance in the middle less all that both bodies can move
/// and turn meanwhile, or that along the chord less what they can leave it and turn.
Certificate by_distance(const MovingPair& pair, const Piece& piece);

/// Where they are nearest at that time, between them; requires by_distances(pair).
Eigen::Vector3d place_of_nearest(const MovingPair& pair, const Moment& moment);

/// Where they first touch on their way from `before`, when they are apart, to `at`, when they meet. Requires
/// by_distances(pair).
Eigen::Vector3d place_of_touch(const MovingPair& pair, const Moment& before, const Moment& at);

}  // namespace vericone::simulation
