// SPDX-License-Identifier: BSD-3-Clause
//
// Methods as others published them, in the plane: each sees discs about the bodies, as they do. Written anew
// from the publications, for comparisons alone. Each returns its velocity; nothing where it says that it has
// none.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace vericone::published {

using Eigen::Vector2d;

struct Disc {
  Vector2d position, velocity;  // m, m/s
  double radius;                // m
};

struct Decision {
  Disc agent;  // its velocity is the one that it has now
  Vector2d wanted;
  std::vector<Disc> others;
  double until;    // s that are looked ahead
  double fastest;  // m/s
};

/// Optimal reciprocal collision avoidance (van den Berg, Guy, Lin, Manocha: Reciprocal n-body collision
/// avoidance, ISRR 2009, Springer 2011): one half-plane of velocities a neighbour. `share`: how much of the
/// change the agent takes on; 1 where the others do not react.
struct HalfPlane {
  Vector2d point, normal;  // of allowed velocities v: normal.(v - point) >= 0; unit
};
HalfPlane orca_half_plane(const Disc& agent, const Disc& other, double until, double share);
/// Where the half-planes leave nothing it says so, and `least_violation` has what it then flies.
std::optional<Vector2d> orca(const Decision& decision, Vector2d* least_violation = nullptr);

/// The dynamic window (Fox, Burgard, Thrun: The dynamic window approach to collision avoidance, IEEE RAM
/// 1997): speeds and turns sampled, those that can stop before contact rated by heading, distance and speed.
/// Here a velocity is changed to at once and kept, so that a curvature is a new heading; all within 90
/// degrees, up to the wanted speed, counts as within reach. `moving`: contacts are those with others that
/// keep their velocity; the paper's others stand still.
std::optional<Vector2d> dynamic_window(const Decision& decision, bool moving);

/// Bands as DAIDALUS has them (Munoz and others, DASC 2015), with turns at once: headings in steps, in
/// conflict where two discs come nearer than the sum of radii within the lookahead; the free one nearest to
/// the wanted heading. Left out: tau, heights, its kinematic turns, hysteresis, recovery.
std::optional<Vector2d> heading_grid(const Decision& decision, double step_degrees);

/// Seconds until two discs touch, the agent flying at v; infinite where they never do.
double time_to_touch(const Disc& agent, const Vector2d& v, const Disc& other);

}  // namespace vericone::published
