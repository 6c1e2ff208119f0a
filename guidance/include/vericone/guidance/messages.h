// SPDX-License-Identifier: BSD-3-Clause
//
// To and from messages of other programs that are written as those of ROS are (geometry_msgs, nav_msgs):
// vectors and points have x, y, z, quaternions w too, poses a position and an orientation, twists a linear
// and an angular velocity. No header of theirs is needed.
#pragma once

#include <vericone/geometry/body.h>
#include <vericone/guidance/kinematics.h>

namespace vericone::guidance {

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
