// SPDX-License-Identifier: BSD-3-Clause
//
// How deep two bodies overlap.
#pragma once

#include <vericone/geometry/body.h>
#include <Eigen/Core>
#include <optional>

namespace vericone {

/// The length of the shortest displacement after which two bodies no longer overlap.
struct Penetration {
  double least = 0, most = 0;  // metres; the depth lies between, proved
  /// Unit, from the agent towards the obstacle: moving the agent by `most` along -normal parts them. Where
  /// several displacements are equally short it is that of one of them.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
};

/// Of two convex bodies without delimiters: ellipsoids, hulls, and convex bodies of flat, round and straight
/// parts. Nothing where they do not overlap, as far as doubles tell (Pair::penetration() decides that), are
/// not such bodies, or their sizes and distances are not within 1e-120 m to 1e120 m. `least` is at most 1e-12
/// of the bodies' size below `most`, but where the shortest displacements are a continuum (two bodies of
/// revolution about one axis), which end after 1,000 steps, and of some pairs with straight rulings (a
/// capsule and a cone), whose faces all but degenerate: it is then what is proved by then, 0 at worst. An
/// expanding polytope (G. van den Bergen, "Proximity queries and penetration depth computation on 3D game
/// objects", 2001) of the difference of the bodies without their margins; its lower bound holds for any
/// closed surface that goes around the origin, which is counted. Throws InputError naming "pose.position[i]"
/// or "pose.rotation". Cost: 2 to 100 us, and more at a continuum.
[[nodiscard]] std::optional<Penetration> penetration(const Placed& agent, const Placed& obstacle);

}  // namespace vericone
