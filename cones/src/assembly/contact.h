// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "assembly/scene.h"

namespace vericone::assembly {

/// Contact of one piece; times in multiples of the velocity given.
struct PieceContact {
  double earliest = 0, latest = std::numeric_limits<double>::infinity(), time = 0;
  Eigen::Vector3d point = Eigen::Vector3d::Zero(), normal = Eigen::Vector3d::UnitX();
};

/// Newton's method on the distance between the moving apex and the core, which is convex in time: from the
/// left it never passes the contact, and every step is a plane that the agent has to reach first. `d`: the
/// velocity in the frame; `radius`: of the piece, for the point only. Nothing where a plane proves that there
/// is no contact before `limit`.
std::optional<PieceContact> piece_contact(const Frame& frame, Core core, double radius,
                                          const Eigen::Vector3d& d, double limit);

/// First contact along w, in the obstacle's frame and not zero, for bodies that are disjoint now; nothing
/// where no piece is met.
std::optional<AssemblyContact> first_contact(const Scene& scene, const Eigen::Vector3d& w, Effort& effort);

/// Least distance from now on; `space`: the agent in space (Frame::in_space).
AssemblyMiss miss_distance(const Scene& scene, const Frame& space, const Eigen::Vector3d& w, double tolerance,
                           Effort& effort);

}  // namespace vericone::assembly
