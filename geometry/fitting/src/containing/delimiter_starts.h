// SPDX-License-Identifier: BSD-3-Clause
//
// Where a dent or a waist might pay: starts for the search of containing bodies.
#pragma once

#include "containing/hull_problem.h"

namespace vericone::fitting {

struct DelimiterStart {
  StarBody body;
  Delimit kind = Delimit::dents;
  double log_volume = 0;
};

/// The outermost points of the problem in each of some thousand directions from its origin, points within
/// long triangles included: what the starts are judged by.
std::vector<Eigen::Vector3d> outermost_points(const HullProblem& problem);

/// Directions of dents to try: where the convex hull is farthest from the points, what is normal to two of
/// those, and an even spread.
std::vector<Eigen::Vector3d> delimiter_directions(const std::vector<Eigen::Vector3d>& points);

/// One more delimiter of each of `kinds` on `body`: along each direction with several openings, and (where
/// body has none yet) with the centre moved along it, as deep as the points allow. The best `most` by volume
/// that differ from each other, best first.
std::vector<DelimiterStart> delimiter_starts(const std::vector<Eigen::Vector3d>& points,
                                             const std::vector<Eigen::Vector3d>& directions,
                                             const StarBody& body, const std::vector<Delimit>& kinds,
                                             std::size_t most);

}  // namespace vericone::fitting
