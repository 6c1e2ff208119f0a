// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "assembly/scene.h"

namespace vericone::assembly {

/// Contact of one piece; times in multiples of the velocity given.
struct PieceContact {
  double earliest = 0, latest = std::numeric_limits<double>::infinity(), time = 0;
  Eigen::Vector3d point = Eigen::Vector3d::Zero(), normal = Eigen::Vector3d::UnitX();

  /// Doubles do not prove an overlap soon after it: it grazes, or enters by an edge, or the two are flat.
  bool is_wide() const { return !(latest - earliest <= 1e-12 * earliest); }
  /// By a time that is known in seconds, rounded down and up; `scale`: of the velocity given, the largest
  /// entry.
  void refine(const std::optional<std::pair<double, double>>& seconds, double scale) {
    if (!seconds) return;
    earliest = std::max(earliest, seconds->first * scale * (1 - 2 * kUlp));
    latest = std::max(earliest, seconds->second * scale * (1 + 2 * kUlp));
    time = std::clamp(0.5 * (seconds->first + seconds->second) * scale, earliest, latest);
  }
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

}  // namespace vericone::assembly
