// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/guidance/plane_view.h>

#include <Eigen/Geometry>

namespace vericone::guidance {

Eigen::Vector3d angular_velocity(const BodyState& body, const Eigen::Vector3d& acceleration) {
  const double square = body.velocity.squaredNorm();
  if (body.turning == Turning::none || !(square > 0)) return body.omega;
  return body.omega + body.velocity.cross(acceleration) / square;
}

BodyState advanced(const BodyState& body, double dt, const Eigen::Vector3d& acceleration) {
  BodyState later = body;
  later.position += dt * (body.velocity + 0.5 * dt * acceleration);
  later.velocity += dt * acceleration;
  const Eigen::Vector3d turn = dt * angular_velocity(body, acceleration);
  later.shape = body.shape.moved(body.position, later.position, turn, body.rate, dt);
  return later;
}

}  // namespace vericone::guidance
