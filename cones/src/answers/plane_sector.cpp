// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/plane_sector.h>

#include <Eigen/Geometry>
#include <cmath>

namespace vericone {

using Eigen::Vector3d;

PlaneSectorRates sector_rates(const PlaneSector& sector, double left_speed, double right_speed,
                              const Vector3d& velocity, double plane_spin) {
  const Vector3d &u = sector.line_of_sight, &e = sector.across;
  const Vector3d turning = u.cross(velocity) / sector.distance + plane_spin * u;  // of the frame (u, e)
  // On the boundary n.q = g(n, t) stays 0 with q = kappa d, and grad g = q: q.n' = -g_t. Differentiating n.d
  // = 0 gives n.d' = g_t / kappa, where d' is phi' along the turned direction plus the turning of the frame.
  const auto edge_rate = [&](const PlaneSector::Edge& edge, double side, double g_t) {
    const double cosine = std::cos(edge.angle), sine = side * std::sin(edge.angle);
    const Vector3d d = cosine * u + sine * e, turned = -sine * u + cosine * e;
    const Vector3d& n = edge.normal;
    return side * (g_t / edge.contact.dot(d) - n.dot(turning.cross(d))) / n.dot(turned);
  };
  return {edge_rate(sector.left, 1, left_speed), edge_rate(sector.right, -1, right_speed),
          velocity.dot(e) / sector.distance};
}

std::optional<PlaneSectorRates> sector_rates(const PlaneSector& sector, const Twist& a, const Twist& b,
                                             double plane_spin) {
  if (!sector.has_contacts()) return std::nullopt;
  const Vector3d velocity = b.velocity - a.velocity;
  const auto speed = [&](const PlaneSector::Edge& edge) {
    return edge.normal.dot(velocity + b.omega.cross(edge.on_b) - a.omega.cross(edge.on_a));
  };
  return sector_rates(sector, speed(sector.left), speed(sector.right), velocity, plane_spin);
}

}  // namespace vericone
