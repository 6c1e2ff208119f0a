// SPDX-License-Identifier: BSD-3-Clause
//
// Engagement kinematics in the source's terms, in the plane (5.8), (5.13), (5.15) and in space (6.10), from
// and to Cartesian states. Metres, seconds, radians. The relative velocity is V = V_B - V_A: closing is V_r <
// 0.
#pragma once

#include <vericone/geometry/world_body.h>
#include <Eigen/Core>
#include <cstdint>

namespace vericone::guidance {

/// Positions (m) and velocities (m/s) of two bodies in fixed axes.
template <int D>
struct Cartesian {
  using Vector = Eigen::Matrix<double, D, 1>;
  Vector p_a = Vector::Zero(), v_a = Vector::Zero();
  Vector p_b = Vector::Zero(), v_b = Vector::Zero();
};

/// Azimuth in (-pi, pi], elevation in [-pi/2, pi/2], rad.
struct Direction {
  double azimuth = 0, elevation = 0;
};

/// An engagement in one plane. In space it is the projection on a plane through the line of sight; then
/// `v_normal` and `plane_spin` say how it moves out of that plane.
struct PlanarState {
  double r = 0, theta = 0;          // line of sight from A to B, m and rad
  double v_theta = 0, v_r = 0;      // of V = V_B - V_A, m/s
  double alpha = 0, beta = 0;       // headings of A and B, of their projections in space, rad
  double speed_a = 0, speed_b = 0;  // of the projections in space, m/s
  double v_normal = 0;    // component of V along u x e: u the line of sight, e the plane's axis of V_theta
  double plane_spin = 0;  // rad/s, of the plane about u, beyond the turning of the line of sight
};

/// Accelerations of both bodies in the plane: lateral ones at heading + pi/2, longitudinal ones along it.
struct PlanarInputs {
  double lateral_a = 0, longitudinal_a = 0, lateral_b = 0, longitudinal_b = 0;  // m/s^2
};

struct PlanarRates {
  double r = 0, theta = 0, v_theta = 0, v_r = 0, alpha = 0, beta = 0, speed_a = 0, speed_b = 0;  // per s
};

/// (5.8), (5.13), (5.15) together, and the terms v_normal^2 / r in V_r and plane_spin v_normal in V_theta
/// that a projection adds (the source leaves them out, errata 3.6). A body at rest has no heading to turn:
/// its rate is 0. Requires r > 0.
[[nodiscard]] PlanarRates planar_rates(const PlanarState& state, const PlanarInputs& inputs);

/// Headings of bodies at rest are 0. Requires p_a != p_b; throws InputError naming "obstacle.center".
[[nodiscard]] PlanarState planar_state(const Cartesian<2>& motion);
/// With A at `p_a`.
[[nodiscard]] Cartesian<2> cartesian(const PlanarState& state,
                                     const Eigen::Vector2d& p_a = Eigen::Vector2d::Zero());

/// An engagement in space, (6.10)'s states. At the poles, phi = +-pi/2, theta has no value and its rate none
/// either: see at_pole.
struct SpatialState {
  double r = 0, theta = 0, phi = 0;        // m, rad: line of sight from A to B, azimuth, elevation
  double v_theta = 0, v_phi = 0, v_r = 0;  // m/s
  Direction heading_a, heading_b;          // (beta, alpha) of the source: azimuth, elevation
  double speed_a = 0, speed_b = 0;         // m/s
};

/// An acceleration of (6.10): magnitude and direction (delta, gamma).
struct DirectedAcceleration {
  double magnitude = 0;  // m/s^2
  Direction direction;
};

struct SpatialRates {
  double r = 0, theta = 0, phi = 0, v_theta = 0, v_phi = 0, v_r = 0;  // m/s, rad/s, m/s^2
  Direction heading_a, heading_b;
  double speed_a = 0, speed_b = 0;  // m/s^2
  bool at_pole = false;             // cos(phi) is 0: theta, v_theta and v_phi have no rates, they are 0 here
};

/// (6.10) with the V_phi row corrected (errata 3.6), and the rates of headings and speeds for accelerations
/// in any direction. A vertical heading has no azimuth to change: its rate is 0.
[[nodiscard]] SpatialRates spatial_rates(const SpatialState& state, const DirectedAcceleration& a,
                                         const DirectedAcceleration& b);

/// `previous`: an earlier state, from which angles without a value are taken and to which all are unwrapped.
/// Throws InputError naming "obstacle.center".
[[nodiscard]] SpatialState spatial_state(const Cartesian<3>& motion, const SpatialState* previous = nullptr);
[[nodiscard]] Cartesian<3> cartesian(const SpatialState& state,
                                     const Eigen::Vector3d& p_a = Eigen::Vector3d::Zero());

// A body at an instant, as guidance sees it.

/// Whether a body's orientation follows its velocity.
enum class Turning : std::uint8_t {
  none,          // as omega says, whatever it commands
  with_heading,  // omega = v x a / |v|^2 for its own acceleration a (a body without roll)
};

struct BodyState {
  WorldBody shape;  // its centre is `position`; of hulls, the reference point
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // m
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // m/s
  Eigen::Vector3d omega =
      Eigen::Vector3d::Zero();  // rad/s; of a body that turns with its heading, beyond that
  Turning turning = Turning::none;
  BodyRate rate;

  [[nodiscard]] bool planar() const { return shape.planar(); }
};

/// Throws InputError naming "position", "velocity" or "omega" where a number is not finite, and "shape" where
/// an ellipse, an ellipsoid, a combined or a placed body is not at `position`, to 1e-6 of the distance from
/// the origin. Laws do not look: one that is asked of a body in two places answers for both.
void check(const BodyState& body);

// To and from messages of other programs that are written as those of ROS are (geometry_msgs, nav_msgs):
// vectors and points have x, y, z, quaternions w too, poses a position and an orientation, twists a linear
// and an angular velocity. No header of theirs is needed.

template <typename Message>
[[nodiscard]] Eigen::Vector3d vector_of(const Message& message) {
  return {message.x, message.y, message.z};
}

/// Throws InputError naming "rotation" unless the quaternion's length is 1 to 1e-6: an orientation that
/// nobody set is (0, 0, 0, 0) there.
template <typename Message>
[[nodiscard]] Pose pose_of(const Message& message) {
  const auto& q = message.orientation;
  return Pose::from_quaternion(vector_of(message.position), {q.w, q.x, q.y, q.z});
}

/// A body where a pose says, at the velocities of a twist *in the axes of the pose* (those of the world). The
/// twist of an odometry is in the body's own axes: turn it first, pose_of(...).rotation *
/// vector_of(twist.linear).
template <typename PoseMessage, typename TwistMessage>
[[nodiscard]] BodyState state_of(const Body& body, const PoseMessage& pose, const TwistMessage& twist) {
  BodyState state;
  const Pose where = pose_of(pose);
  state.shape = Placed(body, where);
  state.position = where.position;
  state.velocity = vector_of(twist.linear);
  state.omega = vector_of(twist.angular);
  return state;
}

/// Writes x, y, z of a vector or a point.
template <typename Message>
void write_vector(const Eigen::Vector3d& vector, Message& message) {
  message.x = vector.x();
  message.y = vector.y();
  message.z = vector.z();
}

}  // namespace vericone::guidance
