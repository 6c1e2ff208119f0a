// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/guidance/plane_view.h>
#include <vericone/internal/guidance/plane_view.h>

#include <Eigen/Geometry>

#include "check_numbers.h"

namespace vericone::guidance {

void check(const BodyState& body) {
  require_finite(body.position, "position", " (m)");
  require_finite(body.velocity, "velocity", " (m/s)");
  require_finite(body.omega, "omega", " (rad/s)");
  Eigen::Vector3d at = body.position;
  if (const auto* flat = body.shape.flat())
    at.head<2>() = flat->center();
  else if (const auto* quadric = body.shape.quadric())
    at = quadric->center();
  else if (const auto* placed = body.shape.placed())
    at = placed->pose.position;
  constexpr double kRounded = 1e-6;
  if (!((at - body.position).norm() <= kRounded * (at.norm() + body.position.norm() + 1)))
    throw InputError("shape", "one at " + to_text(at.x()) + ", " + to_text(at.y()) + ", " + to_text(at.z()),
                     "at `position`, " + to_text(body.position.x()) + ", " + to_text(body.position.y()) +
                         ", " + to_text(body.position.z()) + " (m)");
}

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
