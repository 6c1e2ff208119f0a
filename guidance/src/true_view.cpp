// SPDX-License-Identifier: BSD-3-Clause
//
// True sectors of bodies without a closed form: contacts by Newton's method or a search, asked of the
// certified oracles.
#include <vericone/cones/assembly/assembly_sectors.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "plane_cones.h"

namespace vericone::guidance {
namespace {

using Eigen::Vector3d;

Vector3d turned_by(double angle, const Vector3d& u, const Vector3d& side) {
  return std::cos(angle) * u + std::sin(angle) * side;
}

/// How fast the boundary of a body moves outwards at a contact as its shape changes. The normal is the sum of
/// w M y over the surfaces y^T M y <= l touched there, and each counts by w (l' - y^T M' y) / 2.
double shape_speed(const TouchedSurfaces& touched, const Vector3d& y, const Vector3d& outward,
                   const Shape& shape, const ShapeRate* rate) {
  const auto* body = std::get_if<CombinedEllipsoid>(&shape);
  if (!rate || !body) return 0;
  double speed = 0, of_ellipsoid = 0;
  Vector3d rest = outward;
  for (int k = 0; k < touched.count; ++k) {
    const std::size_t i = touched.surface[k];
    if (i == 0) {
      of_ellipsoid = touched.weight[k];
      continue;
    }
    rest -= touched.weight[k] * (body->delimiters()[i - 1].matrix * y);
    if (i > rate->delimiters.size()) continue;
    const SpatialDelimiterRate& d = rate->delimiters[i - 1];
    speed += 0.5 * touched.weight[k] * (d.level - y.dot(d.matrix * y));
  }
  // Of the ellipsoid M' = -S^{-1} S' S^{-1}, and what is left of the normal is w S^{-1} y.
  if (of_ellipsoid > 1e-9 * y.norm()) speed += 0.5 / of_ellipsoid * rest.dot(rate->shape * rest);
  return speed;
}

}  // namespace

OpeningRates contact_rates(const PlaneSector& sector, const BodyState& a, const BodyState& b,
                           const Vector3d& velocity, double plane_spin, const TurningMotion& motion) {
  const auto speed = [&](const GrazingEdge& edge) {
    const Vector3d& n = edge.normal;
    return n.dot(velocity + motion.omega_b.cross(edge.on_b) - motion.omega_a.cross(edge.on_a)) -
           shape_speed(edge.touched_a, edge.on_a, n, a.shape, motion.rate_a) -
           shape_speed(edge.touched_b, edge.on_b, -n, b.shape, motion.rate_b);
  };
  const PlaneSectorRates rates =
      sector_rates(sector, speed(sector.left), speed(sector.right), velocity, plane_spin);
  return {rates.psi(), rates.theta_b()};
}

TrueHull::TrueHull(const Ellipsoid& agent, const HullBody& hull, const Vector3d& position)
    : agent_(agent), hull_(hull), oracle_(agent, hull), position_(position) {}

std::optional<PlaneSector> TrueHull::on(const Vector3d& e) const {
  if (auto sector = HullSectors(agent_, hull_, oracle_).on(position_, e)) return sector;
  return assembly_sector(AssemblyOracle(agent_, Assembly::polyhedra({hull_})), agent_.center(), position_, e);
}

TrueCombined::TrueCombined(const CombinedEllipsoid& a, const CombinedEllipsoid& b)
    : oracle_(a, b, kEdge), edges_(a, b), disjoint_(oracle_.relation() == Relation::disjoint) {}

CombinedEdge TrueCombined::edge(const Vector3d& u, const Vector3d& side,
                                std::optional<CombinedEdge>& before) const {
  // Each half-plane from the line of centres holds one interval of the cone, which begins there.
  double in = 0, out = std::numbers::pi;
  const auto ask = [&](double angle) {
    const bool outside = oracle_.membership(turned_by(angle, u, side)) == Certified::out;
    (outside ? out : in) = angle;
    return outside;
  };
  const auto certain = [&](const std::optional<CombinedEdge>& found) {
    return found && found->angle > in + kEdge && found->angle < out && ask(found->angle + 0.5 * kEdge) &&
           !ask(found->angle - 0.5 * kEdge);
  };
  if (before) {
    const auto found = edges_.near(u, side, *before);
    if (certain(found)) return *(before = found);
  }
  // The points of both bodies farthest across the line of sight, and across the edge as far as it is known.
  const auto from_points = [&](double angle) {
    const Vector3d up = turned_by(angle + 0.5 * std::numbers::pi, u, side);
    CombinedEdge start;
    start.on_a = -up / oracle_.a().gauge(up);
    start.on_b = up / oracle_.b().gauge(up);
    return edges_.near(u, side, start);
  };
  for (int round = 0; out - in > kEdge; ++round) {
    if (round % 4 == 0) {
      const auto found = from_points(round == 0 ? 0 : in);
      if (certain(found)) return *(before = found);
    }
    if (out - in > kEdge) ask(0.5 * (in + out));
  }
  before.reset();
  CombinedEdge edge;
  edge.angle = out;
  return edge;
}

std::optional<PlaneSector> TrueCombined::on(const Vector3d& u, const Vector3d& e) const {
  if (!disjoint_) return std::nullopt;
  const Vector3d c = oracle_.b().center() - oracle_.a().center();
  PlaneSector sector;
  sector.line_of_sight = u;
  sector.across = e;
  sector.distance = c.norm();
  // The plane before may have been this one turned over.
  sector.left = edge(u, e, left_);
  sector.right = edge(u, -e, right_);
  for (GrazingEdge* edge : {&sector.left, &sector.right}) edge->contact = c + edge->on_b - edge->on_a;
  return sector;
}

}  // namespace vericone::guidance
