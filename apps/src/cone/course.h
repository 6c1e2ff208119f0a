// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/geometry/combined.h>
#include <vericone/scenes/scene.h>

#include "json/json_forward.h"

namespace vericone {

/// Where two bodies are nearest while the agent moves by w t and the obstacle stands still.
template <int D>
struct NearestPoints {
  double time = 0;                                    // s
  double distance = 0;                                // m
  Eigen::Matrix<double, D, 1> on_agent, on_obstacle;  // m, at that time
};

/// Of all times from `from` to `to` (seconds, `to` may be infinite). Estimates for pictures: the boundaries
/// are sampled, and the nearest pair of samples is refined. Distances come out to rounding where the samples
/// found the right pair; where the bodies touch, the point to about 1e-3 of their sizes, as the gap hardly
/// changes along them there. Bodies that overlap meanwhile have their boundaries' nearest pair. Cost: 5 to
/// 50 ms.
NearestPoints<2> nearest_points(const CombinedEllipse& agent, const CombinedEllipse& obstacle,
                                const Eigen::Vector2d& w, double from, double to);
NearestPoints<3> nearest_points(const CombinedEllipsoid& agent, const CombinedEllipsoid& obstacle,
                                const Eigen::Vector3d& w, double from, double to);

/// What a picture shows of two velocities, seen from the obstacle: {"velocity", "verdict"} and where that
/// leads: "contact_time" (s) with "contact_point", or "miss_distance" (m) with "nearest_time",
/// "nearest_on_agent" and "nearest_on_obstacle"; neither where the verdict is undecided, the bodies overlap,
/// or the contact is too far away for doubles. Requires combined quadrics, in
/// space or in the plane. Distances of ellipses and ellipsoids are those of Pair, others
/// estimates (see above).
Json course_json(const scenes::Scene& scene);

}  // namespace vericone
