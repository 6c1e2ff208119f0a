// SPDX-License-Identifier: BSD-3-Clause
//
// Two bodies of any kinds that spin, accelerate or brake: the first contact, or that there is none, proved.
// Pair (pair.h) answers straight motion, exactly; these answers are certified.
#pragma once

#include <vericone/cones/answers.h>
#include <vericone/geometry/body.h>
#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <optional>

namespace vericone {

/// How a rigid body moves from where it stands at t = 0. Its center goes along
///     center + velocity t + acceleration t^2 / 2,
/// and it turns about that at a constant rate: a point x of it is, from the center, Exp(spin t) (x - center).
/// `spin` is in the axes of the world; in those of the body it is the same only where it is along one of
/// them, so turn it by the body's rotation first: rotation * spin_in_body_axes.
struct BodyMotion {
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();      // at t = 0, m/s, world
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();  // constant, m/s^2, world
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();          // constant, rad/s, world
  /// Slows down along the velocity, m/s^2, until it stands, at |velocity| / braking; then it stays there (and
  /// spins on). 0: it does not brake. Not beside an acceleration.
  double braking = 0;
  /// What it turns about, in the world at t = 0, metres. Left out: the center of an ellipsoid (also of one
  /// with a margin) or a combined quadric, of others the origin of their own frame (Pose::position).
  std::optional<Eigen::Vector3d> center = {};

  /// Whether the velocity is all there is.
  [[nodiscard]] bool straight() const { return acceleration.isZero(0) && spin.isZero(0) && braking == 0; }
};

struct MotionOptions {
  /// The search ends after so many instants at which the distance was asked, with what is proved by then.
  std::size_t most_steps = 20'000;
};

/// What is proved of two bodies in motion.
struct MotionAnswer {
  /// out: apart all over the horizon. in: they meet within it; touching, overlapping: they do so as it
  /// begins. undecided: neither was proved, as where they graze. Never `on`.
  Verdict verdict = Verdict::undecided;
  /// Seconds. Nothing is touched before `earliest`, proved, beginning with the horizon. in: a point is common
  /// to both at `latest`, proved. undecided: not proved apart between the two, the first such time. out: both
  /// are the end of the horizon.
  double earliest = 0, latest = std::numeric_limits<double>::infinity();
  /// Metres. out: the least distance over the horizon lies between, proved; `least` is within 1 % of it, but
  /// for bodies that turn in dents and windows of others. Else both 0.
  double least = 0, most = 0;
  /// out: when they are that near, about. undecided: where they are nearest between the two. in: the middle
  /// of earliest and latest. s
  double time = 0;
  /// in, undecided: of the obstacle, next to the agent at `earliest`, in the world, and the unit normal there
  /// from the agent towards it, rounded. Nothing where that is not found.
  std::optional<Eigen::Vector3d> point, normal;
  std::size_t steps = 0;  // instants at which the distance was asked
};

/// Whether and when two bodies meet within a horizon, from standing as they are placed at t = 0. Every kind
/// that Pair serves. A horizon without an end is cut where both are farther from each other than they were
/// and only part, so its answer is for ever.
///
/// Method: from an instant at which the bodies are apart, by a bound of Pair, a stretch of time is proved by
/// a plane between them that neither can reach, by how far any point can go, or by the balls about the
/// centers; then the next instant. A contact is proved by an overlap deeper than what placing the bodies
/// rounds (docs/explanation/motion.md).
///
/// Throws InputError naming "agent.spin[i]", "agent.acceleration[i]", "agent.velocity[i]",
/// "agent.center[i]", "agent.braking", the same of "obstacle", "horizon" (also one without an end of bodies
/// that turn beside each other for ever), "most_steps", or as Pair does. Cost: 40 instants (median), at each
/// a Pair, its distance and some tens of support functions: 0.4 ms for two convex bodies (at most 28 ms of
/// 300, where an overlap is proved by the last rung of a relation).
[[nodiscard]] MotionAnswer motion_answer(const Placed& agent, const BodyMotion& agent_motion,
                                         const Placed& obstacle, const BodyMotion& obstacle_motion,
                                         const Horizon& horizon = {}, const MotionOptions& options = {});

}  // namespace vericone
