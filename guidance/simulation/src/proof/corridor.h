// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/simulation/track.h>

namespace vericone::simulation {

/// All within `radius` of a leg.
struct CorridorOfLeg {
  Eigen::Vector3d from, to;  // m
  double radius;             // m
};

/// What the ball about the body's reference point that holds all of the body left of the corridor.
struct CorridorProof {
  double room;  // m, surely no more than the least over the time, within a thousandth of the radius;
                // negative: out
  bool left;    // its reference point was surely out at some time
};

/// Of the motion over [from, to], between samples too: a corridor is convex, so that the ends of a chord tell
/// of it, and a bound of the acceleration tells how far the way is from the chord.
[[nodiscard]] CorridorProof prove_corridor(const Track& track, const CorridorOfLeg& corridor, double from,
                                           double to);

}  // namespace vericone::simulation
