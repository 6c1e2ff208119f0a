// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/planar/sector.h>
#include <vericone/internal/cones/planar/cone_function.h>

#include <vericone/geometry/error.h>
#include <cmath>
#include <numbers>

#include "planar/sector_parts.h"

namespace vericone {

using Eigen::Vector2d;

SectorEdge make_edge(const Ellipse& a, const Ellipse& b, const Vector2d& normal, double side) {
  SectorEdge edge;
  edge.normal = normal.normalized();
  edge.direction = side * Vector2d(edge.normal.y(), -edge.normal.x());
  edge.point_on_a = a.support_point(edge.normal);
  edge.point_on_b = b.support_point(-edge.normal);
  return edge;
}

double bisector_angle(const Vector2d& right_direction, double psi) {
  const double angle = std::atan2(right_direction.y(), right_direction.x()) + psi / 2;
  return angle > std::numbers::pi ? angle - 2 * std::numbers::pi : angle;
}

Sector touching_sector(const Ellipse& a, const Ellipse& b, const Vector2d& normal) {
  Sector sector;
  sector.relation = Relation::touching;
  sector.psi = std::numbers::pi;
  sector.theta_b = std::atan2(normal.y(), normal.x());
  sector.left = make_edge(a, b, normal, -1);
  sector.right = make_edge(a, b, normal, 1);
  return sector;
}

Sector overlapping_sector(const Ellipse& a, const Ellipse& b) {
  Sector sector;
  sector.relation = Relation::overlapping;
  sector.psi = 2 * std::numbers::pi;
  const Vector2d c = b.center() - a.center();
  sector.theta_b = std::atan2(c.y(), c.x());
  return sector;
}

void require_edges(const Sector& sector) {
  if (sector.relation != Relation::disjoint)
    throw InputError("sector.relation", to_string(sector.relation), "disjoint, for edges that turn");
}

SectorRates sector_rates(const Sector& sector, const Ellipse& a, const Ellipse& b,
                         const PlanarMotion& motion) {
  // An edge direction d with inner normal n, n.d = 0, and q = kappa d the difference of the tangency points.
  // Along the motion n.q = g(n, t) stays 0 and grad g = q, so q.n' = -g_t; differentiating n.d = 0 gives
  // n.d' = g_t / kappa, and d' = phi' turned(d) = +- phi' n.
  require_edges(sector);
  const Vector2d c_rate = motion.v_b - motion.v_a;
  const auto shape_rate = [](const Ellipse& body, double omega,
                             const Eigen::Matrix2d& extra) -> Eigen::Matrix2d {
    Eigen::Matrix2d spin;
    spin << 0, -omega, omega, 0;
    return spin * body.shape() - body.shape() * spin + extra;
  };
  const Eigen::Matrix2d rate_a = shape_rate(a, motion.omega_a, motion.shape_rate_a),
                        rate_b = shape_rate(b, motion.omega_b, motion.shape_rate_b);
  const auto edge_rate = [&](const SectorEdge& edge, double side) {
    const Vector2d& n = edge.normal;
    const double kappa = (edge.point_on_b - edge.point_on_a).dot(edge.direction);
    const double g_t =
        n.dot(c_rate) - n.dot(rate_a * n) / (2 * a.radius(n)) - n.dot(rate_b * n) / (2 * b.radius(n));
    return side * g_t / kappa;  // side: sign of (turned d).n
  };
  const double left = edge_rate(sector.left, -1), right = edge_rate(sector.right, 1);
  return {left - right, 0.5 * (left + right)};
}

ConeFunction cone_function(double psi, double theta_b, const Vector2d& v_a, const Vector2d& v_b) {
  const Vector2d v = v_b - v_a;
  const double c = std::cos(theta_b), s = std::sin(theta_b);
  ConeFunction f;
  f.v_r_hat = v.x() * c + v.y() * s;
  f.v_theta_hat = -v.x() * s + v.y() * c;
  const double half = std::sin(psi / 2), speed2 = v.squaredNorm();
  f.y = (speed2 > 0 ? f.v_theta_hat * f.v_theta_hat / speed2 : 0) - half * half;
  return f;
}

double cone_function_y(double v_r, double v_theta, double theta, double theta_b, double psi) {
  const double c = std::cos(theta - theta_b), s = std::sin(theta - theta_b), half = std::sin(psi / 2);
  const double across = v_theta * c + v_r * s, speed2 = v_r * v_r + v_theta * v_theta;
  return (speed2 > 0 ? across * across / speed2 : 0) - half * half;
}

}  // namespace vericone
