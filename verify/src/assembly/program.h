// SPDX-License-Identifier: GPL-3.0-or-later
//
// The distance of two polyhedra in the metric of an ellipsoid as a quadratic program.
#pragma once

#include <vericone/internal/verify/assembly/truth.h>

#include <span>
#include <vector>

namespace vericone::verify {

/// Sign of 1 - (distance of the agent's centre, moved, to the hull of the points, in the metric in which the
/// ellipsoid is the unit ball): +1 overlap, 0 touch, -1 apart.
int compare_reach(const Ellipsoid& agent, std::span<const Eigen::Vector3d> points, const Motion& motion);

/// Sign of (sum of the radii) - (Euclidean distance of the hull of `agent`, moved, to that of `points`).
int compare_reach(std::span<const Eigen::Vector3d> agent, std::span<const Eigen::Vector3d> points,
                  const Motion& motion, const std::vector<double>& radii);

}  // namespace vericone::verify
