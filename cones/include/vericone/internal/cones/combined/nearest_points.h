// SPDX-License-Identifier: BSD-3-Clause
//
// Where two combined quadrics come nearest: what a picture or a report shows of a miss, dents included.
#pragma once

#include <vericone/geometry/combined.h>

namespace vericone {

/// Where two bodies are nearest while the agent moves by w t and the obstacle stands still.
template <int D>
struct NearestPoints {
  using Vector = Eigen::Matrix<double, D, 1>;

  double time = 0;                                                 // s
  double distance = 0;                                             // m
  Vector on_agent = Vector::Zero(), on_obstacle = Vector::Zero();  // m, at that time
};

/// Of all times from `from` to `to` (seconds, `to` may be infinite). Estimates, nothing is proved: the
/// boundaries are sampled, and the nearest pair of samples is refined, so `distance` is one that is reached
/// and the least where the samples found the right pair. Of ellipses and ellipsoids it is that of
/// Pair::miss() to 1e-9 of the bodies' sizes; where the bodies touch, the point comes out to about 1e-3 of
/// their sizes, as the gap hardly changes along them there. Bodies that overlap meanwhile have their
/// boundaries' nearest pair. Pair has proved bounds, and no points. Throws InputError naming "from" or "to".
/// Cost: 5 to 50 ms.
[[nodiscard]] NearestPoints<2> nearest_points(const CombinedEllipse& agent, const CombinedEllipse& obstacle,
                                              const Eigen::Vector2d& w, double from, double to);
[[nodiscard]] NearestPoints<3> nearest_points(const CombinedEllipsoid& agent,
                                              const CombinedEllipsoid& obstacle, const Eigen::Vector3d& w,
                                              double from, double to);

}  // namespace vericone
