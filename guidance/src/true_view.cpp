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

TrueCombined::TrueCombined(const CombinedEllipsoid& a, const CombinedEllipsoid& b, EdgeMemory* memory)
    : oracle_(a, b, kEdge), memory_(memory) {}

std::optional<PlaneSector> TrueCombined::on(const Vector3d& e) const {
  return combined_sector_on(oracle_, e, kEdge, memory_ ? memory_ : &own_);
}

}  // namespace vericone::guidance
