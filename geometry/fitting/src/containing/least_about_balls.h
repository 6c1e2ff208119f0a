// SPDX-License-Identifier: BSD-3-Clause
//
// The least ellipsoid about balls.
#pragma once

#include <vericone/geometry/ellipsoid.h>
#include <Eigen/Core>
#include <vector>

namespace vericone::fitting {

template <int D>
struct BallEnclosure {
  BasicEllipsoid<D> body;  // contains the balls to rounding
  /// How far a ball stuck out of the least ellipsoid of the places found, relative, squared; converged where
  /// at most 1e-8.
  double gap = 0;
  bool converged = false;
  /// Volume over the least one, at most: proved, the places lie in the balls (min_volume_ellipsoid.h).
  double volume_ratio_bound = 0;
  int rounds = 0;
};

/// Minimum-volume ellipsoid about balls of a positive radius, however thin their centres lie (also in a
/// plane, on a line, in a point). Cutting planes: the least ellipsoid of places in the balls takes in those
/// that stick out farthest, until none does. Time O(N) a round, some 10 to 40 rounds.
template <int D>
BallEnclosure<D> least_about_balls(const std::vector<Eigen::Matrix<double, D, 1>>& centers, double radius);

}  // namespace vericone::fitting
