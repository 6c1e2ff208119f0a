// SPDX-License-Identifier: BSD-3-Clause
//
// The least distance of two bodies within a horizon, with its gradient and a proved lower bound: a row for
// optimisers of others, control barrier functions above all (docs/explanation/barrier.md).
#pragma once

#include <vericone/cones/pair.h>
#include <Eigen/Core>

namespace vericone::guidance {

/// h is the least distance while both go straight on; where they meet, minus the shortest way by which one
/// of them would have to be shifted so that they only touch, of the two convex parts where that is longest.
struct Barrier {
  double h = 0;      // m, the best estimate
  double least = 0;  // m: h is no less, proved
  /// Derivatives of h: to the agent's position, to its velocity (s), and to a small rotation of it about its
  /// pose's position (m/rad). Those to the obstacle's position and velocity are the opposite ones.
  Eigen::Vector3d by_position = Eigen::Vector3d::Zero(), by_velocity = Eigen::Vector3d::Zero(),
                  by_rotation = Eigen::Vector3d::Zero();
  double time = 0;  // s, from 0 to `until`: when they are nearest
};

/// From now until `until` (s, 0 or more; infinite: for ever). A body with delimiters counts as its ellipsoid.
/// Where several parts, or several places of parallel faces, are equally near, the gradient is that of one
/// of them. Throws InputError naming "until", "agent_velocity[i]" or "obstacle_velocity[i]". Cost:
/// docs/measured/guidance.md.
[[nodiscard]] Barrier barrier(const Pair& pair, const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b,
                              double until);

}  // namespace vericone::guidance
