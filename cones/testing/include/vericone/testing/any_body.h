// SPDX-License-Identifier: BSD-3-Clause
//
// Random bodies of every kind, the same on every platform for a seed.
#pragma once

#include <vericone/geometry/body.h>
#include <vericone/testing/random_bodies.h>

namespace vericone::testing {

/// About the origin, between 1 and 4 m large: ellipsoids; one to three hyperboloids that cut one; hulls of 6
/// to 12 points; 7 triangles, 9 balls, 6 boxes; unions of two quadrics, or of four hulls.
Body any_body(RandomBodies& random, BodyKind kind);

/// Any rotation; `distance` metres from the origin in any direction.
Pose any_pose(RandomBodies& random, double distance);

}  // namespace vericone::testing
